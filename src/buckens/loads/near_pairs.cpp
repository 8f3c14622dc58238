// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/near_pairs.h"

#include <algorithm>
#include <cmath>

#include "buckens/loads/contact_mesh.h"

namespace buckens::loads {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

AlignedBox3d bounding_box(const ContactShape& shape, const spatial::MarkerMotion& at) {
  Vector3d half = Vector3d::Constant(shape.radius);
  switch (shape.kind) {
    case ContactShape::Kind::plane:
    case ContactShape::Kind::bore:
      half.setConstant(HUGE_VAL);
      break;
    case ContactShape::Kind::sphere:
    case ContactShape::Kind::socket:
      break;
    case ContactShape::Kind::capsule:
    case ContactShape::Kind::cylinder:
      half += shape.half_length * (at.R * shape.axis).cwiseAbs();
      break;
    case ContactShape::Kind::box:
      half = at.R.cwiseAbs() * shape.half;
      break;
    case ContactShape::Kind::mesh: {
      const AlignedBox3d& own = shape.mesh->box();
      const Vector3d middle = at.p + at.R * own.center();
      half = at.R.cwiseAbs() * (0.5 * own.sizes());
      return {middle - half, middle + half};
    }
  }
  return {at.p - half, at.p + half};
}

namespace {

/// Axis along which the middles of the boxes are spread most.
int sweeping_axis(std::span<const AlignedBox3d> boxes, const std::vector<int>& finite) {
  Vector3d mean = Vector3d::Zero();
  for (const int k : finite) mean += boxes[static_cast<std::size_t>(k)].center();
  mean /= static_cast<double>(finite.size());
  Vector3d spread = Vector3d::Zero();
  for (const int k : finite) {
    spread += (boxes[static_cast<std::size_t>(k)].center() - mean).cwiseAbs2();
  }
  int axis = 0;
  spread.maxCoeff(&axis);
  return axis;
}

}  // namespace

void find_overlapping(std::span<const AlignedBox3d> boxes,
                      std::vector<std::pair<int, int>>& pairs) {
  const auto box = [&](int k) -> const AlignedBox3d& { return boxes[static_cast<std::size_t>(k)]; };
  thread_local std::vector<int> finite, infinite;  // kept, so that steps allocate nothing
  finite.clear();
  infinite.clear();
  for (int k = 0; k < static_cast<int>(boxes.size()); ++k) {
    (box(k).sizes().allFinite() ? finite : infinite).push_back(k);
  }
  for (const int i : infinite) {
    for (const int j : finite) pairs.push_back(std::minmax(i, j));
    for (const int j : infinite) {
      if (i < j) pairs.emplace_back(i, j);
    }
  }
  if (finite.empty()) return;
  const int axis = sweeping_axis(boxes, finite);
  std::sort(finite.begin(), finite.end(),
            [&](int i, int j) { return box(i).min()[axis] < box(j).min()[axis]; });
  for (std::size_t a = 0; a < finite.size(); ++a) {
    const AlignedBox3d& own = box(finite[a]);
    const double end = own.max()[axis];
    for (std::size_t b = a + 1; b < finite.size() && box(finite[b]).min()[axis] <= end; ++b) {
      if (own.intersects(box(finite[b]))) pairs.push_back(std::minmax(finite[a], finite[b]));
    }
  }
}

}  // namespace buckens::loads
