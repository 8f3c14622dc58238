// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/body/body_spec.h"
#include "buckens/loads/distributed_load_spec.h"
#include "buckens/model/build/structure_from_spec.h"

namespace buckens::model {

/// Elements of a mesh on which a load acts.
struct LoadedElements {
  std::vector<int> lines;  ///< beams, then bars
  std::vector<int> solids;
  std::vector<int> shells;
};

/// Faces of solids and sides of shells on which a load acts.
struct LoadedFaces {
  std::vector<fem::ElementFace> solids;
  std::vector<fem::ShellSide> shells;
};

/// Finds the part of a body named by a load of the model file.
class LoadPlaceFinder {
 public:
  /// @param load its name, for messages
  LoadPlaceFinder(std::string load, const loads::BodyPart& on, const body::BodySpec& body,
                  const NamedStructure& mesh)
      : load_(std::move(load)), on_(on), body_(body), mesh_(mesh) {}

  /// Faces of a named face or face set, or those on the surface of the mesh that lie in an
  /// interface; of shells there, the side that their normal points to.
  /// @throws InputError if the mesh has neither solids nor shells, or no face matches
  LoadedFaces faces() const;
  /// Lines, solids and shells: all, those of an element set, or of one beam of the model file.
  /// @throws InputError if there is no such part
  LoadedElements elements() const;
  /// The same without solids and shells.
  /// @throws InputError if there is no line among them
  LoadedElements lines() const;

 private:
  [[noreturn]] void fail(const std::string& what) const;
  [[noreturn]] void fail_unknown(const char* kind, const std::vector<std::string>& known) const;

  std::string load_;
  const loads::BodyPart& on_;
  const body::BodySpec& body_;
  const NamedStructure& mesh_;
};

}  // namespace buckens::model
