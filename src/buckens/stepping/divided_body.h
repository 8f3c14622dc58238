// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "buckens/linalg/divided_vectors.h"
#include "buckens/linalg/nodal_vector.h"
#include "buckens/model/state.h"
#include "buckens/stepping/body_responses.h"

namespace buckens::stepping {

class BodyStepOperator;

/// A large solid whose n-sized vectors other processes have, which do with their rows what a step
/// does with them (linalg::DividedVectors): products with M, sieve and moments, coupling, and the
/// state at the end. The first process keeps sums.
class DividedBody {
 public:
  /// Null unless several processes share the factor of the body and its mass matrix acts node by
  /// node: damped in proportion or not at all, without stiffening by given stresses.
  static std::shared_ptr<const DividedBody> make(const BodyStepOperator& op,
                                                 const body::FlexiblePart& part,
                                                 const BodyResponses& responses);

  linalg::DividedVectors& vectors() const { return *vectors_; }
  linalg::DividedVector of(const linalg::NodalVector& x) const { return x.divided(vectors_); }
  linalg::NodalVector nodal(linalg::DividedVector x) const { return {vectors_, std::move(x)}; }

  /// Columns of the responses G to loads along rows, and of D − G of the interface, see
  /// BodyResponses.
  const std::vector<linalg::DividedVector>& G() const { return G_; }
  const std::vector<linalg::DividedVector>& D_less_G() const { return D_less_G_; }
  /// 1/K̂ᵢᵢ.
  const linalg::DividedVector& inverse_diagonal() const { return inverse_diagonal_; }

  /// factor × G × load, brought here.
  linalg::Vector answer(const Eigen::VectorXd& load, double factor) const;
  /// Values along the rows of N, and of the patterns if the state uses them.
  void row_values(const BodyStepOperator& op, const model::BodyState& state, linalg::Vector& y,
                  linalg::Vector& y_dot, linalg::Vector& y_ddot, linalg::Vector& y_alg) const;

 private:
  DividedBody(const BodyStepOperator& op, const body::FlexiblePart& part,
              const BodyResponses& responses);

  std::shared_ptr<linalg::DividedVectors> vectors_;
  std::vector<linalg::DividedVector> G_, D_less_G_;
  linalg::DividedVector inverse_diagonal_;
};

/// Moments of a whole body from the sums that RowProgram::moments() brings.
linalg::NodeSums node_sums(const linalg::Vector& sums);

}  // namespace buckens::stepping
