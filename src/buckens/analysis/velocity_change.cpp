// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/velocity_change.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace buckens::analysis {

namespace {

// Less than this of a body's speed is rounding in what the model file says.
constexpr double kNoticed = 1e-6;

/// Without the rounding in components that are zero.
std::string text(const Eigen::Vector3d& v) {
  const auto shown = [&](double x) { return std::abs(x) > 1e-9 * v.norm() ? x : 0.0; };
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", shown(v[0]), shown(v[1]), shown(v[2]));
}

}  // namespace

std::vector<std::string> describe_velocity_changes(const model::BuiltModel& built,
                                                   const model::State& given,
                                                   const model::State& projected) {
  std::vector<std::string> out;
  for (const model::InitialBodySpec& spec : built.description.initial.bodies) {
    const int index = built.model.find_whole(spec.name);
    if (index < 0) continue;
    const model::WholeBody& whole = built.model.wholes[static_cast<std::size_t>(index)];
    const auto first = static_cast<std::size_t>(whole.first);
    const body::FrameMotion x = model::whole_motion(built.model, whole, given);
    const body::FrameMotion y = model::whole_motion(built.model, whole, projected);
    const double L = whole.count * built.model.bodies[first].length_scale();
    const double change = std::max((y.v - x.v).norm(), L * (y.w - x.w).norm());
    const double speed = std::max({x.v.norm(), y.v.norm(), L * x.w.norm(), L * y.w.norm()});
    if (change > kNoticed * speed) {
      out.push_back(fmt::format(
          "body \"{}\" cannot start with the velocity given in `initial`: the joints change it "
          "from {} to {} m/s, its angular velocity from {} to {} rad/s",
          spec.name, text(x.v), text(y.v), text(x.w), text(y.w)));
      continue;
    }
    const linalg::Vector& d = given.bodies[first].d_dot;
    if (whole.is_divided() || d.size() == 0 || !spec.nodal_velocity) continue;
    const double most = (projected.bodies[first].d_dot - d).cwiseAbs().maxCoeff();
    const double largest = d.cwiseAbs().maxCoeff();
    if (most <= kNoticed * std::max(largest, speed)) continue;
    out.push_back(
        fmt::format("body \"{}\" cannot start with the nodal velocities given in "
                    "`initial`: the joints change them by up to {:.4g} (largest given: "
                    "{:.4g})",
                    spec.name, most, largest));
  }
  return out;
}

}  // namespace buckens::analysis
