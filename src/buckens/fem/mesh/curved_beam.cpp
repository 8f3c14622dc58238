// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/mesh/curved_beam.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/fem/line/frame.h"
#include "buckens/spatial/rotation.h"

namespace buckens::fem {

using Eigen::Vector3d;

BeamDivision add_curved_beam(Structure& structure, int node_a, int node_b, BeamPath path,
                             const std::vector<Vector3d>& through, int divisions,
                             const BeamProperties& properties) {
  if (through.empty()) return add_beam(structure, node_a, node_b, divisions, properties);
  const int num_nodes = static_cast<int>(structure.nodes.size());
  if (node_a < 0 || node_b < 0 || node_a >= num_nodes || node_b >= num_nodes) {
    throw ModelError(fmt::format("beam between nodes {} and {}: there are only {} nodes", node_a,
                                 node_b, num_nodes));
  }
  std::vector<Vector3d> points = {structure.nodes[static_cast<std::size_t>(node_a)].position};
  points.insert(points.end(), through.begin(), through.end());
  points.push_back(structure.nodes[static_cast<std::size_t>(node_b)].position);
  const std::vector<Vector3d> places = divide_path(path, points, divisions);

  BeamDivision out{structure.beams.num_elements(), divisions, {node_a}};
  double length = 0.0;
  for (std::size_t k = 0; k + 1 < places.size(); ++k) length += (places[k + 1] - places[k]).norm();
  const int number = structure.beams.add_properties(properties);
  LineFrame last;
  double from = 0.0;
  for (std::size_t k = 0; k + 1 < places.size(); ++k) {
    const bool is_last = k + 2 == places.size();
    out.nodes.push_back(is_last ? node_b : add_node(structure, "", places[k + 1]));
    LineFrame frame = line_frame(places[k], places[k + 1], properties.up);
    if (k > 0 && !properties.up) {
      const auto turn = spatial::rotation_between(last.axes.col(0), frame.axes.col(0));
      frame = line_frame(places[k], places[k + 1], Vector3d(turn * last.axes.col(2)));
    }
    const double to = is_last ? 1.0 : from + frame.length / length;
    structure.beams.add(out.nodes[k], out.nodes[k + 1], number,
                        {from, to, Vector3d(frame.axes.col(2))});
    from = to;
    last = frame;
  }
  return out;
}

}  // namespace buckens::fem
