// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/step_advice.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "buckens/analysis/simulation/turn.h"
#include "buckens/body/free_free_modes.h"
#include "buckens/body/of_body.h"
#include "buckens/body/rigid_modes.h"
#include "buckens/model/build/eliminate_links.h"

namespace buckens::analysis {

namespace {
constexpr double kExcitedShare = 0.01;
constexpr double kResolved = kTurn / 12;  // h ω: twelve steps per period

/// The lowest free vibrations of a mesh.
body::FreeModes modes_of_mesh(const fem::FeModel& fe, int count) {
  std::vector<Eigen::Vector3d> positions;
  for (const fem::Node& node : fe.nodes) positions.push_back(node.position);
  return body::free_modes(fe.M, fe.K, body::rigid_modes(positions, fe.dofs, fe.shape.com), count);
}

/// Adds the compliance that each mode gives to a point.
void add_share(const body::FreeModes& modes, const linalg::Matrix& moved, linalg::Vector& share) {
  share += moved.colwise().squaredNorm().transpose().cwiseQuotient(modes.omega.cwiseAbs2());
}

ExcitedBand band_of(const body::FreeModes& modes, const linalg::Vector& share) {
  const double total = share.sum();
  ExcitedBand band;
  band.first = modes.omega[0];
  for (Eigen::Index k = 0; k < share.size(); ++k) {
    if (share[k] <= kExcitedShare * total) continue;
    band.excited.push_back(modes.omega[k]);
    band.highest = std::max(band.highest, modes.omega[k]);
  }
  return band;
}

ExcitedBand band_of_body(const body::Body& body, const body::FreeModes& modes) {
  if (modes.omega.size() == 0) return {};
  if (body.flexible->is_quasi_static) return {modes.omega[0], 0.0, {}};  // nothing vibrates
  linalg::Vector share = linalg::Vector::Zero(modes.omega.size());
  for (const body::Marker& marker : body.markers) {
    if (!marker.follows_mesh() || marker.translation_row >= body.flexible->num_held_rows()) {
      continue;
    }
    add_share(modes, body.flexible->rows.middleRows(marker.translation_row, 3) * modes.shapes,
              share);
  }
  const body::FlexiblePart& part = *body.flexible;
  if (part.num_pattern_rows > 0) {
    add_share(modes,
              part.rows.middleRows(part.num_held_rows(), part.num_pattern_rows) * modes.shapes,
              share);
  }
  return band_of(modes, share);
}

}  // namespace

namespace {

/// Of the whole mesh; shapes over all its nodal variables.
body::FreeModes modes_of_whole(const model::Model& model, const model::WholeBody& whole) {
  const bool has_rigid_region = std::any_of(whole.interfaces.begin(), whole.interfaces.end(),
                                            [](const auto& region) { return region.is_rigid; });
  if (!has_rigid_region) return modes_of_mesh(*whole.mesh, kReportedModes);
  const body::Body& first = model.bodies[static_cast<std::size_t>(whole.first)];
  const auto part = model::undivided_part(whole, first.flexible->coupling);
  body::FreeModes out = body::free_free_modes(*part, kReportedModes);
  linalg::Matrix shapes(whole.mesh->M.rows(), out.shapes.cols());
  for (Eigen::Index k = 0; k < shapes.cols(); ++k) shapes.col(k) = part->nodal(out.shapes.col(k));
  out.shapes = std::move(shapes);
  return out;
}

}  // namespace

body::FreeModes reported_modes(const model::Model& model, const model::WholeBody& whole) {
  if (whole.is_divided()) return modes_of_whole(model, whole);
  const body::Body& body = model.bodies[static_cast<std::size_t>(whole.first)];
  if (!body.is_flexible()) return {};
  if (body.flexible->is_quasi_static) return modes_of_mesh(body.flexible->mesh(), kReportedModes);
  return body::of_body(body.name,
                       [&] { return body::free_free_modes(*body.flexible, kReportedModes); });
}

ExcitedBand excited_band(const body::Body& body) {
  if (!body.is_flexible()) return {};
  if (body.flexible->is_quasi_static) {
    return band_of_body(body, modes_of_mesh(body.flexible->mesh(), 1));
  }
  return band_of_body(body, body::of_body(body.name, [&] {
                        return body::free_free_modes(*body.flexible, kReportedModes);
                      }));
}

ExcitedBand excited_band(const model::Model& model, const model::WholeBody& whole) {
  return excited_band(model, whole, reported_modes(model, whole));
}

ExcitedBand excited_band(const model::Model& model, const model::WholeBody& whole,
                         const body::FreeModes& modes) {
  if (!whole.is_divided()) {
    return band_of_body(model.bodies[static_cast<std::size_t>(whole.first)], modes);
  }
  const fem::FeModel& fe = *whole.mesh;
  if (modes.omega.size() == 0) return {};
  linalg::Vector share = linalg::Vector::Zero(modes.omega.size());
  const auto add = [&](const model::MarkerId& id) {
    if (id.body < whole.first || id.body >= whole.first + whole.count) return;
    const body::Body& part = model.bodies[static_cast<std::size_t>(id.body)];
    const int node = part.markers[static_cast<std::size_t>(id.marker)].node;
    for (std::size_t n = 0; n < whole.nodes.size(); ++n) {
      if (whole.nodes[n].body != id.body || whole.nodes[n].index != node) continue;
      const auto& dofs = fe.dofs.node_dofs[n];
      linalg::Matrix moved = linalg::Matrix::Zero(3, modes.omega.size());
      for (std::size_t k = 0; k < 3; ++k) {
        if (dofs[k] >= 0) moved.row(static_cast<Eigen::Index>(k)) = modes.shapes.row(dofs[k]);
      }
      add_share(modes, moved, share);
    }
  };
  for (const model::Joint& joint : model.joints) {
    if (joint.is_tie) continue;
    add(joint.first);
    add(joint.second);
  }
  for (const model::Load& load : model.loads) {
    add(load.first);
    add(load.second);
    for (const model::MarkerId& id : load.others) add(id);
  }
  return band_of(modes, share);
}

double two_digits_below(double value) {
  const double digit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  // What is two digits but for rounding stays.
  return digit * std::floor(value / digit * (1.0 + 1e-12));
}

std::string judge_step(const std::string& body, const ExcitedBand& band, double h, double every) {
  double lowest = 0;  // of the excited vibrations that records can show
  double highest = 0;
  for (const double omega : band.excited) {
    if (omega * every > std::numbers::pi) continue;
    if (lowest == 0.0) lowest = omega;
    highest = std::max(highest, omega);
  }
  if (h * highest <= kResolved) return {};
  const double followed = kResolved / (kTurn * h);
  if (h * lowest > kResolved) {
    return fmt::format(
        "step {:.3g} s is too long for every elastic vibration of body \"{}\" (lowest {:.4g} Hz; "
        "followed up to {:.4g} Hz): it is damped, not followed; use a step of {:.2g} s",
        h, body, lowest / kTurn, followed, two_digits_below(kResolved / lowest));
  }
  return fmt::format(
      "step {:.3g} s follows vibrations of body \"{}\" up to {:.4g} Hz; those excited above that "
      "the records could show, up to {:.4g} Hz, are damped; use a step of {:.2g} s if they matter",
      h, body, followed, highest / kTurn, two_digits_below(kResolved / highest));
}

std::string judge_frequency(const std::string& body, double omega) {
  constexpr double kHardlyMeant = 1e6;  // [Hz]
  const double frequency = omega / kTurn;
  if (frequency <= kHardlyMeant) return {};
  return fmt::format(
      "body \"{}\": its lowest free vibration is at {:.3g} Hz, above 1 MHz; check the units of its "
      "lengths, modulus and density",
      body, frequency);
}

}  // namespace buckens::analysis
