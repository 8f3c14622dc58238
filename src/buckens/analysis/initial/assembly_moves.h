// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/model/build/build_model.h"
#include "buckens/model/state.h"

namespace buckens::analysis {

/// How far position assembly moved a body from its place in the model file. For a body with several
/// frames, that of the part that moved most; of those that moved alike but for rounding, the first.
struct AssemblyMove {
  std::string body;
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< of the mass centre, world axes [m]
  double angle = 0;                                       ///< angle of rotation [rad], 0 … π
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< rotation axis, world axes, unit length
  /// The joint responsible: one at this body if open as placed, else the one with the largest gap;
  /// empty if none.
  std::string joint;
  SourceLocation where;   ///< of the joint
  std::string gap;        ///< "0.12 m apart and 0 rad askew as placed"
  bool is_drive = false;  ///< caused by a drive that does not start from zero
  /// More than 1e-3 of the model's length or 1e-3 rad, and not by a drive.
  bool is_large = false;

  /// "assembly moved body "crank" by …": the move in one sentence.
  std::string text() const;
};

/// Moves of undeformed bodies by assembly, except those by rounding; in the order of the model
/// file.
/// @param assembled what assemble_positions() made of the bodies as placed, at the same time
std::vector<AssemblyMove> assembly_moves(const model::Model& model, const model::State& assembled);

/// Warnings about the first large ones, naming body and joint, and how many more there are.
/// @throws ModelError with the first of them if the model requests strict assembly
std::vector<std::string> judge_assembly(const model::BuiltModel& built,
                                        const std::vector<AssemblyMove>& moves);

}  // namespace buckens::analysis
