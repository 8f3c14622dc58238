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
}  // namespace

DriveLaws::DriveLaws(const model::ModelDescription& description) {
  for (const joints::JointSpec& joint : description.joints) {
    if (const auto* turn = std::get_if<joints::PrescribedRotationSpec>(&joint.kind)) {
      const base::TimeLaw law = turn->law();
      if (!law.is_constant()) drives_.push_back({joint.name, joint.where, law, "rad"});
    } else if (const auto* push = std::get_if<joints::PrescribedTranslationSpec>(&joint.kind)) {
      if (!push->displacement.is_constant()) {
        drives_.push_back({joint.name, joint.where, push->displacement, "m"});
      }
    }
  }
}

void DriveLaws::check(double from, double to) const {
  for (const Drive& drive : drives_) {
    double a = from;
    double b = to;
    double f_a = drive.law.value(a);
    double f_b = drive.law.value(b);
    double halfway = 0;
    // Follow the half in which more happens. A smooth law changes 64 times less in 64 times less
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
