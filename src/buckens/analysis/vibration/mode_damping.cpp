// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/vibration/mode_damping.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <variant>

#include <fmt/format.h>

#include "buckens/analysis/simulation/turn.h"
#include "buckens/analysis/vibration/system_vibration.h"
#include "buckens/base/errors.h"
#include "buckens/dynamics/forces.h"

namespace buckens::analysis {

namespace {

constexpr int kCheckedModes = 6;
// `buckens check` answers quickly; larger systems would need minutes of factorisation.
constexpr Eigen::Index kMostCheckedUnknowns = 30000;
// A ratio is meant for vibrations of that body, at frequencies near those that it names.
constexpr double kOwnShare = 0.9;
constexpr double kNearFrequency = 0.1;
constexpr double kOtherRatio = 0.2;

std::vector<dynamics::BodyMotion> at_rest(const model::Model& model, const model::State& position) {
  auto motions = dynamics::motions_of(model, position);
  for (dynamics::BodyMotion& motion : motions) {
    motion.frame.w.setZero();
    motion.frame.v.setZero();
    motion.y_dot.setZero();
  }
  return motions;
}

/// The damping of a body of the model file: its own, or that of its material.
const fem::DampingSpec* damping_of(const body::BodySpec& spec) {
  if (spec.damping) return &*spec.damping;
  const auto of_material = [](const fem::MaterialSpec& material) {
    return material.damping ? &*material.damping : nullptr;
  };
  return std::visit(
      [&](const auto& kind) -> const fem::DampingSpec* {
        using Kind = std::decay_t<decltype(kind)>;
        if constexpr (std::is_same_v<Kind, fem::BeamSpec>) return of_material(*kind.material);
        if constexpr (std::is_same_v<Kind, fem::StructureSpec>) {
          if (!kind.beams.empty()) return of_material(*kind.beams.front().material);
        }
        if constexpr (requires { kind.material->value; }) {
          if (kind.material) return of_material(**kind.material);
        }
        return nullptr;
      },
      spec.kind);
}

/// ζ of α and β at a frequency, where the ratio is meant for it.
std::optional<double> asked_ratio(const fem::DampingSpec& spec, double frequency) {
  if (!spec.ratio || frequency < (1.0 - kNearFrequency) * spec.at.front() ||
      frequency > (1.0 + kNearFrequency) * spec.at.back()) {
    return std::nullopt;
  }
  const double omega = kTurn * frequency;
  return 0.5 * (spec.alpha() / omega + spec.beta() * omega);
}

std::string remedy(const fem::DampingSpec& spec) {
  if (spec.of == fem::DampedModes::free && spec.at.size() == 2) {
    return "`of: free` refers to the vibrations of the unsupported body; use `of: held` for those "
           "of the assembled model";
  }
  return "other bodies move with it, or the position differs; adjust `ratio` and `at` until "
         "`buckens check` lists the damping you want";
}

ModeDamping describe(const model::BuiltModel& built, const VibrationReport& vibrations,
                     const Vibration& vibration) {
  ModeDamping out;
  out.frequency = vibration.frequency;
  out.ratio = vibration.damping_ratio;
  const auto& shares = vibration.energy_shares;
  const auto most = std::max_element(shares.begin(), shares.end()) - shares.begin();
  out.body = vibrations.energy_groups[static_cast<std::size_t>(most)];
  out.share = shares[static_cast<std::size_t>(most)];
  if (static_cast<std::size_t>(most) >= built.description.bodies.size()) return out;
  const fem::DampingSpec* spec =
      damping_of(built.description.bodies[static_cast<std::size_t>(most)]);
  if (spec != nullptr && out.share >= kOwnShare) out.asked = asked_ratio(*spec, out.frequency);
  return out;
}

/// Reports the first vibration of each body whose ratio differs from the requested one.
void compare(const model::BuiltModel& built, ModeDampingReport& out) {
  for (const body::BodySpec& spec : built.description.bodies) {
    const auto found = std::find_if(out.modes.begin(), out.modes.end(), [&](const auto& mode) {
      return mode.body == spec.name && mode.asked &&
             std::abs(mode.ratio - *mode.asked) > kOtherRatio * *mode.asked;
    });
    if (found == out.modes.end()) continue;
    out.notes.push_back(fmt::format(
        "body \"{}\": the vibration at {:.4g} Hz has {:.2g} % of critical damping, `ratio` asks "
        "for {:.2g} % there: {}",
        spec.name, found->frequency, 100 * found->ratio, 100 * *found->asked,
        remedy(*damping_of(spec))));
  }
}

}  // namespace

double damping_ratio(const model::Model& model, const model::State& position,
                     const Vibration& vibration) {
  if (!(vibration.square > 0.0)) return 0.0;
  double work = 0.0;  // φᵀCφ
  std::vector<Eigen::VectorXd> y(model.bodies.size());
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const body::Body& body = model.bodies[b];
    if (!body.is_flexible()) continue;
    const linalg::Vector d = body.flexible->coordinates(vibration.shape[b].d);
    if (body.flexible->is_damped()) work += d.dot(body.flexible->C * d);
    y[b] = body.row_values(d);
  }
  dynamics::SoftRows soft;
  dynamics::evaluate_soft_rows(model, at_rest(model, position), soft);
  for (std::size_t k = 0; k < soft.rows.size(); ++k) {
    double rate = 0.0;
    for (const dynamics::BodyRow* part : soft.rows[k].parts()) {
      if (part->body == model::kGround) continue;
      const auto b = static_cast<std::size_t>(part->body);
      rate += part->change(vibration.shape[b].frame, y[b]);
    }
    work += soft.damping[k] * rate * rate;
  }
  return work / (2.0 * std::sqrt(vibration.square) * vibration.generalised_mass);
}

bool has_damping(const model::Model& model, const model::State& position) {
  const bool of_bodies = std::any_of(
      model.bodies.begin(), model.bodies.end(),
      [](const body::Body& body) { return body.is_flexible() && body.flexible->is_damped(); });
  if (of_bodies) return true;
  dynamics::SoftRows soft;
  dynamics::evaluate_soft_rows(model, at_rest(model, position), soft);
  return std::any_of(soft.damping.begin(), soft.damping.end(), [](double c) { return c > 0.0; });
}

ModeDampingReport report_mode_damping(const model::BuiltModel& built,
                                      const model::State& assembled) {
  ModeDampingReport out;
  if (!has_damping(built.model, assembled)) return out;
  Eigen::Index unknowns = 0;
  for (const body::Body& body : built.model.bodies) unknowns += body.num_dofs();
  if (unknowns > kMostCheckedUnknowns) {
    out.notes.push_back(
        fmt::format("damping ratios of the assembled system are not listed for {} unknowns; "
                    "`buckens modes --system` lists them",
                    unknowns));
    return out;
  }
  try {
    SystemVibrationSettings settings;
    settings.count = kCheckedModes;
    const VibrationReport vibrations = system_vibrations(built, settings);
    for (const Vibration& vibration : vibrations.vibrations) {
      if (vibration.square > 0.0) out.modes.push_back(describe(built, vibrations, vibration));
    }
  } catch (const Error& error) {
    out.notes.push_back(fmt::format(
        "damping ratios of the assembled system cannot be determined: {}", error.text()));
  }
  compare(built, out);
  return out;
}

}  // namespace buckens::analysis
