// SPDX-License-Identifier: Apache-2.0
// Which rigid rows at rest hold, and with what force.
#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "buckens/analysis/statics/rest_rows.h"
#include "buckens/dynamics/travel.h"
#include "buckens/loads/ball_friction.h"
#include "buckens/loads/contact.h"
#include "buckens/loads/contact_friction.h"
#include "buckens/loads/coordinate_motor.h"

namespace buckens::analysis {

using Kind = RestRow::Kind;

namespace {

// Of rows that share a load: about ten times what closed ones are left with.
constexpr double kSharing = 1e-11;
// Overlap at the start that is worth a warning.
constexpr double kLargeOverlap = 1e-3;

}  // namespace

RestStands RestRows::start(const RestValues& values) const {
  RestStands out(rows_.size());
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    if (touches(k, values)) out[k].regime = values.contacts[k].regime;
    if (rows_[k].kind == Kind::held) out[k].regime = 1;
  }
  follow_contacts(values, out);
  return out;
}

void RestRows::share(const RestValues& values, RestStands& stands) const {
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    stands[k].force = 0.0;
    if (rows_[k].kind != Kind::one_sided || values.contacts[k].gap > kSharing * length_of(k)) {
      continue;
    }
    stands[k].regime = values.contacts[k].regime;
  }
  end_landings(stands);
  follow_contacts(values, stands);
}

void RestRows::follow_contacts(const RestValues& values, RestStands& stands) const {
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    if (rows_[k].kind != Kind::along) continue;
    if (rows_[k].is_elastic()) {
      const bool lands = values.nears[k] != 0 && stands[k].regime == kLanding;
      stands[k].regime = lands ? kLanding : values.presses[k];
      continue;
    }
    const auto across = static_cast<std::size_t>(rows_[k].across);
    stands[k].regime = stands[across].regime != 0 && touches(across, values) ? 1 : 0;
  }
}

void RestRows::end_landings(RestStands& stands) const {
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    if (rows_[k].is_elastic() && stands[k].regime == kLanding) stands[k].regime = 0;
  }
}

std::vector<HeldContact> RestRows::held_contacts(const RestValues& values,
                                                 const RestStands& stands) const {
  std::vector<HeldContact> out;
  for (std::size_t k = 0, end = 0; k < rows_.size(); k = end) {
    const RestRow& row = rows_[k];
    end = k + 1;
    if (!row.is_elastic()) continue;
    while (end < rows_.size() && rows_[end].load == row.load && rows_[end].pair == row.pair) ++end;
    HeldContact held{row.load, std::nullopt, {}};
    if (row.pair >= 0) held.pair = pair(k);
    for (std::size_t i = k; i < end; ++i) {
      const double force = stands[i].force;
      held.along += {force * values.pushes[i].torque, force * values.pushes[i].force};
    }
    if (held.along.force.squaredNorm() + held.along.torque.squaredNorm() > 0.0) out.push_back(held);
  }
  return out;
}

void RestRows::open_unloaded(double force, RestStands& stands) const {
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    if (rows_[k].kind != Kind::one_sided) continue;
    if (push(k, stands[k]) * (rows_[k].is_angle ? 1.0 / model_.length : 1.0) <= force) {
      stands[k].regime = 0;
    }
  }
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    if (rows_[k].kind != Kind::along || rows_[k].across < 0) continue;
    if (stands[static_cast<std::size_t>(rows_[k].across)].regime == 0) stands[k].regime = 0;
  }
}

double RestRows::deepest(const RestValues& values, const RestStands& stands) const {
  double out = 0.0;
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    if (rows_[k].kind != Kind::one_sided || stands[k].regime != 0) continue;
    out = std::max(out, -values.contacts[k].gap / length_of(k));
  }
  return out;
}

double RestRows::strongest_pull(const RestStands& stands) const {
  double out = 0.0;
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const double lever = rows_[k].is_angle ? model_.length : 1.0;
    out = std::max(out, -push(k, stands[k]) / lever);
  }
  return out;
}

double RestRows::strongest(const RestStands& stands) const {
  double out = 0.0;
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    out = std::max(out, std::abs(stands[k].force) / (rows_[k].is_angle ? model_.length : 1.0));
  }
  return out;
}

RestStands RestRows::of_loads(const RestValues& values, const RestStands& stands) const {
  RestStands out;
  if (rows_.empty()) return out;
  out.resize(model_.loads.size());
  // Each pair of bodies by itself.
  std::map<std::pair<std::size_t, int>, Eigen::Vector3d> sums;
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const std::size_t load = rows_[k].load;
    if (model_.loads[load].coordinate >= 0) {
      out[load] = stands[k];
    } else {
      sums.try_emplace({load, rows_[k].pair}, Eigen::Vector3d::Zero()).first->second +=
          stands[k].force * values.pushes[k].force;
    }
  }
  for (const auto& [of, sum] : sums) out[of.first] = {1, out[of.first].force + sum.norm()};
  return out;
}

std::string RestRows::unloaded(const RestValues& values, const RestStands& stands,
                               double force) const {
  std::map<std::string, bool> presses;  // of what touches
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    if (!touches(k, values)) continue;
    const double lever = rows_[k].is_angle ? model_.length : 1.0;
    presses[name(k)] = presses[name(k)] || push(k, stands[k]) / lever > force;
  }
  std::string out;
  for (const auto& [name, is_pressed] : presses) {
    if (!is_pressed) out += fmt::format("{}\"{}\"", out.empty() ? "" : ", ", name);
  }
  return out;
}

std::vector<std::string> RestRows::overlaps(const RestValues& values) const {
  std::map<std::string, std::pair<double, bool>> deepest;
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    if (rows_[k].kind != Kind::one_sided) continue;
    const double depth = -values.contacts[k].gap;
    if (depth <= kLargeOverlap * length_of(k)) continue;
    auto& worst = deepest[name(k)];
    worst = {std::max(worst.first, depth), rows_[k].is_angle};
  }
  std::vector<std::string> out;
  for (const auto& [name, worst] : deepest) {
    out.push_back(
        fmt::format("load \"{}\" starts {:.3g} {} beyond its end; the static equilibrium begins by "
                    "pushing it out; place the bodies apart",
                    name, worst.first, worst.second ? "rad" : "m"));
  }
  return out;
}

}  // namespace buckens::analysis
