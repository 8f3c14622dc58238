// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "buckens/dynamics/multiplier_condensation.h"
#include "buckens/model/model.h"
#include "buckens/model/state.h"
#include "buckens/stepping/body_step.h"

namespace buckens::stepping {

/// Response of one body to a unit push.
struct PushedBody {
  std::size_t body = 0;
  Vector6 u = Vector6::Zero();  ///< of the frame
  Eigen::VectorXd y;            ///< of the interface
  Eigen::VectorXd load;         ///< on interface rows, including that of joints
};

/// A row along which a force or impulse acts, and the response to a unit of it.
struct Push {
  dynamics::SystemRow row;
  std::vector<PushedBody> bodies;  ///< those that move, ascending
};

/// Responses of bodies and their joints to pushes along rows, and of springs if they are given.
class PushAnswers {
 public:
  /// @param model must outlive this object
  explicit PushAnswers(const model::Model& model) : model_(model) {}

  /// @param compliance of each body, must outlive the answers, @param rows_in_use independent rows
  /// @param closed rigid rows of force laws that also hold
  /// @param give of each of these that yields, as springs do [m/N]; empty: none does
  /// @return false if the joint rows are dependent there
  bool condense(const std::vector<dynamics::BodyCompliance>& compliance,
                const std::vector<dynamics::BodyMotion>& motions,
                const std::vector<int>& rows_in_use, const model::RowMemory* memory, double t,
                const std::vector<dynamics::SystemRow>& closed = {},
                const std::vector<double>& give = {});
  /// Sets everything of a push except its row.
  void answer(Push& push) const;
  /// Response along a row to a push along another one.
  static double along(const dynamics::SystemRow& row, const Push& push);
  /// Responses along the rows of all pushes (rows) to each of them (columns): entries where two
  /// pushes reach a common body.
  static linalg::SparseMatrix along_all(const std::vector<const Push*>& pushes);

 private:
  /// With the joints, if any, and for rows with any number of shares.
  void answer_all(Push& push) const;
  /// Response of one body to a load.
  PushedBody move(std::size_t b, dynamics::BodyResponse load) const;

  const model::Model& model_;
  const std::vector<dynamics::BodyCompliance>* compliance_ = nullptr;
  std::optional<dynamics::MultiplierCondensation> joints_;  // empty without rows that hold
};

}  // namespace buckens::stepping
