// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/add_slider.h"

#include <algorithm>
#include <deque>
#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/fem/assembly/recovery.h"

namespace buckens::model {

using Eigen::Vector3d;

namespace {

class SliderBuilder {
 public:
  SliderBuilder(const joints::JointSpec& spec, MarkerFinder& find)
      : spec_(spec),
        kind_(std::get<joints::SliderOnBeamSpec>(spec.kind)),
        find_(find),
        what_(fmt::format("joint \"{}\"", spec.name)) {}

  void add() {
    Model& model = find_.model();
    const base::MarkerRef& beam = kind_.between[0];
    whole_ = beam.is_ground() ? -1 : model.find_whole(beam.body);
    // Names of unknown bodies are reported by the search for the marker.
    if (whole_ < 0) find_.marker(beam, false);
    if (whole_ < 0 || mesh() == nullptr) {
      refuse(
          fmt::format("\"{}\" has no beams; a slider runs on a flexible body; for a rigid path use "
                      "`slot`, `prismatic` or `point-on-line`",
                      beam.text));
    }
    Joint joint;
    joint.name = spec_.name;
    joint.type = joints::JointType::slider_on_beam;
    joint.where = spec_.where;
    auto track = std::make_shared<Track>();
    for (const int node : way()) track->nodes.push_back(node_marker(node));
    name_ends(*track);
    for (const MarkerId& id : track->nodes) {
      find_.require_moment(id, what_, spec_.where);
      const bool is_new = std::none_of(track->bodies.begin(), track->bodies.end(),
                                       [&](const MarkerId& b) { return b.body == id.body; });
      if (is_new) track->bodies.push_back(id);
    }
    joint.first = track->nodes.front();
    joint.first.text = beam.text;
    joint.second = find_.marker(kind_.between[1], true);
    find_.require_two_bodies(joint.first, joint.second, what_, spec_.where);
    joint.axis_F = place(*track, joint.second);
    add_rows(joint);
    joint.track = std::move(track);
    joint.first_row = model.num_constraint_rows();
    model.joints.push_back(std::move(joint));
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw ModelError(spec_.where, fmt::format("{}: {}", what_, why));
  }

  const WholeBody& whole() const { return find_.model().wholes[static_cast<std::size_t>(whole_)]; }
  const fem::FeModel* mesh() const {
    if (whole().is_divided()) return whole().mesh.get();
    const body::Body& body = find_.model().bodies[static_cast<std::size_t>(whole().first)];
    return body.is_flexible() ? &body.flexible->mesh() : nullptr;
  }

  /// Nodes one after the other along beams from the first to the last node.
  std::vector<int> way() const {
    std::vector<std::vector<int>> neighbours(mesh()->nodes.size());
    for (const fem::LineElement& line : fem::line_elements(*mesh())) {
      if (!line.bends) continue;
      neighbours[static_cast<std::size_t>(line.a)].push_back(line.b);
      neighbours[static_cast<std::size_t>(line.b)].push_back(line.a);
    }
    const auto [first, last] = ends(neighbours);
    // Breadth first from the last node: the way of fewest elements.
    std::vector<int> next(neighbours.size(), -1);
    std::deque<int> open = {last};
    next[static_cast<std::size_t>(last)] = last;
    while (!open.empty()) {
      const int at = open.front();
      open.pop_front();
      for (const int other : neighbours[static_cast<std::size_t>(at)]) {
        if (next[static_cast<std::size_t>(other)] >= 0) continue;
        next[static_cast<std::size_t>(other)] = at;
        open.push_back(other);
      }
    }
    if (next[static_cast<std::size_t>(first)] < 0) {
      refuse(
          fmt::format("no beams of body \"{}\" lead from `from` to `to`; name nodes that are "
                      "connected by beams",
                      whole().name));
    }
    std::vector<int> out = {first};
    while (out.back() != last) out.push_back(next[static_cast<std::size_t>(out.back())]);
    return out;
  }

  std::pair<int, int> ends(const std::vector<std::vector<int>>& neighbours) const {
    std::vector<int> free;
    bool is_line = true;
    for (std::size_t k = 0; k < neighbours.size(); ++k) {
      if (neighbours[k].size() == 1) free.push_back(static_cast<int>(k));
      if (neighbours[k].size() > 2) is_line = false;
    }
    const bool needs_both = !(is_line && free.size() == 2);
    if (needs_both && (!kind_.from || !kind_.to)) {
      const bool has_beams = std::any_of(neighbours.begin(), neighbours.end(),
                                         [](const auto& list) { return !list.empty(); });
      refuse(has_beams
                 ? fmt::format("the beams of body \"{}\" do not form a single line; give the nodes "
                               "between which the slider runs by `from` and `to`",
                               whole().name)
                 : fmt::format("body \"{}\" has no beams; a slider needs nodes with rotations "
                               "along its way",
                               whole().name));
    }
    const int first = kind_.from ? node_of(*kind_.from, "from") : free[0];
    const int last = kind_.to ? node_of(*kind_.to, "to") : free[free[0] == first ? 1 : 0];
    if (first == last) refuse("`from` and `to` are the same node; name two different nodes");
    return {first, last};
  }

