// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "buckens/dynamics/multiplier_condensation.h"
#include "buckens/model/model.h"
#include "buckens/model/state.h"
#include "buckens/stepping/body_step.h"

namespace buckens::stepping {

/// What a unit of a push does to one body.
struct PushedBody {
  std::size_t body = 0;
  Vector6 u = Vector6::Zero();  ///< answer of the frame
  Eigen::VectorXd y;            ///< and of the interface
  Eigen::VectorXd load;         ///< on interface rows, with what joints add
};

/// A row along which something pushes, and what a unit of it does.
struct Push {
  dynamics::SystemRow row;
  std::vector<PushedBody> bodies;  ///< that move, ascending
};

/// What pushes along rows do to bodies and their joints. Springs take no part.
class PushAnswers {
 public:
  /// @param model must outlive this object
  explicit PushAnswers(const model::Model& model) : model_(model) {}

  /// @param compliance of each body, must outlive the answers, @param rows_in_use independent rows
  /// @param closed rigid rows of force laws that also hold
  /// @return false if the joint rows are dependent there
  bool condense(const std::vector<dynamics::BodyCompliance>& compliance,
                const std::vector<dynamics::BodyMotion>& motions,
                const std::vector<int>& rows_in_use, const model::RowMemory* memory, double t,
                const std::vector<dynamics::SystemRow>& closed = {});
  /// Fills all but the row of a push.
  void answer(Push& push) const;
  /// What one push does along the row of another.
  static double along(const dynamics::SystemRow& row, const Push& push);
  /// What each push (column) does along the rows of all: entries where both reach a body.
  static linalg::SparseMatrix along_all(const std::vector<const Push*>& pushes);

 private:
  void answer_with_joints(Push& push) const;
  /// What a load does to one body.
  PushedBody move(std::size_t b, dynamics::BodyResponse load) const;

  const model::Model& model_;
  const std::vector<dynamics::BodyCompliance>* compliance_ = nullptr;
  std::optional<dynamics::MultiplierCondensation> joints_;  // empty without rows that hold
};

}  // namespace buckens::stepping
