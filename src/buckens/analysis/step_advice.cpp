// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/step_advice.h"

#include <algorithm>
#include <numbers>

#include <fmt/format.h>

#include "buckens/body/free_modes.h"

namespace buckens::analysis {

namespace {
constexpr int kModes = 10;
constexpr double kExcitedShare = 0.01;
constexpr double kResolved = 0.5;  // h ω: about twelve steps per period
constexpr double kTurn = 2.0 * std::numbers::pi;
}  // namespace

ExcitedBand excited_band(const body::Body& body) {
  if (!body.is_flexible()) return {};
  const fem::FeModel& fe = body.flexible->fe;
  const body::FreeModes modes = body::free_modes(fe.M, fe.K, body.flexible->sieve.Phi(), kModes);
  if (modes.omega.size() == 0) return {};
  linalg::Vector share = linalg::Vector::Zero(modes.omega.size());
  for (const body::Marker& marker : body.markers) {
    if (!marker.follows_mesh() || marker.translation_row >= body.num_interface_rows()) continue;
    const linalg::Matrix moved =
        body.flexible->rows.middleRows(marker.translation_row, 3) * modes.shapes;
    share += moved.colwise().squaredNorm().transpose().cwiseQuotient(modes.omega.cwiseAbs2());
  }
  const double total = share.sum();
  ExcitedBand band;
  band.first = modes.omega[0];
  for (Eigen::Index k = 0; k < share.size(); ++k) {
    if (share[k] <= kExcitedShare * total) continue;
    if (band.lowest == 0.0) band.lowest = modes.omega[k];
    band.highest = std::max(band.highest, modes.omega[k]);
  }
  return band;
}

std::string judge_step(const std::string& body, const ExcitedBand& band, double h) {
  if (h * band.highest <= kResolved) return {};
  const double followed = kResolved / (kTurn * h);
  if (h * band.lowest > kResolved) {
    return fmt::format(
        "step {:.3g} s is too long for every elastic vibration of body \"{}\" (lowest {:.4g} Hz; "
        "followed up to {:.4g} Hz): it is damped, not followed; use a step of {:.2g} s",
        h, body, band.lowest / kTurn, followed, kResolved / band.lowest);
  }
  return fmt::format(
      "step {:.3g} s follows vibrations of body \"{}\" up to {:.4g} Hz; those excited above, up to "
      "{:.4g} Hz, are damped; use a step of {:.2g} s if they matter",
      h, body, followed, band.highest / kTurn, kResolved / band.highest);
}

}  // namespace buckens::analysis
