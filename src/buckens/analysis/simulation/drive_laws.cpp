// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/drive_laws.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::analysis {

namespace {
constexpr int kHalvings = 12;
// Below this share of its own size a law is rounding.
constexpr double kRounding = 1e-10;
// At the start: distances from this share of the duration, each a sixteenth of the one before.
// Differences that grow by as much each time have no limit.
constexpr double kStart = 1e-4;
constexpr int kDistances = 4;
constexpr double kGrowth = 1.5;

/// Whether a one-sided difference quotient of a law grows without limit towards t = 0.
bool grows(const base::TimeLaw& law, double duration, int order) {
  double before = 0;
  for (int k = 0; k < kDistances; ++k) {
    const double h = kStart * duration / std::pow(16.0, k);
    const double f0 = law.value(0), f1 = law.value(h), f2 = law.value(2.0 * h);
    const double quotient = order == 1 ? (f1 - f0) / h : (f2 - 2.0 * f1 + f0) / (h * h);
    const double rounding = 1e-14 * std::max({std::abs(f0), std::abs(f1), std::abs(f2)});
    if (!(std::abs(quotient) * std::pow(h, order) > rounding)) return false;
    if (k > 0 && !(std::abs(quotient) > kGrowth * before)) return false;
    before = std::abs(quotient);
  }
  return true;
}

}  // namespace

DriveLaws::DriveLaws(const model::ModelDescription& description) {
  for (const joints::JointSpec& joint : description.joints) {
    if (joint.laws().num_given() > 0) take(joint.laws(), joint, joint.drives_angle() ? "rad" : "m");
  }
}

void DriveLaws::take(const joints::DriveLaws& laws, const joints::JointSpec& joint,
                     const char* unit) {
  if (laws.is_steered()) return;
  const base::TimeLaw law = laws.of_time();
  if (!law.is_constant()) drives_.push_back({joint.name, joint.where, law, unit});
}

void DriveLaws::check(double from, double to) const {
  for (const Drive& drive : drives_) {
    double a = from;
    double b = to;
    double f_a = drive.law.value(a);
    double f_b = drive.law.value(b);
    double halfway = 0;
    // Follow the half with the larger change. A smooth law changes 64 times less in 64 times less
    // time, a jump stays.
    for (int halving = 0; halving < kHalvings; ++halving) {
      if (halving == kHalvings / 2) halfway = std::abs(f_b - f_a);
      const double middle = 0.5 * (a + b);
      const double f = drive.law.value(middle);
      if (std::abs(f - f_a) > std::abs(f_b - f)) {
        b = middle;
        f_b = f;
      } else {
        a = middle;
        f_a = f;
      }
    }
    const double left = std::abs(f_b - f_a);
    if (left <= 0.5 * halfway) continue;
    if (left <= kRounding * std::max(std::abs(f_a), std::abs(f_b))) continue;
    throw NumericalError(
        drive.where,
        fmt::format("joint \"{}\": its law {} jumps from {:.6g} to {:.6g} {} at t = {:.6g} s; "
                    "nothing can follow that: use a ramp or a smooth step instead",
                    drive.joint, drive.law.text(), f_a, f_b, drive.unit, b));
  }
}

std::vector<std::string> DriveLaws::check_start(double duration) const {
  std::vector<std::string> out;
  for (const Drive& drive : drives_) {
    if (grows(drive.law, duration, 1)) {
      throw NumericalError(
          drive.where,
          fmt::format("joint \"{}\": its law {} starts at t = 0 with unbounded speed; nothing can "
                      "follow that: let it start with finite speed, better with none (t^2)",
                      drive.joint, drive.law.text()));
    }
    if (grows(drive.law, duration, 2)) {
      out.push_back(fmt::format(
          "joint \"{}\": the acceleration of its law {} is unbounded at t = 0, and joint forces "
          "oscillate in the first steps; let it start more smoothly, such as with t^2",
          drive.joint, drive.law.text()));
    }
  }
  return out;
}

std::vector<std::string> DriveLaws::corners(double duration) const {
  std::vector<std::string> out;
  for (const Drive& drive : drives_) {
    const std::vector<double> times = drive.law.corners();
    const auto inside =
        std::find_if(times.begin(), times.end(), [&](double t) { return t > 0.0 && t < duration; });
    if (inside == times.end()) continue;
    out.push_back(fmt::format(
        "joint \"{}\": its velocity jumps where its table has a corner (first at t = {:.4g} s), "
        "and "
        "joint forces have spikes there that grow with shorter steps; use `interpolation: spline`, "
        "and let a table that is held begin and end at rest",
        drive.joint, *inside));
  }
  return out;
}

}  // namespace buckens::analysis
