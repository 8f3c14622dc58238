// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/solid/shape.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace buckens::fem {

using Eigen::Vector3d;

namespace {

using Corners = std::vector<std::vector<int>>;  // of each face

NodeVectors corner_places(int corners) {
  NodeVectors out(3, corners);
  switch (corners) {
    case 8:
      out << -1, 1, 1, -1, -1, 1, 1, -1,  //
          -1, -1, 1, 1, -1, -1, 1, 1,     //
          -1, -1, -1, -1, 1, 1, 1, 1;
      break;
    case 6:
      out << 0, 1, 0, 0, 1, 0,  //
          0, 0, 1, 0, 0, 1,     //
          -1, -1, -1, 1, 1, 1;
      break;
    case 5:
      out << -1, 1, 1, -1, 0,  //
          -1, -1, 1, 1, 0,     //
          0, 0, 0, 0, 1;
      break;
    default:
      out << 0, 1, 0, 0,  //
          0, 0, 1, 0,     //
          0, 0, 0, 1;
  }
  return out;
}

Eigen::Vector3d centre_of(int corners, const NodeVectors& places) {
  // Of a pyramid: the centre of its volume, a quarter up.
  if (corners == 5) return {0, 0, 0.25};
  return places.rowwise().mean();
}

SolidFace make_face(const std::vector<int>& corners, const SolidTopology& element) {
  SolidFace face{corners, {}};
  if (element.num_nodes == element.num_corners) return face;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const int a = corners[k];
    const int b = corners[(k + 1) % corners.size()];
    const auto edge = std::find_if(element.edges.begin(), element.edges.end(), [&](const auto& e) {
      return (e[0] == a && e[1] == b) || (e[0] == b && e[1] == a);
    });
    face.mid_sides.push_back(element.num_corners + static_cast<int>(edge - element.edges.begin()));
  }
  return face;
}

/// A quadratic face is divided into its corners, each with two mid-side nodes, and the area between
/// the mid-side nodes.
void add_pieces(const SolidFace& face, std::vector<std::array<int, 4>>& pieces) {
  const auto piece = [](const std::vector<int>& n) {
    return std::array<int, 4>{n[0], n[1], n[2], n.size() == 4 ? n[3] : -1};
  };
  if (face.mid_sides.empty()) {
    pieces.push_back(piece(face.corners));
    return;
  }
  const std::size_t count = face.corners.size();
  for (std::size_t k = 0; k < count; ++k) {
    pieces.push_back(
        {face.corners[k], face.mid_sides[k], face.mid_sides[(k + count - 1) % count], -1});
  }
  pieces.push_back(piece(face.mid_sides));
}

/// Edges of an element in the order of its mid-side nodes, and its faces.
std::pair<std::vector<std::array<int, 2>>, Corners> edges_and_faces(int corners) {
  switch (corners) {
    case 8:
      return {{{0, 1},
               {1, 2},
               {2, 3},
               {3, 0},
               {4, 5},
               {5, 6},
               {6, 7},
               {7, 4},
               {0, 4},
               {1, 5},
               {2, 6},
               {3, 7}},
              {{3, 0, 4, 7}, {1, 2, 6, 5}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 3, 2, 1}, {4, 5, 6, 7}}};
    case 6:
      return {{{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}},
              {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}};
    case 5:
      return {{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}},
              {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {0, 3, 2, 1}}};
    default:
      return {{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}},
              {{1, 2, 3}, {2, 0, 3}, {0, 1, 3}, {0, 2, 1}}};
  }
}

SolidTopology make_topology(int num_corners, bool quadratic) {
  SolidTopology out;
  const NodeVectors corners = corner_places(num_corners);
  out.num_corners = num_corners;
  out.centre = centre_of(num_corners, corners);
  Corners faces;
  std::tie(out.edges, faces) = edges_and_faces(num_corners);
  out.num_nodes = out.num_corners + (quadratic ? static_cast<int>(out.edges.size()) : 0);
  out.natural.resize(3, out.num_nodes);
  out.natural.leftCols(out.num_corners) = corners;
  for (int node = out.num_corners; node < out.num_nodes; ++node) {
    const auto& [a, b] = out.edges[static_cast<std::size_t>(node - out.num_corners)];
    out.natural.col(node) = 0.5 * (corners.col(a) + corners.col(b));
  }
  for (const auto& corner_list : faces) {
    out.faces.push_back(make_face(corner_list, out));
    add_pieces(out.faces.back(), out.pieces);
  }
  return out;
}

/// Corners: ⅛ Π(1 + s_a ξ_a), of hex20 times Σ s_a ξ_a − 2. Mid-side nodes have one s_a = 0 and
/// ¼ (1 − ξ_a²) instead of its factor.
SolidShape hexahedron(const SolidTopology& element, const Vector3d& natural) {
  const bool quadratic = element.num_nodes > element.num_corners;
  SolidShape out{NodeValues(element.num_nodes), NodeVectors(3, element.num_nodes)};
  for (int node = 0; node < element.num_nodes; ++node) {
    const Vector3d s = element.natural.col(node);
    Vector3d f, df;
    for (int a = 0; a < 3; ++a) {
      f[a] = s[a] == 0.0 ? 1.0 - natural[a] * natural[a] : 1.0 + s[a] * natural[a];
      df[a] = s[a] == 0.0 ? -2.0 * natural[a] : s[a];
    }
    const Vector3d product_slope(df.x() * f.y() * f.z(), f.x() * df.y() * f.z(),
                                 f.x() * f.y() * df.z());
    const bool is_corner = node < element.num_corners;
    if (is_corner && quadratic) {
      const double g = s.dot(natural) - 2.0;
      out.N[node] = 0.125 * f.prod() * g;
      out.slope.col(node) = 0.125 * (g * product_slope + f.prod() * s);
    } else {
      const double scale = is_corner ? 0.125 : 0.25;
      out.N[node] = scale * f.prod();
      out.slope.col(node) = scale * product_slope;
    }
  }
  return out;
}

