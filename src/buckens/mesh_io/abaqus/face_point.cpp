// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/abaqus/face_point.h"

#include <algorithm>
#include <array>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace buckens::mesh_io {

using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

enum class FaceShape { line, triangle, quadrilateral };

FaceShape shape_of(Eigen::Index nodes, bool is_edge) {
  if (is_edge) return FaceShape::line;
  return nodes == 3 || nodes == 6 ? FaceShape::triangle : FaceShape::quadrilateral;
}

/// Weights of the nodes at a place in the parameters, and their derivatives.
struct Weights {
  VectorXd value;
  MatrixXd slope;
};

/// Parameter −1 … 1.
Weights line_weights(Eigen::Index nodes, double s) {
  Weights out{VectorXd(nodes), MatrixXd(nodes, 1)};
  if (nodes == 2) {
    out.value << 0.5 * (1 - s), 0.5 * (1 + s);
    out.slope << -0.5, 0.5;
  } else {
    out.value << 0.5 * s * (s - 1), 0.5 * s * (s + 1), 1 - s * s;
    out.slope << s - 0.5, s + 0.5, -2 * s;
  }
  return out;
}

/// Area coordinates 1 − r − s, r, s.
Weights triangle_weights(Eigen::Index nodes, double r, double s) {
  const std::array<double, 3> L = {1 - r - s, r, s};
  const std::array<Vector2d, 3> dL = {Vector2d(-1, -1), Vector2d(1, 0), Vector2d(0, 1)};
  Weights out{VectorXd(nodes), MatrixXd(nodes, 2)};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    if (nodes == 3) {
      out.value[i] = L[k];
      out.slope.row(i) = dL[k];
      continue;
    }
    const std::size_t next = (k + 1) % 3;
    out.value[i] = L[k] * (2 * L[k] - 1);
    out.slope.row(i) = (4 * L[k] - 1) * dL[k];
    out.value[3 + i] = 4 * L[k] * L[next];
    out.slope.row(3 + i) = 4 * (L[k] * dL[next] + L[next] * dL[k]);
  }
  return out;
}

/// Parameters −1 … 1; eight nodes are the serendipity shape.
Weights quadrilateral_weights(Eigen::Index nodes, double r, double s) {
  constexpr std::array<std::array<double, 2>, 4> corner = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  Weights out{VectorXd(nodes), MatrixXd(nodes, 2)};
  for (std::size_t k = 0; k < 4; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    const double a = corner[k][0], b = corner[k][1];
    const double p = 1 + a * r, q = 1 + b * s;
    if (nodes == 4) {
      out.value[i] = 0.25 * p * q;
      out.slope.row(i) << 0.25 * a * q, 0.25 * b * p;
    } else {
      const double rest = a * r + b * s - 1;
      out.value[i] = 0.25 * p * q * rest;
      out.slope.row(i) << 0.25 * a * q * (rest + p), 0.25 * b * p * (rest + q);
    }
  }
  if (nodes != 8) return out;
  for (const int side : {0, 2}) {
    const double b = side == 0 ? -1 : 1;  // s = b
    out.value[4 + side] = 0.5 * (1 - r * r) * (1 + b * s);
    out.slope.row(4 + side) << -r * (1 + b * s), 0.5 * b * (1 - r * r);
    const double a = side == 0 ? 1 : -1;  // r = a
    out.value[5 + side] = 0.5 * (1 + a * r) * (1 - s * s);
    out.slope.row(5 + side) << 0.5 * a * (1 - s * s), -s * (1 + a * r);
  }
  return out;
}

Weights weights_at(FaceShape shape, Eigen::Index nodes, const Vector2d& at) {
  if (shape == FaceShape::line) return line_weights(nodes, at[0]);
  if (shape == FaceShape::triangle) return triangle_weights(nodes, at[0], at[1]);
  return quadrilateral_weights(nodes, at[0], at[1]);
}

