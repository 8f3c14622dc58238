// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "buckens/results/record_sink.h"

namespace buckens::run_store::test {

/// A slider on the ground and a rod of two elements, hinged.
inline results::Geometry sample_geometry() {
  results::Geometry geometry;
  geometry.gravity = {0, -9.81, 0};
  geometry.planar = "xy";
  results::GeometryBody slider;
  slider.name = "slider";
  slider.markers.push_back({"pin", -1, {{0.1, 0.2, 0.3}, Eigen::Quaterniond(0.6, 0, 0, 0.8)}});
  results::GeometryBody rod;
  rod.name = "rod";
  rod.kind = results::BodyKind::beam;
  rod.nodes.resize(3, 3);
  rod.nodes << -0.5, 0, 0, 0, 0, 0, 0.5, 0, 0;
  rod.elements = {{0, 1}, {1, 2}};
  rod.radius = {{0.01, 0.01}, {0.02, 0.005}};
  const fem::SectionLoop outline = {{0.01, 0}, {0, 0.01}, {-0.01, 0}, {0, -0.01}};
  const fem::SectionLoop hole = {{0.005, 0}, {0, -0.005}, {-0.005, 0}, {0, 0.005}};
  rod.sections = {{outline, hole}, {}, {outline}};
  rod.element_sections = {{0, 0}, {2, 1}};
  rod.element_y = {{0, 1, 0}, {0, 0, 1}};
  rod.markers.push_back({"start", 0, {{-0.5, 0, 0}, Eigen::Quaterniond::Identity()}});
  rod.markers.push_back({"end", 2, {{0.5, 0, 0}, Eigen::Quaterniond::Identity()}});
  geometry.bodies = {slider, rod};  // not in alphabetical order
  results::GeometryJoint pin;
  pin.name = "pin";
  pin.type = "revolute";
  pin.between[0] = {0, 0, {0.1, 0.2, 0.3}};
  pin.between[1] = {1, 0, {-0.5, 0, 0}};
  results::GeometryJoint guide;
  guide.name = "guide";
  guide.type = "prismatic";
  guide.between[0] = {results::kGroundBody, -1, {1, 2, 3}};
  guide.between[1] = {0, -1, {0, 0, 0}};
  guide.axis = {1, 0, 0};
  geometry.joints = {pin, guide};
  return geometry;
}

/// @param nodes of the rod
inline results::RecordLayout sample_layout(int nodes = 3) {
  results::RecordLayout layout;
  const std::vector<std::string> pose{"px", "py", "pz", "qw", "qx", "qy", "qz"};
  layout.add({"bodies/rod/pose", "m, 1", {7}, "pose of the body frame", pose});
  layout.add({"bodies/rod/displacement", "m, rad", {nodes, 6}, "nodal displacements", {}});
  layout.add({"bodies/rod/stress", "Pa", {2, 2}, "axial stress at two points", {}});
  layout.add({"bodies/slider/pose", "m, 1", {7}, "pose of the body frame", pose});
  layout.add({"energies/kinetic", "J", {}, "kinetic energy", {}});
  layout.add({"sensors/tip", "m", {3}, "position of the tip", {"x", "y", "z"}});
  layout.add({"sensors/angle", "rad", {}, "crank angle", {}});
  return layout;
}

/// Values that identify their record and place.
inline double sample_value(std::size_t record, std::size_t position) {
  return static_cast<double>(record) + std::sin(static_cast<double>(position));
}

inline results::Record sample_record(std::size_t record, std::size_t num_values) {
  results::Record sample;
  sample.t = 1e-3 * static_cast<double>(record);
  for (std::size_t i = 0; i < num_values; ++i) {
    sample.values.push_back(sample_value(record, i));
  }
  return sample;
}

inline results::RunSummary finished_summary(long steps = 0) {
  results::RunSummary summary;
  summary.finished = true;
  summary.steps = steps;
  return summary;
}

}  // namespace buckens::run_store::test