  /// Number of a named node in the whole mesh.
  int node_of(const std::string& name, const char* key) const {
    base::MarkerRef ref;
    ref.body = whole().name;
    ref.marker = name;
    ref.text = ref.body + "/" + name;
    ref.where = spec_.where;
    const MarkerId id = find_.marker(ref, true);
    const body::Marker& marker = find_.model()
                                     .bodies[static_cast<std::size_t>(id.body)]
                                     .markers[static_cast<std::size_t>(id.marker)];
    if (marker.node < 0) {
      refuse(fmt::format("`{}`: \"{}\" lies between the nodes of a beam; name a node", key, name));
    }
    if (!whole().is_divided()) return marker.node;
    const auto& own = find_.model().bodies[static_cast<std::size_t>(id.body)];
    const Vector3d place =
        own.flexible->mesh().nodes[static_cast<std::size_t>(marker.node)].position;
    const auto& nodes = whole().mesh->nodes;
    const auto found =
        std::min_element(nodes.begin(), nodes.end(), [&](const auto& a, const auto& b) {
          return (a.position - place).squaredNorm() < (b.position - place).squaredNorm();
        });
    return static_cast<int>(found - nodes.begin());
  }

  MarkerId node_marker(int node) const {
    MeshCopy copy{whole().first, node};
    if (whole().is_divided()) copy = whole().nodes[static_cast<std::size_t>(node)];
    MarkerId id;
    id.body = copy.body;
    id.marker = find_.table(copy.body).cut_marker(copy.index);
    id.text = fmt::format("node {} of {}", node + 1, whole().name);
    return id;
  }

  void name_ends(Track& track) const {
    if (kind_.from) track.nodes.front().text = whole().name + "/" + *kind_.from;
    if (kind_.to) track.nodes.back().text = whole().name + "/" + *kind_.to;
  }

  /// Finds the line of the nodes, and where the slider is on it.
  /// @return direction of the line there, in axes of the slider's marker
  Vector3d place(Track& track, const MarkerId& slider) const {
    std::vector<spatial::MarkerMotion> nodes;
    for (const MarkerId& id : track.nodes) {
      const spatial::Pose X = find_.placed(id);
      spatial::MarkerMotion motion;
      motion.p = X.p;
      motion.R = X.R();
      nodes.push_back(motion);
    }
    track.shape = joints::BeamTrack(nodes, find_.model().planar);
    const Vector3d at = find_.placed(slider).p;
    const auto motion = [&](std::size_t k) { return nodes[k]; };
    const joints::TrackPoint point = track.shape.nearest(at, std::nullopt, motion);
    track.placed = point.s;
    const double length = track.shape.length();
    if (track.placed < -kBeyond * length || track.placed > (1.0 + kBeyond) * length) {
      refuse(
          fmt::format("the slider is placed {:.6g} m beyond the {} of its beam, whose length is "
                      "{:.6g} m; place it within the length of the beam",
                      track.placed < 0.0 ? -track.placed : track.placed - length,
                      track.placed < 0.0 ? "start" : "end", length));
    }
    return find_.placed(slider).R().transpose() * point.tangent.normalized();
  }

  void add_rows(Joint& joint) const {
    joint.rows.push_back(joints::ConstraintRow::travelling(0));
    if (!find_.model().planar) joint.rows.push_back(joints::ConstraintRow::travelling(1));
    // In axes of the point of the beam, whose x axis is its tangent.
    joint.coordinates.push_back(
        {base::CoordinateChoice::displacement,
         joints::JointCoordinate::displacement(Vector3d::UnitX(), Vector3d::Zero())});
    if (!kind_.is_driven()) return;
    // What follows signals gets them when these are known, see add_drives().
    const joints::DriveLaws laws = kind_.laws();
    joint.rows.push_back(
        joints::ConstraintRow::travelling(2, laws.is_steered() ? base::TimeLaw() : laws.of_time()));
  }

  // Of the beam's length: what counts as rounding.
  static constexpr double kBeyond = 1e-9;

  const joints::JointSpec& spec_;
  const joints::SliderOnBeamSpec& kind_;
  MarkerFinder& find_;
  std::string what_;
  int whole_ = -1;
};

}  // namespace

void add_slider(const joints::JointSpec& spec, MarkerFinder& find) {
  SliderBuilder(spec, find).add();
}

}  // namespace buckens::model
