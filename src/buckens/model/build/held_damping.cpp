// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/held_damping.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/linalg/dense_cholesky.h"
#include "buckens/linalg/pseudo_inverse.h"

namespace buckens::model {

using linalg::Matrix;
using linalg::SparseMatrix;
using linalg::Triplet;

namespace {

// Bodies around a damped one that answer its deformation; those beyond count as standing still.
constexpr std::size_t kMostAnswering = 60;
// Entries that the joints of one body may add to C.
constexpr double kMostEntries = 3e7;
// Dependent directions of frames against the largest, and entries of C that are rounding.
constexpr double kDependent = 1e-10;
constexpr double kRounding = 1e-14;

/// One joint equation seen from one body: derivatives by its frame and by its interface rows.
struct RowShare {
  std::size_t row = 0;
  Eigen::Matrix<double, 1, 6> frame;
  Eigen::Matrix<double, 1, 6> interface;
  const body::Marker* marker = nullptr;
};

/// Joint equations of the placed, undeformed model, body by body.
class PlacedRows {
 public:
  explicit PlacedRows(const Model& model) : model_(model), shares_(model.bodies.size()) {
    for (const Joint& joint : model.joints) {
      const auto first = kinematics(joint.first);
      const auto second = kinematics(joint.second);
      for (const joints::ConstraintRow& row : joint.rows) {
        const spatial::PairRow J = row.evaluate(first.motion, second.motion, 0.0).J;
        add(joint.first, first, J.head<6>());
        add(joint.second, second, J.tail<6>());
        ++count_;
      }
      if (joint.first.body == kGround || joint.second.body == kGround) continue;
      neighbours_.emplace_back(joint.first.body, joint.second.body);
    }
  }

  std::size_t count() const { return count_; }
  const std::vector<RowShare>& of(std::size_t body) const { return shares_[body]; }
  const std::vector<std::pair<int, int>>& neighbours() const { return neighbours_; }

 private:
  body::MarkerKinematics kinematics(const MarkerId& id) const {
    body::MarkerKinematics out;
    if (id.body == kGround) {
      out.motion.p = id.X_WF.p;
      out.motion.R = id.X_WF.R();
      return out;
    }
    const auto b = static_cast<std::size_t>(id.body);
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(model_.bodies[b].num_rows());
    body::FrameMotion frame;
    frame.X_WB = model_.placed[b];
    return body::marker_kinematics(marker(id), frame, zero, zero);
  }

  const body::Marker& marker(const MarkerId& id) const {
    return model_.bodies[static_cast<std::size_t>(id.body)]
        .markers[static_cast<std::size_t>(id.marker)];
  }

  void add(const MarkerId& id, const body::MarkerKinematics& k,
           const Eigen::Matrix<double, 1, 6>& J) {
    if (id.body == kGround) return;
    // A scalar with derivative J is the work of the wrench J on the marker.
    const spatial::Wrench unit{J.head<3>().transpose(), J.tail<3>().transpose()};
    shares_[static_cast<std::size_t>(id.body)].push_back(
        {count_, k.frame_load(unit).transpose(), k.interface_load(unit).transpose(), &marker(id)});
  }

