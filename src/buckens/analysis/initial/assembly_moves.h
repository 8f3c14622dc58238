// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/model/build/build_model.h"
#include "buckens/model/state.h"

namespace buckens::analysis {

/// How far position assembly took a body from where the model file places it. Of a body with
/// several frames the part that moved most stands for the whole.
struct AssemblyMove {
  std::string body;
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< of the mass centre, world axes [m]
  double angle = 0;                                       ///< turned by [rad], 0 … π
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();        ///< turned about, world axes, unit length
  /// The joint to blame: at this body if one is open as placed, else the one open most; empty where
  /// none is.
  std::string joint;
  SourceLocation where;   ///< of the joint
  std::string gap;        ///< "0.12 m apart and 0 rad askew as placed"
  bool is_drive = false;  ///< a drive that does not start from zero asks for it
  /// More than 1e-3 of the model's length or 1e-3 rad, and not by a drive.
  bool is_large = false;

  /// "assembly moved body "crank" by …": what happened, in one sentence.
  std::string text() const;
};

/// What assembly did to undeformed bodies, without those that moved by rounding only; in the order
/// of the model file.
/// @param assembled what assemble_positions() made of the bodies as placed, at the same time
std::vector<AssemblyMove> assembly_moves(const model::Model& model, const model::State& assembled);

/// Warnings about the large ones, naming body and joint.
/// @throws ModelError with the first of them where the model asks for strict assembly
std::vector<std::string> judge_assembly(const model::BuiltModel& built,
                                        const std::vector<AssemblyMove>& moves);

}  // namespace buckens::analysis
