// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/smooth_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "buckens/spatial/principal_axes.h"
#include "buckens/stepping/least_quotient.h"

namespace buckens::stepping {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using linalg::Matrix;
using linalg::Vector;

namespace {

// Sieved vectors of less than this share of what they were are rounding of rigid motion.
constexpr double kRigid = 1e-10;
// Bodies whose least principal inertia is below this share of the largest are slender.
constexpr double kSlender = 0.1;
// Degree of polynomials in all directions, and along slender bodies.
constexpr int kMostAcross = 3;
constexpr int kMostAlong = 7;

/// A displacement along a principal axis of inertia by a monomial of the principal coordinates.
struct SmoothField {
  std::array<int, 3> powers;
  int axis;
};

/// @param inertia principal ones, ascending: the first axis is along the body
std::vector<SmoothField> smooth_fields(const Vector3d& inertia) {
  std::vector<SmoothField> out;
  for (int degree = 1; degree <= kMostAcross; ++degree) {
    for (int i = degree; i >= 0; --i) {
      for (int j = degree - i; j >= 0; --j) {
        for (int axis = 0; axis < 3; ++axis) out.push_back({{i, j, degree - i - j}, axis});
      }
    }
  }
  if (inertia[0] > kSlender * inertia[2]) return out;
  for (int degree = kMostAcross + 1; degree <= kMostAlong; ++degree) {
    for (int axis = 0; axis < 3; ++axis) out.push_back({{degree, 0, 0}, axis});
    out.push_back({{degree - 1, 1, 0}, 0});  // sections turn
    out.push_back({{degree - 1, 0, 1}, 0});
  }
  return out;
}

/// Powers of three coordinates from 0 up.
class Powers {
 public:
  explicit Powers(const Vector3d& p) {
    for (int axis = 0; axis < 3; ++axis) {
      of_[axis][0] = 1;
      for (int k = 1; k <= kMostAlong; ++k) of_[axis][k] = of_[axis][k - 1] * p[axis];
    }
  }
  double monomial(const std::array<int, 3>& powers) const {
    return of_[0][powers[0]] * of_[1][powers[1]] * of_[2][powers[2]];
  }
  Vector3d gradient(const std::array<int, 3>& powers) const {
    Vector3d out = Vector3d::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      if (powers[k] == 0) continue;
      std::array<int, 3> lower = powers;
      --lower[k];
      out[static_cast<Eigen::Index>(k)] = powers[k] * monomial(lower);
    }
    return out;
  }

 private:
  double of_[3][kMostAlong + 1];
};

/// Fields at the nodes of a body, rotations by half their curl. Nodal values are formed when they
/// are asked for: those of all fields would be as large as tens of vectors.
class FieldsAtNodes {
 public:
  explicit FieldsAtNodes(const body::FlexiblePart& part) : fe_(&part.fe), size_(part.num_dofs()) {
    const spatial::PrincipalAxes principal = spatial::principal_axes(fe_->shape.J0);
    axes_ = principal.vectors;
    axes_.col(2) = axes_.col(0).cross(axes_.col(1));  // curls ask for a right-handed system
    // Lengths of one keep high and low powers comparable.
    length_ = std::sqrt(0.5 * fe_->shape.J0.trace() / fe_->shape.mass);
    fields_ = smooth_fields(principal.values);
    for (const SmoothField& field : fields_) {
      if (std::ranges::find(monomials_, field.powers) != monomials_.end()) continue;
      monomials_.push_back(field.powers);
    }
  }

  Eigen::Index count() const { return std::ssize(fields_); }

  /// Nodal values of a sum of fields.
  Vector values(const Vector& weights) const {
    Vector out = Vector::Zero(size_);
    std::vector<Eigen::Index> some;
    for (Eigen::Index k = 0; k < count(); ++k) {
      if (weights[k] != 0.0) some.push_back(k);
    }
    for (std::size_t node = 0; node < fe_->nodes.size(); ++node) {
      const Powers at = powers(node);
      Vector6 u = Vector6::Zero();  // in principal axes
      for (const Eigen::Index k : some) {
        const SmoothField& field = fields_[static_cast<std::size_t>(k)];
        const Vector3d along = Vector3d::Unit(field.axis);
        u.head<3>() += weights[k] * length_ * at.monomial(field.powers) * along;
        u.tail<3>() += weights[k] * 0.5 * at.gradient(field.powers).cross(along);
      }
      u << axes_ * u.head<3>(), axes_ * u.tail<3>();
      visit_dofs(node, [&](int dof, Eigen::Index k) { out[dof] = u[k]; });
    }
    return out;
  }

