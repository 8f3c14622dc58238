// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/initial/velocity_change.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace buckens::analysis {

namespace {

// Velocities are written with about four digits; smaller changes of a body's speed are intended.
constexpr double kNoticed = 1e-4;

/// Without the rounding in components that are zero.
std::string text(const Eigen::Vector3d& v) {
  const auto shown = [&](double x) { return std::abs(x) > 1e-9 * v.norm() ? x : 0.0; };
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", shown(v[0]), shown(v[1]), shown(v[2]));
}

/// "its velocity by (0, 0.1, 0) to (0, 30.1, 0) m/s": the change itself, since the result may look
/// the same as what was given.
std::string change_text(const char* what, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                        const char* unit) {
  return fmt::format("{} by {} to {} {}", what, text(to - from), text(to), unit);
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
    const double speed = std::max({x.v.norm(), y.v.norm(), L * x.w.norm(), L * y.w.norm()});
    std::vector<std::string> changes;
    if ((y.v - x.v).norm() > kNoticed * speed) {
      changes.push_back(change_text("its velocity", x.v, y.v, "m/s"));
    }
    if (L * (y.w - x.w).norm() > kNoticed * speed) {
      changes.push_back(change_text("its angular velocity", x.w, y.w, "rad/s"));
    }
    if (!changes.empty()) {
      out.push_back(
          fmt::format("body \"{}\" cannot start with the velocity given in `initial`: the joints "
                      "change {}; give it velocities that fit them",
                      spec.name, fmt::join(changes, " and ")));
      continue;
    }
    const linalg::Vector& d = given.bodies[first].d_dot;
    if (whole.is_divided() || d.size() == 0 || !spec.nodal_velocity) continue;
    const double most = (projected.bodies[first].d_dot.whole() - d).cwiseAbs().maxCoeff();
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
