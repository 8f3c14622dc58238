// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/divided_body.h"

#include <algorithm>
#include <array>
#include <utility>

#include "buckens/stepping/body_step_operator.h"

namespace buckens::stepping {

using linalg::DividedVector;
using linalg::RowProgram;
using linalg::Vector;

std::shared_ptr<const DividedBody> DividedBody::make(const BodyStepOperator& op,
                                                     const body::FlexiblePart& part,
                                                     const BodyResponses& responses) {
  const linalg::Factor* factor = op.shared_factor();
  const InertialLoad& inertial = op.inertial();
  const bool suits = factor != nullptr && factor->solves_divided() && op.nodal() != nullptr &&
                     !op.is_quasi_static() && inertial.is_by_node() &&
                     (!inertial.is_damped() || inertial.is_proportional()) &&
                     part.geometric == nullptr;
  if (!suits) return nullptr;
  return std::shared_ptr<const DividedBody>(new DividedBody(op, part, responses));
}

DividedBody::DividedBody(const BodyStepOperator& op, const body::FlexiblePart& part,
                         const BodyResponses& responses) {
  vectors_ = std::make_shared<linalg::DividedVectors>(
      linalg::DividedVectors::Tables{&op.nodal()->scalar_mass(), &op.nodal()->positions(),
                                     &op.nodal()->mass_moments(), &part.rows});
  const auto put_columns = [&](const linalg::Matrix& columns, std::vector<DividedVector>& out) {
    for (Eigen::Index k = 0; k < columns.cols(); ++k) out.push_back(vectors_->put(columns.col(k)));
  };
  put_columns(responses.G, G_);
  put_columns(responses.D_less_G, D_less_G_);
  inverse_diagonal_ = vectors_->put(op.K_hat_diagonal().cwiseInverse());
}

void DividedBody::row_values(const BodyStepOperator& op, const model::BodyState& state, Vector& y,
                             Vector& y_dot, Vector& y_ddot, Vector& y_alg) const {
  const std::array<DividedVector, 4> past = {of(state.d), of(state.d_dot), of(state.d_ddot),
                                             of(state.d_alg)};
  const bool uses_patterns = op.has_patterns() && state.terms.use_patterns();
  RowProgram program(*vectors_);
  const RowProgram::Sums products = program.row_products({&past[0], &past[1], &past[2], &past[3]});
  std::array<RowProgram::Sums, 4> moments;
  for (std::size_t k = 0; uses_patterns && k < 4; ++k) moments[k] = program.moments(past[k]);
  program.run();
  const Vector of_rows = program.sum(products);
  const Eigen::Index interface = op.num_interface_rows();
  const std::array<Vector*, 4> out = {&y, &y_dot, &y_ddot, &y_alg};
  for (std::size_t k = 0; k < 4; ++k) {
    out[k]->setZero(op.num_rows());
    const Eigen::Index first = static_cast<Eigen::Index>(k) * vectors_->num_rows();
    out[k]->head(interface) = of_rows.segment(first, interface);
    if (!uses_patterns) continue;
    out[k]->tail<6>() = body::NodalMotion::patterns(node_sums(program.sum(moments[k])));
  }
}

Vector DividedBody::answer(const Eigen::VectorXd& load, double factor) const {
  std::vector<std::pair<double, const DividedVector*>> terms;
  for (Eigen::Index k = 0; k < load.size(); ++k) {
    terms.emplace_back(factor * load[k], &G_[static_cast<std::size_t>(k)]);
  }
  RowProgram program(*vectors_);
  const DividedVector sum = program.combine(terms);
  program.run();
  Vector out;
  vectors_->take(sum, out);
  return out;
}

linalg::NodeSums node_sums(const Vector& sums) {
  linalg::NodeSums out;
  std::copy(sums.begin(), sums.end(), out.value);
  return out;
}

}  // namespace buckens::stepping
