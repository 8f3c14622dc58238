// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/solid/face_set.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "buckens/fem/element/quadrature.h"

namespace buckens::fem {

using Eigen::Vector3d;

namespace {

const SolidFace& local_face(const SolidBlock& solids, const ElementFace& face) {
  return solid_topology(solids.form(face.element).kind)
      .faces.at(static_cast<std::size_t>(face.face));
}

/// Place on a face and the two edge vectors of its natural coordinates there.
struct FacePoint {
  Vector3d natural;
  Vector3d along_a, along_b;  // ∂ξ/∂a, ∂ξ/∂b
  double weight;
};

/// Points over the corners of a face, whose natural coordinates are linear on it.
std::vector<FacePoint> face_points(const SolidTopology& topology, const SolidFace& face) {
  const auto corner = [&](std::size_t k) -> Vector3d {
    return topology.natural.col(face.corners[k]);
  };
  constexpr int kPoints = 5;  // degree 9 in each direction: 4 + 4 on curved quadratic faces
  std::vector<FacePoint> out;
  const LineRule line = gauss_jacobi(kPoints, 0);
  if (face.corners.size() == 4) {
    const Vector3d a = 0.5 * (corner(1) - corner(0)), b = 0.5 * (corner(3) - corner(0));
    const Vector3d middle = 0.5 * (corner(0) + corner(2));
    for (int i = 0; i < kPoints; ++i) {
      for (int j = 0; j < kPoints; ++j) {
        out.push_back({middle + line.place[i] * a + line.place[j] * b, a, b,
                       line.weight[i] * line.weight[j]});
      }
    }
    return out;
  }
  const Vector3d a = corner(1) - corner(0), b = corner(2) - corner(0);
  const LineRule collapsed = gauss_jacobi(kPoints, 1);
  for (int i = 0; i < kPoints; ++i) {
    for (int j = 0; j < kPoints; ++j) {
      const double u = 0.5 * (1.0 + collapsed.place[i]);
      const double v = 0.5 * (1.0 + line.place[j]) * (1.0 - u);
      out.push_back(
          {corner(0) + u * a + v * b, a, b, collapsed.weight[i] * line.weight[j] / (4.0 * 2.0)});
    }
  }
  return out;
}

}  // namespace

std::vector<int> face_nodes(const SolidBlock& solids, const ElementFace& face) {
  const std::span<const int> own = solids.nodes(face.element);
  std::vector<int> out = local_face(solids, face).nodes();
  for (int& node : out) node = own[static_cast<std::size_t>(node)];
  return out;
}

std::vector<int> face_set_nodes(const SolidBlock& solids, const std::vector<ElementFace>& faces) {
  std::vector<int> out;
  for (const ElementFace& face : faces) {
    const std::vector<int> own = face_nodes(solids, face);
    out.insert(out.end(), own.begin(), own.end());
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

FaceIntegrals face_integrals(const SolidBlock& solids, const std::vector<Node>& nodes,
                             const ElementFace& face) {
  const SolidKind kind = solids.form(face.element).kind;
  const SolidTopology& topology = solid_topology(kind);
  const SolidFace& local = local_face(solids, face);
  const std::vector<int> members = local.nodes();
  const auto count = static_cast<Eigen::Index>(members.size());
  const NodeVectors x = solids.positions(nodes, face.element);
  FaceIntegrals out{face_nodes(solids, face), Eigen::VectorXd::Zero(count),
                    Eigen::Matrix3Xd::Zero(3, count), Eigen::MatrixXd::Zero(count, count),
                    Eigen::VectorXd::Zero(count)};
  for (const FacePoint& point : face_points(topology, local)) {
    const SolidShape shape = solid_shape(kind, point.natural);
    const Eigen::Matrix3d jacobian = x * shape.slope.transpose();
    const Vector3d normal = (jacobian * point.along_a).cross(jacobian * point.along_b);
    const double area = point.weight * normal.norm();
    const Eigen::VectorXd N = shape.N(members);
    out.area += area * N;
    out.normal += point.weight * normal * N.transpose();
    out.products += area * N * N.transpose();
  }
  out.positive_area = out.products.diagonal() * (out.area.sum() / out.products.trace());
  return out;
}

}  // namespace buckens::fem
