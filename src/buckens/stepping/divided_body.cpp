// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/divided_body.h"

#include <algorithm>
#include <array>
#include <utility>

#include "buckens/body/deformation_coupling.h"
#include "buckens/linalg/row_order.h"
#include "buckens/stepping/body_step_operator.h"

namespace buckens::stepping {

using linalg::DividedVector;
using linalg::RowProgram;
using linalg::Vector;

namespace {

std::shared_ptr<linalg::DividedVectors> vectors_of(const BodyStepOperator& op,
                                                   const body::FlexiblePart& part) {
  const linalg::SharedRowOrder order = op.shared_factor()->row_order();
  if (const body::NodalMotion* nodal = op.nodal()) {
    return std::make_shared<linalg::DividedVectors>(
        // That of the body itself: an equal body, whose nodal tables it may read, has let go of
        // its.
        linalg::WholeNodes{part.fe.shape.nodal.Ms.get(), &nodal->positions(),
                           &nodal->mass_moments(), order},
        part.rows);
  }
  const fem::ShapeIntegrals& shape = part.fe.shape;
  return std::make_shared<linalg::DividedVectors>(
      linalg::WholeVariables{&shape.W, shape.nodal.Ms.get(), &shape.nodal.dofs,
                             &part.sieve.stored_Phi(), &part.sieve.stored_P(),
                             &part.invariants.stored_patterns(), order},
      part.rows);
}

/// Those of a body, whatever the length of its steps.
struct KnownVectors {
  const body::FlexiblePart* part;
  linalg::SharedRowOrder order;
  std::shared_ptr<linalg::DividedVectors> vectors;
};

/// They are known as long as a state or an operator has one of them.
std::shared_ptr<linalg::DividedVectors> vectors_of(const BodyStepOperator& op,
                                                   const body::FlexiblePart& part,
                                                   linalg::SharedStore& known) {
  const linalg::SharedRowOrder order = op.shared_factor()->row_order();
  const auto own = known.find_or_make<KnownVectors>(
      [&](const KnownVectors& of) {
        return of.part == &part && linalg::is_same_order(of.order, order);
      },
      [&] {
        return std::make_shared<const KnownVectors>(
            KnownVectors{&part, order, vectors_of(op, part)});
      });
  return {own, own->vectors.get()};
}

}  // namespace

std::shared_ptr<const DividedBody> DividedBody::make(const BodyStepOperator& op,
                                                     const body::FlexiblePart& part,
                                                     const BodyResponses& responses,
                                                     linalg::SharedStore* known) {
  const linalg::Factor* factor = op.shared_factor();
  const InertialLoad& inertial = op.inertial();
  const bool suits = factor != nullptr && factor->solves_divided() && !op.is_quasi_static() &&
                     (op.nodal() != nullptr ? inertial.is_by_node() : part.fe.M.is_divided()) &&
                     (!inertial.is_damped() || inertial.is_proportional() || part.C.is_divided()) &&
                     part.geometric == nullptr;
  if (!suits) return nullptr;
  return std::shared_ptr<const DividedBody>(new DividedBody(op, part, responses, known));
}

DividedBody::DividedBody(const BodyStepOperator& op, const body::FlexiblePart& part,
                         const BodyResponses& responses, linalg::SharedStore* known)
    : nodal_(op.nodal()),
      order_(op.shared_factor()->row_order()),
      vectors_(known != nullptr ? vectors_of(op, part, *known) : vectors_of(op, part)) {
  if (nodal_ == nullptr) M_ = part.fe.M;
  if (op.inertial().is_damped() && !op.inertial().is_proportional()) C_ = part.C;
  const auto put_columns = [&](const linalg::Matrix& columns, std::vector<DividedVector>& out) {
    for (Eigen::Index k = 0; k < columns.cols(); ++k) out.push_back(vectors_->put(columns.col(k)));
  };
  put_columns(responses.G, G_);
  put_columns(responses.D_less_G, D_less_G_);
  const Vector inverse = op.K_hat_diagonal().cwiseInverse();
  inverse_diagonal_ = vectors_->put(inverse);
  scale_ = vectors_->put(inverse.cwiseSqrt().cast<float>().cast<double>());
}

DividedVector DividedBody::multiply_mass(RowProgram& program, const DividedVector& x) const {
  return nodal_ != nullptr ? program.multiply_mass(x) : program.multiply(M_.divide(order_), x);
}

DividedVector DividedBody::multiply_damping(RowProgram& program, const DividedVector& x) const {
  return program.multiply(C_.divide(order_), x);
}

DividedVector DividedBody::elastic_load(RowProgram& program, const body::FlexiblePart& part,
                                        const DividedVector& d, const DividedVector& rate) const {
  DividedVector out = program.multiply(part.fe.K.divide(order_), d);
  if (part.is_damped()) {
    const DividedVector of_damping = program.multiply(part.C.divide(order_), rate);
    const std::pair<double, const DividedVector*> term = {1.0, &of_damping};
    program.add(out, {&term, 1});
  }
  return out;
}

DividedBody::Vector6 DividedBody::rigid(const Vector& sums) const {
  return nodal_ != nullptr ? nodal_->rigid(linalg::node_sums(sums)) : Vector6(sums.head<6>());
}

DividedBody::Vector6 DividedBody::patterns(const Vector& sums) const {
  return nodal_ != nullptr ? body::NodalMotion::patterns(linalg::node_sums(sums))
                           : Vector6(sums.segment<6>(linalg::kPatternSums));
}

std::array<DividedBody::Vector6, 2> DividedBody::pattern_values(
    const linalg::NodalVector& x, const linalg::NodalVector& y) const {
  RowProgram program(*vectors_);
  const RowProgram::Sums of_x = program.moments(of(x));
  const RowProgram::Sums of_y = program.moments(of(y));
  program.run();
  return {patterns(program.sum(of_x)), patterns(program.sum(of_y))};
}

DividedBody::Motion DividedBody::motion(const Eigen::Ref<const Eigen::VectorXd>& rigid) const {
  Motion out{};
  if (nodal_ != nullptr) {
    Eigen::Map<Eigen::Matrix4d>(out.data()) = nodal_->motion(rigid);
  } else {
    std::copy(rigid.begin(), rigid.end(), out.begin());
  }
  return out;
}

void DividedBody::add_patterns(RowProgram& program, const DividedVector& load,
                               const Vector6& weights) const {
  if (weights.isZero(0.0)) return;
  Motion out{};
  if (nodal_ != nullptr) {
    Eigen::Map<Eigen::Matrix4d>(out.data()) = body::NodalMotion::pattern_motion(weights);
  } else {
    Eigen::Map<Vector6>(out.data() + linalg::kPatternSums) = -weights;
  }
  program.subtract_load(load, out.data());
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
    out[k]->tail<6>() = patterns(program.sum(moments[k]));
  }
}

linalg::NodalVector DividedBody::plus_answer(const linalg::NodalVector& x,
                                             const Eigen::VectorXd& load, double factor) const {
  const DividedVector there = of(x);
  std::vector<std::pair<double, const DividedVector*>> terms = {{1.0, &there}};
  for (Eigen::Index k = 0; k < load.size(); ++k) {
    terms.emplace_back(factor * load[k], &G_[static_cast<std::size_t>(k)]);
  }
  RowProgram program(*vectors_);
  const DividedVector sum = program.combine(terms);
  program.run();
  return nodal(sum);
}

body::DeformedMoments quadratic_moments(const body::CouplingTerms& kept, const Vector& sums) {
  body::DeformedMoments out;
  if (kept.quad_ref) out = body::deformed_moments(linalg::node_sums(sums));
  if (!kept.jvar) out.J.setZero();
  if (!kept.cor_ref) out.J_dot.setZero();
  return out;
}

}  // namespace buckens::stepping
