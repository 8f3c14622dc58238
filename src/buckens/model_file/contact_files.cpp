// SPDX-License-Identifier: Apache-2.0
#include "buckens/model_file/contact_files.h"

#include "buckens/base/errors.h"
#include "buckens/mesh_io/stl/reader.h"

namespace buckens::model_file {

namespace {

void load_shape(loads::ShapeSpec& shape, const ReadContext& context) {
  auto* stl = std::get_if<loads::StlShape>(&shape.kind);
  if (stl == nullptr || stl->triangles) return;
  try {
    stl->triangles = std::make_shared<const spatial::TriangleList>(
        mesh_io::read_stl(context.directory / stl->file, stl->unit));
  } catch (const IoError& error) {
    throw InputError(stl->where, error.what());
  } catch (const InputError& error) {
    if (error.where().line > 0) throw;  // a place in the file says more
    throw InputError(stl->where, error.what());
  }
}

}  // namespace

void load_contact_files(loads::LoadSpec& load, const ReadContext& context) {
  if (auto* pair = std::get_if<loads::ContactSpec>(&load.kind)) {
    for (loads::ShapeSpec& shape : pair->shapes) load_shape(shape, context);
  } else if (auto* group = std::get_if<loads::ContactsSpec>(&load.kind)) {
    for (auto* list : {&group->among, &group->against}) {
      for (loads::ContactMemberSpec& member : *list) load_shape(member.shape, context);
    }
  }
}

}  // namespace buckens::model_file
