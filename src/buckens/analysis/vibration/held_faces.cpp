// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/vibration/held_faces.h"

#include <cmath>

#include <Eigen/Dense>

namespace buckens::analysis {

namespace {

using linalg::Matrix;

constexpr int kMotionsOfFace = 3;
// Cosine of the angle between normals of one face: spots on a bent surface hold more together.
constexpr double kOneNormal = 0.99;
// What is left of a row, relative to the first, that rounding may have made.
constexpr double kNothingLeft = 1e-9;

/// The closed rows of one face.
struct Face {
  std::size_t load = 0;
  int pair = -1;
  Eigen::Vector3d normal;
  std::vector<std::size_t> rows;
};

bool is_of(const Face& face, const RestRow& row, const Eigen::Vector3d& normal) {
  return face.load == row.load && face.pair == row.pair &&
         std::abs(face.normal.dot(normal)) > kOneNormal;
}

std::vector<Face> faces_of(const RestRows& rest, const RestValues& values,
                           const RestStands& stands) {
  std::vector<Face> out;
  // The two rows of a spot follow each other.
  for (std::size_t k = 0; k + 1 < rest.size(); ++k) {
    const RestRow& row = rest[k];
    if (row.kind != RestRow::Kind::along || row.across >= 0) continue;
    if (row.part % RestRow::kOfSpot != 1 || stands[k].regime == 0) continue;
    const Eigen::Vector3d normal =
        values.pushes[k].force.cross(values.pushes[k + 1].force).normalized();
    auto face = out.begin();
    while (face != out.end() && !is_of(*face, row, normal)) ++face;
    if (face == out.end()) face = out.insert(out.end(), Face{row.load, row.pair, normal, {}});
    face->rows.insert(face->rows.end(), {k, k + 1});
  }
  return out;
}

/// Rows that say most, by Gram and Schmidt: the longest, then what is longest across it, and so on.
std::vector<std::size_t> strongest(Matrix rows, int most) {
  std::vector<std::size_t> out;
  const double size = rows.rowwise().norm().maxCoeff();
  while (static_cast<int>(out.size()) < most) {
    Eigen::Index best = 0;
    const double left = rows.rowwise().norm().maxCoeff(&best);
    if (!(left > kNothingLeft * size)) break;
    out.push_back(static_cast<std::size_t>(best));
    const Eigen::RowVectorXd direction = rows.row(best) / left;
    rows -= (rows * direction.transpose()).eval() * direction;
  }
  return out;
}

}  // namespace

std::vector<char> rows_that_hold(const RestRows& rest, const RestValues& values,
                                 const RestStands& stands, const dynamics::MassMetric& metric) {
  std::vector<char> out(rest.size(), 1);
  for (const Face& face : faces_of(rest, values, stands)) {
    std::vector<dynamics::SystemRow> rows;
    for (const std::size_t k : face.rows) {
      rows.push_back(values.rows[k]);
      out[k] = 0;
    }
    for (const std::size_t one :
         strongest(Matrix(metric.weighted_jacobian(rows)), kMotionsOfFace)) {
      out[face.rows[one]] = 1;
    }
  }
  return out;
}

}  // namespace buckens::analysis
