// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "buckens/mesh_io/gmsh/library.h"
#include "buckens/mesh_io/step/shapes.h"
#include "buckens/mesh_io/step/trial.h"

namespace buckens::mesh_io {

/// A STEP file read in one unit, with its touching solids glued: what all ways to mesh it in this
/// unit begin with. For assemblies it takes longer than any of these.
class GluedPart {
 public:
  /// @param without places of solids that are left out
  /// @throws IoError with the library's message if the file cannot be read or glued
  GluedPart(const StepTask& task, bool in_millimetres,
            const std::vector<std::size_t>& without = {});

  GmshLibrary& gmsh() { return gmsh_; }
  bool in_millimetres() const { return in_millimetres_; }
  /// Why there is nothing to mesh; empty: there is.
  const std::string& problem() const { return problem_; }
  /// Notes on solids that overlap, colours and labels of faces: lines as mesh_in_trial() returns
  /// them. Numbers of faces are those of the model as long as it is not mended.
  const std::string& faces() const { return faces_; }
  /// In brackets the names of two solids that overlap, and how many do; empty: none.
  const std::string& overlap() const { return overlap_; }
  /// The smaller ones of solids that overlap, by their places in the file.
  const std::vector<std::size_t>& smaller() const { return smaller_; }
  /// Their volume as a share of all.
  double smaller_share() const { return smaller_share_; }
  /// Lines with the time it took.
  const std::string& times() const { return times_; }

 private:
  void leave_out();
  void tell_overlaps(const GluedShapes& shapes);
  std::string labels(const StepTask& task, const GluedShapes& shapes);

  GmshLibrary gmsh_;
  bool in_millimetres_;
  SolidChoice choice_;
  std::vector<std::size_t> smaller_;
  double smaller_share_ = 0;
  std::string problem_, faces_, overlap_, times_;
};

}  // namespace buckens::mesh_io