  /// Work of nodal loads on each field.
  Vector work(const Vector& loads) const {
    Vector out = Vector::Zero(count());
    // Fields along three axes have a monomial in common: sums of forces times each.
    std::vector<Vector3d> sums(monomials_.size(), Vector3d::Zero());
    for (std::size_t node = 0; node < fe_->nodes.size(); ++node) {
      Vector6 f = Vector6::Zero();
      bool turns = false;
      visit_dofs(node, [&](int dof, Eigen::Index k) {
        f[k] = loads[dof];
        turns = turns || k >= 3;
      });
      const Powers at = powers(node);
      const Vector3d force = length_ * axes_.transpose() * f.head<3>();
      for (std::size_t m = 0; m < sums.size(); ++m) sums[m] += at.monomial(monomials_[m]) * force;
      if (!turns) continue;
      const Vector3d moment = 0.5 * axes_.transpose() * f.tail<3>();
      for (Eigen::Index k = 0; k < count(); ++k) {
        const SmoothField& field = fields_[static_cast<std::size_t>(k)];
        out[k] += at.gradient(field.powers).cross(Vector3d::Unit(field.axis)).dot(moment);
      }
    }
    for (Eigen::Index k = 0; k < count(); ++k) {
      const SmoothField& field = fields_[static_cast<std::size_t>(k)];
      const auto m = std::ranges::find(monomials_, field.powers) - monomials_.begin();
      out[k] += sums[static_cast<std::size_t>(m)][field.axis];
    }
    return out;
  }

 private:
  using Vector6 = Eigen::Matrix<double, 6, 1>;

  Powers powers(std::size_t node) const {
    return Powers(axes_.transpose() * (fe_->nodes[node].position - fe_->shape.com) / length_);
  }
  /// visit(variable, which of the six of the node)
  template <class Visit>
  void visit_dofs(std::size_t node, Visit&& visit) const {
    for (std::size_t k = 0; k < 6; ++k) {
      const int dof = fe_->dofs.node_dofs[node][k];
      if (dof >= 0 && dof < size_) visit(dof, static_cast<Eigen::Index>(k));
    }
  }

  const fem::FeModel* fe_;
  Eigen::Index size_;
  Matrix3d axes_;
  double length_ = 1;
  std::vector<SmoothField> fields_;
  std::vector<std::array<int, 3>> monomials_;  // those of all fields
};

/// Fields that are more than rigid motion, and of these, sieved, XᵀMX and XᵀKX.
struct Projections {
  std::vector<Eigen::Index> fields;
  Matrix M, K;
};

Projections projections(const body::FlexiblePart& part, const FieldsAtNodes& fields,
                        TaskPool* pool) {
  const Eigen::Index count = fields.count();
  Matrix M(count, count), K(count, count);
  std::vector<char> is_kept(static_cast<std::size_t>(count));
  run_tasks(pool, static_cast<int>(count), [&](int k) {
    Vector x = fields.values(Vector::Unit(count, k));
    const double before = x.norm();
    part.sieve.apply(x);
    if (!(x.norm() > kRigid * before)) return;
    is_kept[static_cast<std::size_t>(k)] = true;
    Vector with_M, with_K;
    linalg::multiply({{&part.fe.M, &x, &with_M}, {&part.fe.K, &x, &with_K}});
    // (Y p)ᵀ A x = pᵀ (Yᵀ A x) for each field p.
    part.sieve.apply_transposed(with_M);
    part.sieve.apply_transposed(with_K);
    M.col(k) = fields.work(with_M);
    K.col(k) = fields.work(with_K);
  });
  std::vector<Eigen::Index> kept;
  for (Eigen::Index k = 0; k < count; ++k) {
    if (is_kept[static_cast<std::size_t>(k)]) kept.push_back(k);
  }
  return {kept, M(kept, kept), K(kept, kept)};
}

/// Whether several threads may multiply by the matrices of a body at a time: other processes take
/// one order after the other, and a matrix without entries here forms them when it is asked.
bool allows_threads(const body::FlexiblePart& part) {
  const auto allows = [](const linalg::SymmetricMatrix& A) {
    return A.is_formed() || A.nodes() != nullptr || A.blocks() != nullptr;
  };
  return allows(part.fe.M) && allows(part.fe.K);
}

}  // namespace

Vector smooth_shape(const body::FlexiblePart& part, TaskPool* pool) {
  const FieldsAtNodes fields(part);
  const Projections of = projections(part, fields, allows_threads(part) ? pool : nullptr);
  Vector weights = Vector::Zero(fields.count());
  weights(of.fields) = least_combination(of.M, of.K);
  Vector out = fields.values(weights);
  part.sieve.apply(out);
  return out;
}

}  // namespace buckens::stepping
