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

  /// Work of two sets of nodal loads on each field, in one pass over the nodes.
  std::array<Vector, 2> work(const Vector& first, const Vector& second) const {
    std::array<LoadSums, 2> sums{LoadSums(*this, first), LoadSums(*this, second)};
    for (std::size_t node = 0; node < fe_->nodes.size(); ++node) {
      const Powers at = powers(node);
      std::array<Vector3d, 2> forces;
      bool turns = false;
      for (std::size_t k = 0; k < 2; ++k) turns = sums[k].read(node, forces[k]) || turns;
      for (std::size_t m = 0; m < monomials_.size(); ++m) {
        const double monomial = at.monomial(monomials_[m]);
        for (std::size_t k = 0; k < 2; ++k) sums[k].of_monomials[m] += monomial * forces[k];
      }
      for (std::size_t k = 0; turns && k < 2; ++k) sums[k].add_moments(at);
    }
    return {sums[0].of_fields(), sums[1].of_fields()};
  }

 private:
  using Vector6 = Eigen::Matrix<double, 6, 1>;

  /// Of one set of loads.
  class LoadSums {
   public:
    LoadSums(const FieldsAtNodes& fields, const Vector& loads)
        : of_monomials(fields.monomials_.size(), Vector3d::Zero()),
          fields_(&fields),
          loads_(&loads),
          of_moments_(Vector::Zero(fields.count())) {}

    /// @param force in principal axes @return whether the node has rotations
    bool read(std::size_t node, Vector3d& force) {
      Vector6 f = Vector6::Zero();
      bool turns = false;
      fields_->visit_dofs(node, [&](int dof, Eigen::Index k) {
        f[k] = (*loads_)[dof];
        turns = turns || k >= 3;
      });
      force = fields_->length_ * fields_->axes_.transpose() * f.head<3>();
      moment_ = f.tail<3>();
      return turns;
    }
    /// Of the node that was read last.
    void add_moments(const Powers& at) {
      const Vector3d moment = 0.5 * fields_->axes_.transpose() * moment_;
      for (Eigen::Index k = 0; k < fields_->count(); ++k) {
        const SmoothField& field = fields_->fields_[static_cast<std::size_t>(k)];
        of_moments_[k] += at.gradient(field.powers).cross(Vector3d::Unit(field.axis)).dot(moment);
      }
    }
    /// Fields along three axes have a monomial in common: sums of forces times each.
    Vector of_fields() const {
      Vector out = of_moments_;
      for (Eigen::Index k = 0; k < fields_->count(); ++k) {
        const SmoothField& field = fields_->fields_[static_cast<std::size_t>(k)];
        const auto m =
            std::ranges::find(fields_->monomials_, field.powers) - fields_->monomials_.begin();
        out[k] += of_monomials[static_cast<std::size_t>(m)][field.axis];
      }
      return out;
    }

    std::vector<Vector3d> of_monomials;

   private:
    const FieldsAtNodes* fields_;
    const Vector* loads_;
    Vector3d moment_ = Vector3d::Zero();
    Vector of_moments_;
  };

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
    const auto work = fields.work(with_M, with_K);
    M.col(k) = work[0];
    K.col(k) = work[1];
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
