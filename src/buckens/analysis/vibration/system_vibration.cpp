// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/vibration/system_vibration.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "buckens/analysis/initial/assembly_moves.h"
#include "buckens/analysis/initial/position_assembly.h"
#include "buckens/analysis/statics/equilibrium.h"
#include "buckens/analysis/vibration/body_vibration.h"
#include "buckens/analysis/vibration/held_faces.h"
#include "buckens/analysis/vibration/mode_damping.h"
#include "buckens/analysis/vibration/system_pencil.h"
#include "buckens/base/errors.h"
#include "buckens/body/shift_estimate.h"
#include "buckens/linalg/inverse_iteration.h"
#include "buckens/model/build/paired_model.h"

namespace buckens::analysis {

using Eigen::Vector3d;
using linalg::Matrix;
using linalg::Vector;

namespace {

// A shift more than this many times the lowest ω² crowds the low modes together.
constexpr double kSlow = 300.0;
constexpr int kMostShifts = 14;
constexpr double kUnsymmetric = 1e-6;
constexpr double kNoShareOfMotion = 1e-6;

class SystemVibrations {
 public:
  SystemVibrations(const model::BuiltModel& built, const SystemVibrationSettings& settings)
      : paired_(built),
        built_(paired_.built()),
        model_(built_.model),
        settings_(settings),
        metric_(model_) {}

  VibrationReport run();

 private:
  void find_position();
  RestTangent tangent();
  double first_shift(const SystemPencil& pencil) const;
  linalg::InversePairs iterate(SystemPencil& pencil);
  void add_vibration(const SystemPencil& pencil, double theta, const Vector& x);
  std::array<double, 3> effective_mass(const SystemPencil& pencil, const Vector& x) const;
  double largest_motion_of(const std::vector<BodyShape>& shape) const;
  void judge(const SystemPencil& pencil, const Matrix& shapes);

