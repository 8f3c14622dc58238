// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "buckens/dynamics/constraints.h"
#include "buckens/dynamics/forces.h"
#include "buckens/dynamics/multiplier_condensation.h"
#include "buckens/model/state.h"
#include "buckens/stepping/stepper.h"

namespace buckens::analysis {

/// What impulses along rows of joints and closed rigid rows do, at one configuration after the
/// other. As long as rows stay the same, nothing is allocated.
class Impulses {
 public:
  /// @param meshes gives the response of meshes, with what its steps resolve; null: bodies are
  ///        taken as rigid
  Impulses(const model::Model& model, const stepping::Stepper* meshes);

  /// Takes the rows of a configuration. @param rows_in_use independent rows of λ
  void place(const model::State& state, const std::vector<int>& rows_in_use);

  bool has_rows() const { return !rows_.empty(); }
  /// Of joints; rigid rows stay where they are.
  const std::vector<double>& gaps() const { return gaps_; }
  const std::vector<double>& rates() const { return rates_; }

  /// What one body does: the change of its frame, and the load on the interface of its mesh, null
  /// where that does not move.
  struct Change {
    Eigen::Matrix<double, 6, 1> frame;
    const linalg::Vector* mesh;
  };
  /// Finds the impulses that change the rows by −`values`, one per row, and passes what each body
  /// does to `take(b, change)`.
  /// @throws NumericalError where the rows are dependent
  template <class Take>
  void undo(const std::vector<double>& values, Take&& take) {
    find(values);
    for (std::size_t b = 0; b < responses_.size(); ++b) take(b, change_of(b));
  }
  /// The same for impulses from outside; those along the rows keep them closed.
  /// @param impulses per body
  template <class Take>
  void add(const std::vector<dynamics::BodyResponse>& impulses, Take&& take) {
    find_moved(impulses);
    find(moved_);
    for (std::size_t b = 0; b < responses_.size(); ++b) {
      responses_[b].frame_load += impulses[b].frame_load;
      responses_[b].interface_load += impulses[b].interface_load;
      take(b, change_of(b));
    }
  }

 private:
  void add_rigid_row(const dynamics::SystemRow& row);
  /// Begins with another condensation where bodies or places of rows have changed.
  void follow_pattern();
  /// Impulses on each body along the rows that change these by −`values`, into `responses_`.
  void find(const std::vector<double>& values);
  /// How far impulses alone move the rows, into `moved_`.
  void find_moved(const std::vector<dynamics::BodyResponse>& impulses);
  Change change_of(std::size_t b) const {
    return {compliance_[b].frame * responses_[b].frame_load,
            interface_[b].size() > 0 ? &responses_[b].interface_load : nullptr};
  }

  const model::Model& model_;
  double t_ = 0;
  std::vector<linalg::Matrix> interface_;
  std::vector<dynamics::BodyCompliance> compliance_;
  std::vector<dynamics::BodyMotion> motions_;
  dynamics::Constraints joints_;
  dynamics::SoftRows soft_;
  std::vector<dynamics::SystemRow> rows_, pattern_;
  std::vector<double> gaps_, rates_, give_, moved_;
  std::unique_ptr<dynamics::MultiplierCondensation> condensation_;  // of rows like pattern_
  linalg::Vector X_;
  std::vector<dynamics::BodyResponse> responses_;
  std::vector<Eigen::Matrix<double, 6, 1>> frame_moved_;
  std::vector<Eigen::VectorXd> interface_moved_;
};

}  // namespace buckens::analysis