/// The places in the parameters from which the search starts: the middle and the corners.
std::vector<Vector2d> starts_of(FaceShape shape) {
  if (shape == FaceShape::line) return {{0, 0}, {-1, 0}, {1, 0}};
  if (shape == FaceShape::triangle) return {{1.0 / 3, 1.0 / 3}, {0, 0}, {1, 0}, {0, 1}};
  return {{0, 0}, {-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
}

/// The nearest point along one straight side of the parameters, or of a line, by Gauss-Newton.
Vector2d search(FaceShape shape, const Matrix3Xd& nodes, const Vector3d& x, const Vector2d& start,
                const Vector2d& along, double length) {
  double t = 0.5 * length;
  for (int step = 0; step < 30; ++step) {
    const Weights w = weights_at(shape, nodes.cols(), start + t * along);
    const Vector3d tangent = nodes * (w.slope * along.head(w.slope.cols()));
    const double size = tangent.squaredNorm();
    if (!(size > 0.0)) break;
    const double next = std::clamp(t + tangent.dot(x - nodes * w.value) / size, 0.0, length);
    const bool is_there = std::abs(next - t) < 1e-13 * length;
    t = next;
    if (is_there) break;
  }
  return start + t * along;
}

bool is_within(FaceShape shape, const Vector2d& at) {
  // A point on an edge may come out beside it by rounding.
  constexpr double kSlack = 1e-12;
  if (shape == FaceShape::triangle) {
    return at.minCoeff() >= -kSlack && at.sum() <= 1 + kSlack;
  }
  return at.cwiseAbs().maxCoeff() <= 1 + kSlack;
}

/// Gauss-Newton in both parameters without bounds; false if it leaves the face or does not settle.
bool search_inside(FaceShape shape, const Matrix3Xd& nodes, const Vector3d& x, Vector2d& at) {
  for (int step = 0; step < 30; ++step) {
    const Weights w = weights_at(shape, nodes.cols(), at);
    const Eigen::Matrix<double, 3, 2> tangents = nodes * w.slope;
    const Eigen::Matrix2d normal = tangents.transpose() * tangents;
    if (!(normal.determinant() > 1e-24 * normal.trace() * normal.trace())) return false;
    const Vector2d move = normal.inverse() * (tangents.transpose() * (x - nodes * w.value));
    at += move;
    if (!at.allFinite() || at.cwiseAbs().maxCoeff() > 10) return false;
    if (move.norm() < 1e-13) break;
  }
  return is_within(shape, at);
}

}  // namespace

FacePoint nearest_on_face(const Matrix3Xd& nodes, bool is_edge, const Vector3d& x) {
  const FaceShape shape = shape_of(nodes.cols(), is_edge);
  std::vector<Vector2d> found;
  if (shape == FaceShape::line) {
    found.push_back(search(shape, nodes, x, {-1, 0}, {1, 0}, 2));
  } else {
    const std::vector<Vector2d> starts = starts_of(shape);
    Vector2d inside = starts.front();
    if (search_inside(shape, nodes, x, inside)) found.push_back(inside);
    for (std::size_t k = 1; k < starts.size(); ++k) {
      const Vector2d& a = starts[k];
      const Vector2d& b = k + 1 < starts.size() ? starts[k + 1] : starts[1];
      found.push_back(search(shape, nodes, x, a, (b - a).normalized(), (b - a).norm()));
    }
  }
  FacePoint out;
  out.distance = -1;
  for (const Vector2d& at : found) {
    Weights w = weights_at(shape, nodes.cols(), at);
    const Vector3d place = nodes * w.value;
    const double distance = (x - place).norm();
    if (out.distance >= 0 && !(distance < out.distance)) continue;
    out = {place, distance, std::move(w.value), std::move(w.slope)};
  }
  return out;
}

Matrix3Xd face_rotation(const Matrix3Xd& nodes, const MatrixXd& slopes) {
  const Eigen::Matrix<double, 3, 2> g = nodes * slopes;
  const Vector3d n = g.col(0).cross(g.col(1)).normalized();
  // g^a · g_b = 1 if a = b, else 0, both in the plane of the face.
  const Eigen::Matrix<double, 3, 2> dual = g * (g.transpose() * g).inverse();
  Matrix3Xd out = Matrix3Xd::Zero(3, 3 * nodes.cols());
  for (Eigen::Index k = 0; k < nodes.cols(); ++k) {
    Matrix3d own = Matrix3d::Zero();
    for (int a = 0; a < 2; ++a) {
      const Vector3d& of = dual.col(a);
      // The normal turns by δn = −Σ (n·u,a) g^a, so ω = n × δn + (ω·n) n with
      // 2 ω·n = n · Σ g^a × u,a = Σ (n × g^a) · u,a.
      own += slopes(k, a) * (-n.cross(of) * n.transpose() + 0.5 * n * n.cross(of).transpose());
    }
    out.middleCols(3 * k, 3) = own;
  }
  return out;
}

}  // namespace buckens::mesh_io
