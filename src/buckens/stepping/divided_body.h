// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "buckens/linalg/nodal_vector.h"
#include "buckens/linalg/row_program.h"
#include "buckens/linalg/shared_store.h"
#include "buckens/model/state.h"
#include "buckens/stepping/body_responses.h"

namespace buckens::stepping {

class BodyStepOperator;

/// A large body whose n-sized vectors other processes have, which do with their rows what a step
/// does with them (linalg::DividedVectors): products with M and C, sieve and moments, coupling, and
/// the state at the end. The first process keeps sums. Of solids without constraints they work node
/// by node, of other bodies variable by variable.
class DividedBody {
 public:
  /// Null unless several processes share the factor of the body, which no given stresses stiffen.
  /// @param known where the vectors of the body may be found that it has for another length of step
  static std::shared_ptr<const DividedBody> make(const BodyStepOperator& op,
                                                 const body::FlexiblePart& part,
                                                 const BodyResponses& responses,
                                                 linalg::SharedStore* known);

  linalg::DividedVectors& vectors() const { return *vectors_; }
  linalg::DividedVector of(const linalg::NodalVector& x) const { return x.divided(vectors_); }
  linalg::NodalVector nodal(linalg::DividedVector x) const { return {vectors_, std::move(x)}; }

  /// Columns of the responses G to loads along rows, and of D − G of the interface, see
  /// BodyResponses.
  const std::vector<linalg::DividedVector>& G() const { return G_; }
  const std::vector<linalg::DividedVector>& D_less_G() const { return D_less_G_; }
  /// 1/K̂ᵢᵢ.
  const linalg::DividedVector& inverse_diagonal() const { return inverse_diagonal_; }
  /// Its root as kept pairs are scaled by it, see RecycledSolves.
  const linalg::DividedVector& scale() const { return scale_; }

  using Vector6 = Eigen::Matrix<double, 6, 1>;
  linalg::DividedVector multiply_mass(linalg::RowProgram& program,
                                      const linalg::DividedVector& x) const;
  linalg::DividedVector multiply_damping(linalg::RowProgram& program,
                                         const linalg::DividedVector& x) const;
  /// K d + C ḋ of the body.
  linalg::DividedVector elastic_load(linalg::RowProgram& program, const body::FlexiblePart& part,
                                     const linalg::DividedVector& d,
                                     const linalg::DividedVector& rate) const;
  /// Amplitudes of rigid motions, as many as there are, from the sums of RowProgram::moments(), and
  /// Φᵀf of loads from those of resultants().
  Vector6 rigid(const linalg::Vector& sums) const;
  /// Values along the patterns, from the same sums.
  Vector6 patterns(const linalg::Vector& sums) const;
  /// Those of two vectors, by one program.
  std::array<Vector6, 2> pattern_values(const linalg::NodalVector& x,
                                        const linalg::NodalVector& y) const;
  using Motion = std::array<double, linalg::kMotionNumbers>;
  /// Φ × amplitudes for RowProgram::subtract(), and P × amplitudes for subtract_load().
  Motion motion(const Eigen::Ref<const Eigen::VectorXd>& rigid) const;
  /// Adds Σ weight × pattern to a load.
  void add_patterns(linalg::RowProgram& program, const linalg::DividedVector& load,
                    const Vector6& weights) const;

  /// x + factor × G × load.
  linalg::NodalVector plus_answer(const linalg::NodalVector& x, const Eigen::VectorXd& load,
                                  double factor) const;
  /// Values along the rows of N, and of the patterns if the state uses them.
  void row_values(const BodyStepOperator& op, const model::BodyState& state, linalg::Vector& y,
                  linalg::Vector& y_dot, linalg::Vector& y_ddot, linalg::Vector& y_alg) const;

 private:
  DividedBody(const BodyStepOperator& op, const body::FlexiblePart& part,
              const BodyResponses& responses, linalg::SharedStore* known);

  const body::NodalMotion* nodal_;  // null: variable by variable
  linalg::SharedRowOrder order_;    // that of the factor, of all that is divided here
  // Copies: where M or C is brought here, their rows stay with the others, too.
  linalg::SymmetricMatrix M_, C_;
  std::shared_ptr<linalg::DividedVectors> vectors_;
  std::vector<linalg::DividedVector> G_, D_less_G_;
  linalg::DividedVector inverse_diagonal_, scale_;
};

/// Moments quadratic in d of the terms that are kept, from the sums of RowProgram::couple().
body::DeformedMoments quadratic_moments(const body::CouplingTerms& kept,
                                        const linalg::Vector& sums);

}  // namespace buckens::stepping