  model::PairedModel paired_;
  const model::BuiltModel& built_;
  const model::Model& model_;
  const SystemVibrationSettings settings_;
  dynamics::MassMetric metric_;
  Matrix zero_;
  RestStands stands_;    // in the equilibrium
  RestOrder order_;      // of the pairs among them
  double no_force_ = 0;  // [N]
  VibrationReport out_;
};

void SystemVibrations::find_position() {
  const model::InitialSpec& initial = built_.description.initial;
  out_.position = model::placed_state(model_);
  bool is_closed = true;
  try {
    assemble_positions(model_, metric_, out_.position);
  } catch (const ModelError&) {
    if (!initial.preload) throw;
    is_closed = false;
  }
  out_.notes = built_.description.warnings;
  if (is_closed) {
    for (std::string& text : judge_assembly(built_, assembly_moves(model_, out_.position))) {
      out_.notes.push_back(std::move(text));
    }
  }
  if (settings_.about == RestPosition::static_equilibrium || !is_closed) {
    const StaticReport report =
        find_static_equilibrium(model_, metric_, out_.position, initial.friction, paired_.pairs());
    out_.notes.insert(out_.notes.end(), report.warnings.begin(), report.warnings.end());
    out_.notes.insert(out_.notes.end(), report.notes.begin(), report.notes.end());
    stands_ = report.rest;
    order_ = report.order;
    no_force_ = report.force_tolerance;
    out_.work.factorisations += report.factorisations;
    out_.work.solves += report.solves;
  }
  if (settings_.about == RestPosition::initial) out_.position.lambda.setZero();
}

/// What joints and loads do to small motions. Rows that press are joints.
RestTangent SystemVibrations::tangent() {
  const auto motions = dynamics::motions_of(model_, out_.position);
  dynamics::Constraints constraints;
  dynamics::evaluate_constraints(model_, motions, out_.position.t, &out_.position.memory,
                                 constraints);
  const model::RestFriction friction = built_.description.initial.friction;
  const RestRows rest(model_, friction, out_.position, paired_.pairs());
  RestValues values;
  rest.evaluate(motions, out_.position.t, values);
  const bool is_static = settings_.about == RestPosition::static_equilibrium;
  if (!is_static) {
    const std::string names = rest.unloaded(values, RestStands(rest.size()), 0.0);
    if (!names.empty()) {
      out_.notes.push_back(
          fmt::format("loads {} touch, but no contact force acts as assembled, so they are treated "
                      "as open (--about static finds the contacts that carry load)",
                      names));
    }
    return rest_tangent(model_, out_.position, metric_.split(constraints.rows).independent,
                        RestLoads::springs);
  }
  ClosedRows closed{rest, rest.carried(order_, stands_), {}};
  rest.open_unloaded(no_force_, closed.stands);
  const std::vector<char> holds = rows_that_hold(rest, values, closed.stands, metric_);
  std::vector<int> candidates;
  std::vector<dynamics::SystemRow> rows = constraints.rows;
  for (std::size_t k = 0; k < rest.size(); ++k) {
    if (closed.stands[k].regime == 0 || holds[k] == 0) continue;
    candidates.push_back(static_cast<int>(k));
    rows.push_back(values.rows[k]);
  }
  std::vector<int> joints;
  const int count = static_cast<int>(constraints.rows.size());
  for (const int row : metric_.split(rows).independent) {
    if (row < count) {
      joints.push_back(row);
    } else {
      closed.in_use.push_back(candidates[static_cast<std::size_t>(row - count)]);
    }
  }
  return rest_tangent(model_, out_.position, joints, RestLoads::all, &closed);
}

double SystemVibrations::first_shift(const SystemPencil& pencil) const {
  double lowest = 0.0;
  for (const body::Body& body : model_.bodies) {
    if (!body.is_flexible()) continue;
    const double square = body::lowest_square_estimate(*body.flexible);
    if (square > 0.0 && (lowest == 0.0 || square < lowest)) lowest = square;
  }
  const double frames = pencil.stiffest_frame();
  if (lowest == 0.0) return frames > 0.0 ? frames : 1.0;
  return 0.1 * lowest;
}

linalg::InversePairs SystemVibrations::iterate(SystemPencil& pencil) {
  linalg::InverseIterationSettings settings;
  settings.count = settings_.count;
  settings.tolerance = settings_.tolerance;
  const auto inverse = [&pencil](Matrix& F) { pencil.apply(F); };
  const linalg::MassProduct mass_times = [&pencil](const Matrix& X) {
    return pencil.times_mass(X);
  };
  double shift = first_shift(pencil);
  double drowned = 0.0;
  for (int attempt = 1; attempt <= kMostShifts; ++attempt) {
    try {
      pencil.factorise(shift);
    } catch (const NumericalError&) {
      if (attempt == kMostShifts) throw;
      drowned = shift;
      shift *= 30.0;
      continue;
    }
    ++out_.work.factorisations;
    out_.work.shift = shift;
    if (attempt == 1) zero_ = pencil.zero_modes();
    double next = 0.0;
    settings.is_worthwhile = [&](double theta) {
      const double square = 1.0 / theta - shift;
      if (theta < 0.0 || square * kSlow > shift || shift <= 10.0 * drowned) return true;
      next = std::max({10.0 * drowned, 3.0 * square, 1e-3 * shift});
      return false;
    };
    if (attempt == kMostShifts) settings.is_worthwhile = nullptr;
    linalg::InversePairs pairs =
        linalg::largest_inverse_pairs(mass_times, inverse, zero_, settings);
    out_.work.solves += pairs.solves;
    if (next == 0.0) {
      out_.work.sweeps = pairs.sweeps;
      return pairs;
    }
    shift = next;
  }
  throw NumericalError("system vibrations: no shift makes K + μM positive definite");
}

std::array<double, 3> SystemVibrations::effective_mass(const SystemPencil& pencil,
                                                       const Vector& x) const {
  Vector3d momentum = Vector3d::Zero();  // of the mode at unit speed: participation factors
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    momentum += model_.bodies[b].mass * pencil.frame_part(b, x).tail<3>();
  }
  const double mass = x.dot(pencil.times_mass(x).col(0));
  return {momentum.x() * momentum.x() / mass, momentum.y() * momentum.y() / mass,
          momentum.z() * momentum.z() / mass};
}

double SystemVibrations::largest_motion_of(const std::vector<BodyShape>& shape) const {
  double displacement = 0.0, turned = 0.0;
  for (std::size_t b = 0; b < shape.size(); ++b) {
    const body::Body& body = model_.bodies[b];
    const Eigen::Quaterniond& q = out_.position.bodies[b].frame.X_WB.q;
    const Vector3d w = shape[b].frame.head<3>();
    const Vector3d v = q.conjugate() * shape[b].frame.tail<3>();  // body axes
    turned = std::max(turned, body.length_scale() * w.norm());
    const auto see = [&](const Vector3d& z, const Vector3d& u) {
      displacement = std::max(displacement, (v + w.cross(z) + u).norm());
    };
    see(Vector3d::Zero(), Vector3d::Zero());
    if (!body.is_flexible()) {
      for (const body::Marker& marker : body.markers) see(marker.X_BF.p, Vector3d::Zero());
      continue;
    }
    const fem::FeModel& fe = body.flexible->mesh();
    for (std::size_t node = 0; node < fe.nodes.size(); ++node) {
      Vector3d u = Vector3d::Zero(), theta = Vector3d::Zero();
      for (int a = 0; a < 3; ++a) {
        const int translation = fe.dofs.node_dofs[node][static_cast<std::size_t>(a)];
        const int rotation = fe.dofs.node_dofs[node][static_cast<std::size_t>(a + 3)];
        if (translation >= 0) u[a] = shape[b].d[translation];
        if (rotation >= 0) theta[a] = shape[b].d[rotation];
      }
      see(fe.nodes[node].position - body.com, u);
      turned = std::max(turned, body.length_scale() * (w + theta).norm());
    }
  }
  return displacement > kNoShareOfMotion * turned ? displacement : turned;
}

void SystemVibrations::add_vibration(const SystemPencil& pencil, double theta, const Vector& x) {
  Vibration v;
  v.square = 1.0 / theta - out_.work.shift;
  v.frequency = std::sqrt(std::max(0.0, v.square)) / (2.0 * std::numbers::pi);
  v.effective_mass = effective_mass(pencil, x);
  const std::vector<double> energies = pencil.energies(x);
  for (const model::WholeBody& whole : model_.wholes) {
    double own = 0.0;
    for (int b = whole.first; b < whole.first + whole.count; ++b) {
      own += energies[static_cast<std::size_t>(b)];
    }
    v.energy_shares.push_back(own);
  }
  v.energy_shares.push_back(energies.back());
  double sum = 0.0;
  for (const double energy : v.energy_shares) sum += energy;
  for (double& energy : v.energy_shares) energy = sum != 0.0 ? energy / sum : 0.0;
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    Vector d = pencil.nodal_part(b, x);
    if (model_.bodies[b].is_flexible()) d = model_.bodies[b].flexible->nodal(d);
    v.shape.push_back({pencil.frame_part(b, x), std::move(d)});
  }
  const double largest = largest_motion_of(v.shape);
  v.generalised_mass = x.dot(pencil.times_mass(x).col(0)) / (largest * largest);
  for (BodyShape& shape : v.shape) {
    shape.frame /= largest;
    shape.d /= largest;
  }
  v.damping_ratio = damping_ratio(model_, out_.position, v);
  out_.vibrations.push_back(std::move(v));
}

