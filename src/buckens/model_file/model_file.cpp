// SPDX-License-Identifier: Apache-2.0
#include "buckens/model_file/model_file.h"

#include <algorithm>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/files/text_file.h"
#include "buckens/files/text_lines.h"
#include "buckens/model_file/fields.h"
#include "buckens/model_file/overrides.h"
#include "buckens/model_file/step_mesh_cache.h"
#include "buckens/model_file/table_ranges.h"
#include "buckens/model_file/yaml_tree.h"

namespace buckens::model_file {

namespace {

/// The text with the overrides as a comment ahead, so that a run directory tells what was run.
std::string with_overrides(const std::string& text, const std::string& name,
                           const std::vector<std::string>& overrides) {
  if (overrides.empty()) return text;
  std::string out = fmt::format("# {} was read with these changes:\n", name);
  for (std::string line : overrides) {
    for (char& c : line) {
      if (c == '\n' || c == '\r') c = ' ';
    }
    out += "#   --set " + line + "\n";
  }
  return out + text;
}

/// The files that a model names and those that they include, as a comment: a run directory tells
/// which meshes and tables it belongs to, and a sweep that one has changed.
std::string comment_on(const files::FilesRead& files, const std::filesystem::path& directory) {
  if (files.hashes().empty()) return {};
  std::string out = "# Files read with it, and the hash of their contents:\n";
  for (const auto& [path, hash] : files.hashes()) {
    const std::filesystem::path near = path.lexically_relative(directory);
    std::string name = (near.empty() ? path : near).string();
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return c < ' '; }, '?');
    out += fmt::format("#   {} {:016x}\n", name, hash);
  }
  return out;
}

model::ModelDescription read_with_meshes(const std::string& text, const std::string& name,
                                         const std::vector<std::string>& overrides,
                                         StepMeshCache& meshes) {
  YamlNode root = parse_yaml(text, name);
  if (root.kind == YamlNode::Kind::null) {
    throw InputError({name, 0, 0}, "the model file is empty; it begins with \"buckens: 1\"");
  }
  if (!root.is_map()) {
    throw InputError(root.where, fmt::format("{} stands here; a model file is a map of keys such "
                                             "as buckens, bodies, joints",
                                             root.description()));
  }
  for (const std::string& assignment : overrides) apply_override(root, assignment);

  files::FilesRead files;
  model::ModelDescription out;
  ReadContext context;
  context.directory = std::filesystem::path(name).parent_path();
  context.model = &out;
  context.step_meshes = &meshes;
  read_record({root, ""}, context, out);
  check_table_ranges(out);
  out.where = {name, 0, 0};
  out.source = comment_on(files, context.directory) +
               with_overrides(files::without_byte_order_mark(text), name, overrides);
  return out;
}

}  // namespace

model::ModelDescription read_model_text(const std::string& text, const std::string& name,
                                        const std::vector<std::string>& overrides) {
  StepMeshCache meshes;
  return read_with_meshes(text, name, overrides, meshes);
}

model::ModelDescription read_model_file(const std::filesystem::path& path,
                                        const std::vector<std::string>& overrides) {
  StepMeshCache meshes;
  return read_model_file(path, overrides, meshes);
}

model::ModelDescription read_model_file(const std::filesystem::path& path,
                                        const std::vector<std::string>& overrides,
                                        StepMeshCache& meshes) {
  return read_with_meshes(files::read_text_file(path, "model file"), path.string(), overrides,
                          meshes);
}

}  // namespace buckens::model_file
