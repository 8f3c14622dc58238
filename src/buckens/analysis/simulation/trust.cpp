// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/trust.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace buckens::analysis {

namespace {

// Tolerance of drawings; Newton iterations leave 1e-12 at most.
constexpr double kOpenJoint = 1e-6;
// Visible in a curve of velocities.
constexpr double kOpenRate = 1e-4;
constexpr double kLargeEnergyError = 0.05;

}  // namespace

void JointTrust::add_step(const stepping::StepReport& report, const model::State& state) {
  for (const model::BodyState& body : state.bodies) {
    speed_ = std::max({speed_, body.frame.w.norm(), body.frame.v.norm() / model_.length});
  }
  opening_rate_ = std::max(opening_rate_, report.opening_rate);
  if (report.opening <= opening_) return;
  opening_ = report.opening;
  most_open_row_ = report.most_open_row;
}

std::string JointTrust::doubt(double duration) const {
  if (opening_ > kOpenJoint) {
    return fmt::format(
        "joints are open by up to {:.2g} of the model's length or rad (joint \"{}\"); use "
        "`projection: on` or a smaller step",
        opening_, model_.owner_of_row(most_open_row_).first->name);
  }
  if (opening_rate_ > kOpenRate * speed_ && opening_rate_ * duration > kOpenJoint) {
    return fmt::format(
        "velocities violate the joints by up to {:.2g} of the largest velocity; use a smaller "
        "step or `newton-tolerance`",
        opening_rate_ / speed_);
  }
  return {};
}

void EnergyTrust::add_record(const model::State& state) {
  for (std::size_t b = 0; b < leaves_out_.size(); ++b) {
    if (!model_.bodies[b].is_flexible()) continue;
    const body::CouplingTerms& terms = state.bodies[b].terms;
    // Each of these three derives from a kinetic energy.
    const bool keeps_energy = terms == body::CouplingTerms{} ||
                              terms == body::CouplingTerms::first_order() ||
                              terms == body::CouplingTerms::none();
    if (!keeps_energy) leaves_out_[b] = true;
  }
}

std::string EnergyTrust::doubt(double error) const {
  if (error <= kLargeEnergyError) return {};
  std::vector<std::string> names;
  for (const model::WholeBody& whole : model_.wholes) {
    const auto first = leaves_out_.begin() + whole.first;
    if (std::any_of(first, first + whole.count, [](bool leaves_out) { return leaves_out; })) {
      names.push_back(fmt::format("\"{}\"", whole.name));
    }
  }
  const std::string size =
      fmt::format("the energy balance is open by {:.2g} of the energy involved", error);
  if (names.empty()) return size + "; use a smaller step";
  return fmt::format(
      "{}, whatever the step: without single terms of inertial coupling, or with "
      "`geometric-stiffness`, the equations of bod{} {} follow from no energy; use `coupling: "
      "full`, "
      "or more `frames` in place of `geometric-stiffness`",
      size, names.size() == 1 ? "y" : "ies", fmt::join(names, ", "));
}

std::string describe_spin(const std::string& body, double ratio) {
  return fmt::format(
      "body \"{}\" spins at up to {:.2g} of its lowest elastic frequency; linear elasticity in one "
      "frame does not include centrifugal stiffening: give the body more `frames`",
      body, ratio);
}

}  // namespace buckens::analysis