  const Model& model_;
  std::vector<std::vector<RowShare>> shares_;
  std::vector<std::pair<int, int>> neighbours_;
  std::size_t count_ = 0;
};

/// Basis of a body's frame motions in which its kinetic energy is half the square.
Matrix unit_motions(const body::Body& body) {
  const auto turns = body.rotation_basis.cols();
  const auto shifts = body.translation_basis.cols();
  Matrix out = Matrix::Zero(6, turns + shifts);
  if (turns > 0) {
    const Eigen::MatrixXd J = body.rotation_basis.transpose() * body.J0 * body.rotation_basis;
    const linalg::DenseCholesky root(J);
    out.topLeftCorner(3, turns) =
        body.rotation_basis * root.solve_lower(Matrix::Identity(turns, turns)).transpose();
  }
  out.bottomRightCorner(3, shifts) = body.translation_basis / std::sqrt(body.mass);
  return out;
}

/// Bodies that joints connect with one, itself first, the nearest ones before the others.
std::vector<std::size_t> connected(const PlacedRows& rows, std::size_t body, std::size_t most) {
  std::vector<std::size_t> out = {body};
  for (std::size_t next = 0; next < out.size(); ++next) {
    for (const auto& [first, second] : rows.neighbours()) {
      const auto a = static_cast<std::size_t>(first), b = static_cast<std::size_t>(second);
      if (a != out[next] && b != out[next]) continue;
      const std::size_t other = a == out[next] ? b : a;
      if (out.size() < most && std::find(out.begin(), out.end(), other) == out.end()) {
        out.push_back(other);
      }
    }
  }
  return out;
}

/// B, r = −B d, in unit motions of the body's frame.
SparseMatrix answer_of_frame(const Model& model, const PlacedRows& rows, std::size_t body) {
  const std::vector<std::size_t> moving = connected(rows, body, kMostAnswering);
  std::vector<Matrix> units;
  Eigen::Index coordinates = 0;
  for (const std::size_t b : moving) {
    units.push_back(unit_motions(model.bodies[b]));
    coordinates += units.back().cols();
  }
  std::vector<int> local(rows.count(), -1);
  int count = 0;
  for (const std::size_t b : moving) {
    for (const RowShare& share : rows.of(b)) {
      if (local[share.row] < 0) local[share.row] = count++;
    }
  }
  Matrix G = Matrix::Zero(count, coordinates);
  Eigen::Index at = 0;
  for (std::size_t k = 0; k < moving.size(); ++k) {
    for (const RowShare& share : rows.of(moving[k])) {
      G.block(local[share.row], at, 1, units[k].cols()) += share.frame * units[k];
    }
    at += units[k].cols();
  }
  Eigen::VectorXd scale = G.rowwise().norm();
  scale = scale.unaryExpr([](double size) { return size > 0.0 ? 1.0 / size : 0.0; });
  linalg::PseudoInverse inverse(kDependent);
  inverse.compute(scale.asDiagonal() * G);
  const Matrix answer = inverse.whole().topRows(units[0].cols()) * scale.asDiagonal();

  const body::FlexiblePart& part = *model.bodies[body].flexible;
  std::vector<Triplet> held;
  for (const RowShare& share : rows.of(body)) {
    const auto put = [&](int first, int offset) {
      for (int a = 0; first >= 0 && a < 3; ++a) {
        for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(part.rows, first + a);
             it; ++it) {
          held.emplace_back(local[share.row], static_cast<int>(it.col()),
                            share.interface[offset + a] * it.value());
        }
      }
    };
    put(share.marker->translation_row, 0);
    put(share.marker->rotation_row, 3);
  }
  SparseMatrix H(count, part.num_dofs());
  H.setFromTriplets(held.begin(), held.end());
  return Matrix(answer * H).sparseView(1.0, kRounding);
}

/// BᵀB − BᵀE Pᵀ − P EᵀB with E = BΦ.
SparseMatrix held_share(const SparseMatrix& B, const body::Sieve& sieve) {
  const Matrix E = B * sieve.Phi();
  const SparseMatrix side = SparseMatrix(
      Matrix(sieve.P() * E.transpose()).sparseView(1.0, kRounding));  // n×frame coordinates
  const SparseMatrix cross = side * B;
  SparseMatrix out = SparseMatrix(B.transpose()) * B;
  out -= cross + SparseMatrix(cross.transpose());
  return out;
}

void hold(const Model& model, const PlacedRows& rows, std::size_t b, body::Body& body) {
  body::FlexiblePart& part = *body.flexible;
  if (rows.of(b).empty()) return;
  const SparseMatrix B = answer_of_frame(model, rows, b);
  double columns = 0;
  for (int j = 0; j < B.outerSize(); ++j) columns += SparseMatrix::InnerIterator(B, j) ? 1.0 : 0.0;
  if (columns * static_cast<double>(part.num_dofs()) > kMostEntries) {
    throw ModelError(fmt::format(
        "body \"{}\": its joints hold it by {:.0f} nodal variables of {}; damping with this "
        "`ratio` at two frequencies of the held body would fill its matrices. Use rigid interfaces "
        "(`kind: rigid`), one frequency (`at: [f]`), or `of: free`",
        body.name, columns, part.num_dofs()));
  }
  part.C = SparseMatrix(part.C.copied() + part.fe.mass_damping * held_share(B, part.sieve));
}

}  // namespace

void hold_damping(Model& model) {
  const auto is_asked = [](const body::Body& body) {
    return body.is_flexible() && body.flexible->fe.damps_held_motion &&
           body.flexible->fe.mass_damping > 0.0;
  };
  if (std::none_of(model.bodies.begin(), model.bodies.end(), is_asked)) return;
  const PlacedRows rows(model);
  for (const WholeBody& whole : model.wholes) {
    const auto first = static_cast<std::size_t>(whole.first);
    if (!is_asked(model.bodies[first])) continue;
    if (whole.is_divided()) {
      throw ModelError(
          whole.where,
          fmt::format("body \"{}\": a damping `ratio` at two frequencies cannot be used with "
                      "several frames, since mass damping would act within each of its {} parts "
                      "alone; use one frequency (`at: [f]`, stiffness-proportional damping only), "
                      "or `of: free` if this is meant for each part",
                      whole.name, whole.count));
    }
    hold(model, rows, first, model.bodies[first]);
  }
}

}  // namespace buckens::model
