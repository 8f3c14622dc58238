// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/base/task_pool.h"
#include "buckens/linalg/matrix_types.h"
#include "buckens/model/state.h"
#include "buckens/stepping/scheme.h"
#include "buckens/stepping/small_body_answers.h"

namespace buckens::stepping {

/// Response of a flexible body to loads within a step, as used by the iteration of frames and
/// joints: small matrices between the rows of its interface, FM (42), and the values of these rows
/// at the start of a step.
///
/// G = Y K̂⁻¹ Nᵀ is the response to unit loads along the rows N, and D that to a load of the
/// position correction. The rows are those of the interface and, unless the coupling keeps nothing
/// at all, the six patterns c_ab. The owner of the mesh and its factor fills the matrices at
/// set-up: BodyStepOperator does so in this process.
class BodyAnswer {
 public:
  virtual ~BodyAnswer() = default;

  /// N d, N ḋ, N d̈ and N times the algorithmic accelerations; patterns that the body's terms do
  /// not use may be zero.
  /// @param pool processes the rows of large bodies in parallel, with the same result
  virtual void row_values(const model::BodyState& state, linalg::Vector& y, linalg::Vector& y_dot,
                          linalg::Vector& y_ddot, linalg::Vector& y_alg,
                          TaskPool* pool = nullptr) const = 0;

  /// Rows of the interface, then the six patterns.
  Eigen::Index num_rows() const { return compliance_.rows(); }
  Eigen::Index num_interface_rows() const { return interface_.rows(); }
  /// N G: values of all rows per load along each, before the factor c.
  const linalg::Matrix& compliance() const { return compliance_; }
  /// The same between rows of the interface only: what joints need.
  const linalg::Matrix& interface_compliance() const { return interface_; }
  /// N D − N G: the change of the interface values by a correction load besides the correction
  /// itself. Zero where corrects_outside().
  const linalg::Matrix& correction_answer() const { return correction_; }
  /// compliance() and correction_answer() of a body with fewer variables than rows; else empty.
  const SmallBodyAnswers& small_answers() const { return small_; }
  /// Whether the equations hold where the position correction does not appear: then D = G.
  bool corrects_outside() const { return scheme_.weight != 1.0; }
  /// Whether the body deforms without rates.
  bool is_quasi_static() const { return is_quasi_static_; }
  const Scheme& scheme() const { return scheme_; }

 protected:
  BodyAnswer(const Scheme& scheme, bool is_quasi_static)
      : scheme_(scheme), is_quasi_static_(is_quasi_static) {}

  Scheme scheme_;
  bool is_quasi_static_;
  linalg::Matrix compliance_, interface_, correction_;
  SmallBodyAnswers small_;
};

}  // namespace buckens::stepping
