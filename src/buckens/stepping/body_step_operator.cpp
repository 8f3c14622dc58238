// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/body_step_operator.h"

#include <utility>

#include "buckens/base/timed_phase.h"
#include "buckens/body/mesh_solver.h"
#include "buckens/linalg/node_blocks.h"
#include "buckens/linalg/same_bits.h"

namespace buckens::stepping {

using linalg::Matrix;
using linalg::SparseMatrix;
using linalg::Vector;

namespace {

// Up to this size the dense inverse is quicker than a sparse solve and as accurate.
constexpr Eigen::Index kSmall = SmallBodyAnswers::kMostVariables;
constexpr Eigen::Index kNumPatterns = 6;

linalg::MatrixSum step_matrix(const body::FlexiblePart& part, const Scheme& scheme) {
  linalg::MatrixSum K_hat;
  K_hat.add(scheme.mass, part.fe.M);
  K_hat.add(scheme.stiffness, part.fe.K);
  if (part.is_damped()) K_hat.add(scheme.damping, part.C);
  return K_hat;
}

InterfaceRows interface_rows_of(const body::FlexiblePart& part) {
  return part.rows.topRows(part.num_interface_rows);
}

/// Whether K̂ is diagonal and nothing has to be sieved, as for reduced bodies.
bool is_division_enough(const body::FlexiblePart& part, const linalg::MatrixSum& sum) {
  if (part.sieve.rank() > 0) return false;
  const SparseMatrix K_hat = sum.whole();
  if (K_hat.nonZeros() != K_hat.rows()) return false;
  for (int j = 0; j < K_hat.outerSize(); ++j) {
    const SparseMatrix::InnerIterator entry(K_hat, j);
    if (!entry || entry.row() != j) return false;
  }
  return true;
}

bool have_one_matrix(const Scheme& a, const Scheme& b) {
  return a.mass == b.mass && a.damping == b.damping && a.stiffness == b.stiffness;
}

bool have_same_rigid_modes(const body::FlexiblePart& a, const body::FlexiblePart& b) {
  return a.sieve.rank() == b.sieve.rank() && a.sieve.stored_Phi() == b.sieve.stored_Phi() &&
         a.sieve.stored_P() == b.sieve.stored_P() &&
         a.invariants.stored_patterns() == b.invariants.stored_patterns();
}

}  // namespace

bool BodyStepOperator::fits(const body::FlexiblePart& part) const {
  return part.solver == part_->solver && part.fe.M == part_->fe.M && part.fe.K == part_->fe.K &&
         part.C == part_->C;
}

bool BodyStepOperator::serves(const body::FlexiblePart& part) const {
  if (part.num_dofs() > kSmall || !fits(part)) return false;
  if (part.is_quasi_static != is_quasi_static_ || part.fe.mass_damping != part_->fe.mass_damping ||
      part.num_interface_rows != part_->num_interface_rows ||
      part.coupling.may_use_patterns() != part_->coupling.may_use_patterns()) {
    return false;
  }
  return have_same_rigid_modes(part, *part_) && linalg::have_same_bits(interface_rows_of(part), N_);
}

BodyStepOperator::BodyStepOperator(const body::FlexiblePart& part, const Scheme& scheme,
                                   const FactorSource& source)
    : BodyAnswer(scheme, part.is_quasi_static),
      part_(&part),
      N_(interface_rows_of(part)),
      has_patterns_(part.coupling.may_use_patterns()),
      inertial_(part, scheme) {
  {
    const linalg::MatrixSum K_hat = step_matrix(part, scheme);
    diagonal_ = K_hat.diagonal();
    if (is_division_enough(part, K_hat)) {
      diagonal_inverse_ = diagonal_.cwiseInverse();
    } else {
      find_factor(K_hat, source);
    }
  }
  if (!is_diagonal() && part.num_dofs() <= kSmall) {
    inverse_ = factor_->solve(Matrix::Identity(part.num_dofs(), part.num_dofs()));
    part.sieve.apply(inverse_);
  }
  find_nodal(source);
  find_responses(source);
  find_row_answers();
  rigid_row_values_ = row_values(part.sieve.Phi());
  if (inverse_.size() > 0 && part.num_dofs() < num_rows()) small_ = answers_by_variables();
  divide(source.vectors);
  find_common(source);
}

void BodyStepOperator::find_row_answers() {
  const Eigen::Index interface = part_->num_interface_rows;
  compliance_ = row_values(responses_->G);
  interface_ = compliance_.topLeftCorner(interface, interface);
  correction_ = Matrix::Zero(compliance_.rows(), compliance_.cols());
  if (scheme_.weight == 1.0) correction_.leftCols(interface) = row_values(responses_->D_less_G);
}

/// Gives the responses to other processes if they do the work on the body's vectors.
void BodyStepOperator::divide(linalg::SharedStore* known) {
  divided_ = DividedBody::make(*this, *part_, *responses_, known);
  if (!divided_) return;
  auto left = std::make_shared<BodyResponses>();
  left->source = responses_->source;
  responses_ = std::move(left);
}

void BodyStepOperator::find_nodal(const FactorSource& source) {
  static_assert(kSmall < body::NodalMotion::kFewestVariables);
  static_assert(kSmall < linalg::NodeBlocks::kFewestVariables, "M and C are formed");
  nodal_ = part_->nodal_motion;
  if (!nodal_) return;
  if (source.twin != nullptr && source.twin->nodal_ && *source.twin->nodal_ == *nodal_) {
    nodal_ = source.twin->nodal_;
  } else if (source.exchange != nullptr) {
    nodal_ = source.exchange->common().find_or_make<body::NodalMotion>(
        [this](const body::NodalMotion& known) { return known == *nodal_; },
        [this] { return nodal_; });
  }
}

/// Passes over the rows read the scalar mass matrix of a solid here, unless others make them.
void BodyStepOperator::find_common(const FactorSource& source) {
  if (!nodal_) return;
  if (divided_) {
    nodal_->scalar_mass().let_go();
    part_->fe.shape.nodal.Ms.let_go();
    return;
  }
  common_ = {nodal_->mass(), nodal_.get(), source.exchange};
  inertial_.read_mass_from(nodal_->scalar_mass());
}

void BodyStepOperator::find_responses(const FactorSource& source) {
  const base::TimedPhase phase("responses");
  const BodyResponses::Source own(factor_.get(), nodal_.get(), *part_, N_, scheme_);
  const auto make = [&] { return make_responses(own); };
  // A twin whose vectors other processes have has given them its responses, and two bodies cannot
  // share those: threads may work on both at a time.
  if (!nodal_ || iterates() || (source.twin != nullptr && source.twin->divided_)) {
    responses_ = make();
  } else if (source.twin != nullptr && source.twin->responses_->source == own) {
    responses_ = source.twin->responses_;
  } else if (source.exchange != nullptr) {
    responses_ = source.exchange->common().find_or_make<BodyResponses>(
        [&](const BodyResponses& known) { return known.source == own; }, make);
  } else {
    responses_ = make();
  }
}

Matrix BodyStepOperator::row_values(const Eigen::Ref<const Matrix>& X) const {
  if (!has_patterns_) return N_ * X;
  Matrix out(N_.rows() + kNumPatterns, X.cols());
  out.topRows(N_.rows()) = N_ * X;
  for (Eigen::Index k = 0; k < X.cols(); ++k) {
    out.col(k).tail<kNumPatterns>() = part_->invariants.pattern_values(X.col(k));
  }
  return out;
}

Matrix BodyStepOperator::loads_along_rows() const {
  Matrix out(part_->num_dofs(), N_.rows() + (has_patterns_ ? kNumPatterns : 0));
  out.leftCols(N_.rows()) = N_.transpose();
  if (has_patterns_) out.rightCols<kNumPatterns>() = part_->invariants.centrifugal_patterns();
  return out;
}

std::shared_ptr<const BodyResponses> BodyStepOperator::make_responses(
    const BodyResponses::Source& source) {
  auto out = std::make_shared<BodyResponses>();
  out->source = source;
  out->G = loads_along_rows();
  solve_columns(out->G);
  if (scheme_.weight != 1.0) return out;
  // The strain answers the corrected position, the inertia does not: FM (37) with x⁺ shifted by
  // G e leaves Y K̂⁻¹ (m M + c C) G e.
  const Matrix interface = out->G.leftCols(part_->num_interface_rows);
  Matrix inertia = linalg::weighted_product(scheme_.mass, part_->fe.M, interface);
  if (part_->is_damped()) {
    inertia += linalg::weighted_product(scheme_.damping, part_->C, interface);
  }
  solve_columns(inertia);
  out->D_less_G = inertia - interface;
  return out;
}

SmallBodyAnswers BodyStepOperator::answers_by_variables() const {
  const Eigen::Index n = inverse_.rows();
  Matrix B = Matrix::Zero(n, n);
  if (scheme_.weight == 1.0) {  // as D − G in the constructor
    Matrix inertia = scheme_.mass * Matrix(part_->fe.M.whole());
    if (part_->is_damped()) inertia += scheme_.damping * Matrix(part_->C.whole());
    B = inverse_ * (inertia * inverse_) - inverse_;
  }
  return {InterfaceRows(loads_along_rows().transpose().sparseView()), inverse_, std::move(B)};
}

SparseMatrix BodyStepOperator::K_hat() const { return step_matrix(*part_, scheme_).whole(); }

void BodyStepOperator::find_factor(const linalg::MatrixSum& K_hat, const FactorSource& source) {
  const BodyStepOperator* twin = source.twin;
  if (twin != nullptr && twin->factor_ && have_one_matrix(scheme_, twin->scheme_) &&
      twin->fits(*part_)) {
    factor_ = twin->factor_;
    why_solver_ = twin->why_solver_;
    is_shared_ = true;
    part_->fe.M.share(twin->part_->fe.M);
    part_->fe.K.share(twin->part_->fe.K);
    part_->C.share(twin->part_->C);
    return;
  }
  const body::SolverDecision decision = body::decide_solver(part_->solver, K_hat);
  why_solver_ = decision.why;
  if (decision.iterates) {
    factor_ = body::make_iterative(*part_, K_hat);
  } else if (source.exchange != nullptr) {
    const long factorisations = source.exchange->num_factorisations();
    factor_ = source.exchange->factor(K_hat.whole());
    is_shared_ = source.exchange->num_factorisations() == factorisations;
  } else {
    factor_ = source.make ? source.make(K_hat) : linalg::make_large_factor(K_hat);
  }
}

void BodyStepOperator::solve_columns(Matrix& X) {
  if (is_diagonal()) {
    X = diagonal_inverse_.asDiagonal() * X;
  } else {
    factor_->solve_in_place(X);
    part_->sieve.apply(X);
  }
  setup_solves_ += X.cols();
}

void BodyStepOperator::solve_right_side(Vector& x, TaskPool* pool) {
  if (is_diagonal()) {
    x = x.cwiseProduct(diagonal_inverse_);
  } else if (inverse_.size() > 0) {
    const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kSmall, 1> side = x;
    x.noalias() = inverse_ * side;
  } else {
    factor_->solve_in_place(x, pool);
  }
}

void BodyStepOperator::solve(Vector& x, TaskPool* pool) {
  if (is_diagonal()) {
    x = x.cwiseProduct(diagonal_inverse_);
  } else {
    factor_->solve_in_place(x, pool);
    part_->sieve.apply(x);
  }
  ++setup_solves_;
}

void BodyStepOperator::add_answer(const Eigen::VectorXd& load, Eigen::Index first,
                                  Eigen::Ref<Vector> piece) const {
  // Patterns carry no load without coupling.
  const Eigen::Index interface = num_interface_rows();
  const bool uses_patterns = !load.tail(load.size() - interface).isZero(0.0);
  const Eigen::Index columns = uses_patterns ? load.size() : interface;
  BodyResponses::add_columns(responses_->G, load.head(columns), scheme_.force, first, piece);
}

void BodyStepOperator::add_correction(const Eigen::VectorXd& e, Eigen::Index first,
                                      Eigen::Ref<Vector> piece) const {
  BodyResponses::add_columns(responses_->G, e.head(num_interface_rows()), 1.0, first, piece);
}

void BodyStepOperator::add_correction_answer(const Eigen::VectorXd& e, Eigen::Index first,
                                             Eigen::Ref<Vector> piece) const {
  const Matrix& columns = responses_->D_less_G;
  BodyResponses::add_columns(columns, e.head(columns.cols()), 1.0, first, piece);
}

}  // namespace buckens::stepping