/// With volume coordinates L: corners L, of tet10 L (2L − 1); mid-side nodes 4 L_a L_b.
SolidShape tetrahedron(const SolidTopology& element, const Vector3d& natural) {
  Eigen::Vector4d L;
  L << 1.0 - natural.sum(), natural;
  Eigen::Matrix<double, 3, 4> dL;
  dL << Vector3d::Constant(-1.0), Eigen::Matrix3d::Identity();
  SolidShape out{NodeValues(element.num_nodes), NodeVectors(3, element.num_nodes)};
  if (element.num_nodes == 4) {
    out.N = L;
    out.slope = dL;
    return out;
  }
  for (int node = 0; node < 4; ++node) {
    out.N[node] = L[node] * (2.0 * L[node] - 1.0);
    out.slope.col(node) = (4.0 * L[node] - 1.0) * dL.col(node);
  }
  for (int node = 4; node < 10; ++node) {
    const auto& [a, b] = element.edges[static_cast<std::size_t>(node - 4)];
    out.N[node] = 4.0 * L[a] * L[b];
    out.slope.col(node) = 4.0 * (L[a] * dL.col(b) + L[b] * dL.col(a));
  }
  return out;
}

/// Triangle coordinates L times ½ (1 ± ζ); of wedge15 corners also minus ½ L (1 − ζ²), edges of the
/// triangles 2 L_a L_b (1 ± ζ), upright edges L (1 − ζ²).
SolidShape wedge(const SolidTopology& element, const Vector3d& natural) {
  const Vector3d L(1.0 - natural.x() - natural.y(), natural.x(), natural.y());
  Eigen::Matrix<double, 2, 3> dL;
  dL << -1, 1, 0, -1, 0, 1;
  const double z = natural.z();
  SolidShape out{NodeValues(element.num_nodes), NodeVectors(3, element.num_nodes)};
  // f(L) g(ζ) with the slope of f along the triangle.
  const auto set = [&out](Eigen::Index node, double f, const Eigen::Vector2d& df, double g,
                          double dg) {
    out.N[node] = f * g;
    out.slope.col(node) << g * df, f * dg;
  };
  for (int node = 0; node < 6; ++node) {
    const int k = node % 3;
    const double up = node < 3 ? -1.0 : 1.0;
    set(node, L[k], dL.col(k), 0.5 * (1.0 + up * z), 0.5 * up);
    if (element.num_nodes == 6) continue;
    // ½ L (2L − 1)(1 ± ζ) − ½ L (1 − ζ²) = ½ L (1 ± ζ)(2L − 2 ± ζ)
    const double s = 1.0 + up * z, t = 2.0 * L[k] - 2.0 + up * z;
    out.N[node] = 0.5 * L[k] * s * t;
    out.slope.col(node) << 0.5 * s * (t + 2.0 * L[k]) * dL.col(k), 0.5 * L[k] * up * (t + s);
  }
  for (int node = 6; node < element.num_nodes; ++node) {
    const auto& [a, b] = element.edges[static_cast<std::size_t>(node - 6)];
    const int i = a % 3, j = b % 3;
    if (node < 12) {
      const double up = a < 3 ? -1.0 : 1.0;
      set(node, 2.0 * L[i] * L[j], 2.0 * (L[i] * dL.col(j) + L[j] * dL.col(i)), 1.0 + up * z, up);
    } else {
      set(node, L[i], dL.col(i), 1.0 - z * z, -2.0 * z);
    }
  }
  return out;
}

/// ¼ (1 − ζ + s ξ + t η + s t ξ η/(1 − ζ)) at the base, ζ at the apex: linear on the triangles,
/// bilinear on the base. At the apex the slopes depend on the way there; along the axis is taken.
SolidShape pyramid(const SolidTopology& element, const Vector3d& natural) {
  const double height = 1.0 - natural.z();
  const double a = height > 0.0 ? natural.x() / height : 0.0;
  const double b = height > 0.0 ? natural.y() / height : 0.0;
  SolidShape out{NodeValues(5), NodeVectors(3, 5)};
  for (int node = 0; node < 4; ++node) {
    const double s = element.natural(0, node), t = element.natural(1, node);
    out.N[node] = 0.25 * height * (1.0 + s * a) * (1.0 + t * b);
    out.slope.col(node) << 0.25 * s * (1.0 + t * b), 0.25 * t * (1.0 + s * a),
        0.25 * (s * t * a * b - 1.0);
  }
  out.N[4] = natural.z();
  out.slope.col(4) << 0.0, 0.0, 1.0;
  return out;
}

}  // namespace

std::vector<int> SolidFace::nodes() const {
  std::vector<int> out = corners;
  out.insert(out.end(), mid_sides.begin(), mid_sides.end());
  return out;
}

const SolidTopology& solid_topology(SolidKind kind) {
  static const std::array<SolidTopology, 7> all = {make_topology(8, false), make_topology(8, true),
                                                   make_topology(4, false), make_topology(4, true),
                                                   make_topology(6, false), make_topology(6, true),
                                                   make_topology(5, false)};
  return all[static_cast<std::size_t>(kind)];
}

SolidShape solid_shape(SolidKind kind, const Vector3d& natural) {
  const SolidTopology& element = solid_topology(kind);
  switch (element.num_corners) {
    case 8:
      return hexahedron(element, natural);
    case 6:
      return wedge(element, natural);
    case 5:
      return pyramid(element, natural);
    default:
      return tetrahedron(element, natural);
  }
}

}  // namespace buckens::fem