/// Errors of the modes: one more application of the inverse.
void SystemVibrations::judge(const SystemPencil& pencil, const Matrix& shapes) {
  Matrix image = pencil.times_mass(shapes);
  pencil.apply(image);
  out_.work.solves += image.cols();
  for (Eigen::Index k = 0; k < shapes.cols(); ++k) {
    Vibration& v = out_.vibrations[static_cast<std::size_t>(k)];
    const Vector left = shapes.col(k) - (v.square + out_.work.shift) * image.col(k);
    v.error = std::sqrt(std::max(0.0, left.dot(pencil.times_mass(left).col(0))));
  }
}

VibrationReport SystemVibrations::run() {
  const linalg::Traffic before = linalg::Ranks::traffic();
  const auto begin = std::chrono::steady_clock::now();
  out_.subject = "system";
  out_.work.method = "subspace";
  for (const model::WholeBody& whole : model_.wholes) {
    out_.mass += whole.mass;
    out_.energy_groups.push_back(whole.name);
  }
  out_.energy_groups.emplace_back("joints and loads");
  find_position();
  const RestTangent tangent = this->tangent();
  if (tangent.asymmetry > kUnsymmetric) {
    out_.notes.push_back(
        fmt::format("loads that follow the motion make the stiffness unsymmetric ({:.1e}); the "
                    "frequencies are those of its symmetric part",
                    tangent.asymmetry));
  }
  SystemPencil pencil(model_, out_.position, tangent);
  out_.dof = pencil.size();
  const linalg::InversePairs pairs = iterate(pencil);
  if (!pairs.is_complete) {
    throw NumericalError(
        fmt::format("system vibrations: the {} lowest modes did not converge in "
                    "{} sweeps; ask for fewer modes (--count)",
                    settings_.count, pairs.sweeps));
  }
  out_.rigid_modes = static_cast<int>(zero_.cols());
  for (Eigen::Index k = 0; k < pairs.theta.size(); ++k) {
    add_vibration(pencil, pairs.theta[k], pairs.shapes.col(k));
  }
  judge(pencil, pairs.shapes);
  std::stable_sort(out_.vibrations.begin(), out_.vibrations.end(),
                   [](const Vibration& a, const Vibration& b) { return a.square < b.square; });
  if (!out_.vibrations.empty() && out_.vibrations.front().square < 0.0) {
    out_.notes.push_back(fmt::format("the position is unstable: a motion grows at {:.4g} 1/s",
                                     std::sqrt(-out_.vibrations.front().square)));
  }
  out_.work.factor_entries = pencil.factor_entries();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  out_.work.seconds = took.count();
  out_.work.traffic = linalg::Ranks::traffic().since(before);
  return std::move(out_);
}

}  // namespace

VibrationReport system_vibrations(const model::BuiltModel& built,
                                  const SystemVibrationSettings& settings) {
  return SystemVibrations(built, settings).run();
}

}  // namespace buckens::analysis
