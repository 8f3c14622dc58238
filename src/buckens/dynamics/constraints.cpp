// SPDX-License-Identifier: Apache-2.0
#include "buckens/dynamics/constraints.h"

#include <utility>

#include "buckens/dynamics/circumstances.h"
#include "buckens/dynamics/summed_coordinate.h"

namespace buckens::dynamics {

namespace {

using spatial::MarkerBias;
using Twists = Eigen::Matrix<double, 12, 1>;

Twists twists(const spatial::MarkerMotion& first, const spatial::MarkerMotion& second) {
  Twists V;
  V << first.w, first.v, second.w, second.v;
  return V;
}

/// The row of a coupler: shares of all joints whose coordinates it couples.
void evaluate_coupler(const model::Model& model, const model::Joint& joint,
                      const std::vector<BodyMotion>& motions, double t,
                      const model::RowMemory* memory, Constraints& out) {
  joints::CouplerSum sum;
  double rate = 0.0;
  SystemRow row;
  size_coupler_row(model, joint, row);
  std::size_t part = 0;
  for (const model::CoupledCoordinate& coupled : joint.coupled) {
    const SummedCoordinate own(model, coupled, motions, t, memory);
    sum.add(coupled.term, own.value());
    rate += own.rate();
    own.derive(row, part);
  }
  const joints::ConstraintRow& drive = joint.rows.front();
  const double* const states = states_of(joint, memory);
  const double ahead = drive.driven_rate(t, states);
  out.g[joint.first_row] = sum.value() - drive.driven_to(t, states);
  out.g_dot[joint.first_row] = rate - ahead;
  out.g_t[joint.first_row] = -ahead;
  out.rows[static_cast<std::size_t>(joint.first_row)] = std::move(row);
}

/// The rows of a slider on a beam.
void evaluate_slider(const model::Model& model, const model::Joint& joint,
                     const std::vector<BodyMotion>& motions, double t,
                     const model::RowMemory* memory, Constraints& out) {
  const Travel travel(model, joint, motions, memory);
  for (std::size_t k = 0; k < joint.rows.size(); ++k) {
    const Travel::Row value = travel.row(joint.rows[k], t);
    const int row = joint.first_row + static_cast<int>(k);
    out.g[row] = value.g;
    out.g_dot[row] = travel.rate_of(value);
    out.g_t[row] = value.g_t;
    travel.derive(value, joint.first_row, out.rows[static_cast<std::size_t>(row)]);
  }
}

/// Joints that have let go ask for nothing: their rows are zero, and so depend on any others.
void open_released(const model::Model& model, const model::RowMemory* memory, Constraints& out) {
  if (memory == nullptr || memory->released.empty()) return;
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    if (!memory->is_released(j)) continue;
    for (std::size_t k = 0; k < model.joints[j].rows.size(); ++k) {
      const int row = model.joints[j].first_row + static_cast<int>(k);
      out.g[row] = out.g_dot[row] = out.g_t[row] = 0.0;
      out.rows[static_cast<std::size_t>(row)].clear();
    }
  }
}

double coupler_bias(const model::Model& model, const model::Joint& joint,
                    const std::vector<BodyMotion>& motions, double t,
                    const model::RowMemory* memory) {
  double out = -joint.rows.front().driven_acceleration(t, states_of(joint, memory));
  for (const model::CoupledCoordinate& coupled : joint.coupled) {
    out += SummedCoordinate(model, coupled, motions, t, memory).bias();
  }
  return out;
}

}  // namespace

void evaluate_constraints(const model::Model& model, const std::vector<BodyMotion>& motions,
                          double t, Constraints& out) {
  evaluate_constraints(model, motions, t, nullptr, out);
}

void evaluate_constraints(const model::Model& model, const std::vector<BodyMotion>& motions,
                          double t, const model::RowMemory* memory, Constraints& out) {
  const int count = model.num_constraint_rows();
  out.g.resize(count);
  out.g_dot.resize(count);
  out.g_t.resize(count);
  out.rows.resize(static_cast<std::size_t>(count));
  for (const model::Joint& joint : model.joints) {
    if (!joint.coupled.empty()) {
      evaluate_coupler(model, joint, motions, t, memory, out);
      continue;
    }
    if (joint.track) {
      evaluate_slider(model, joint, motions, t, memory, out);
      continue;
    }
    const auto first = evaluate_marker(model, joint.first, motions);
    const auto second = evaluate_marker(model, joint.second, motions);
    const Twists V = twists(first.motion, second.motion);
    const double* states = states_of(joint, memory);
    int row = joint.first_row;
    for (const joints::ConstraintRow& constraint : joint.rows) {
      const joints::RowValue value = constraint.evaluate(first.motion, second.motion, t, states);
      if (states != nullptr) states += constraint.num_states();
      out.g[row] = value.g;
      out.g_dot[row] = value.J.dot(V) + value.g_t;
      out.g_t[row] = value.g_t;
      out.rows[static_cast<std::size_t>(row)] =
          system_row(model, joint.first, first, joint.second, second, value.J);
      ++row;
    }
  }
  open_released(model, memory, out);
}

std::vector<int> held_rows(const model::Model& model, const model::RowMemory& memory,
                           const std::vector<int>& rows) {
  if (memory.released.empty()) return rows;
  std::vector<int> out;
  for (const int row : rows) {
    const model::Joint* owner = model.owner_of_row(row).first;
    if (!memory.is_released(static_cast<std::size_t>(owner - model.joints.data()))) {
      out.push_back(row);
    }
  }
  return out;
}

std::vector<char> rate_only_rows(const model::Model& model) {
  std::vector<char> out;
  for (const model::Joint& joint : model.joints) {
    for (const joints::ConstraintRow& row : joint.rows) {
      out.push_back(row.holds_rates_only() ? 1 : 0);
    }
  }
  return out;
}

linalg::Vector constraint_bias(const model::Model& model, const std::vector<BodyMotion>& motions,
                               double t, const model::RowMemory* memory) {
  linalg::Vector bias(model.num_constraint_rows());
  for (const model::Joint& joint : model.joints) {
    if (!joint.coupled.empty()) {
      bias[joint.first_row] = coupler_bias(model, joint, motions, t, memory);
      continue;
    }
    if (joint.track) {
      const Travel travel(model, joint, motions, memory);
      for (std::size_t k = 0; k < joint.rows.size(); ++k) {
        bias[joint.first_row + static_cast<int>(k)] = travel.bias(joint.rows[k], t);
      }
      continue;
    }
    const auto first = evaluate_marker(model, joint.first, motions);
    const auto second = evaluate_marker(model, joint.second, motions);
    const MarkerBias bias_first = evaluate_bias(model, joint.first, motions);
    const MarkerBias bias_second = evaluate_bias(model, joint.second, motions);
    const double* states = states_of(joint, memory);
    for (std::size_t k = 0; k < joint.rows.size(); ++k) {
      const joints::ConstraintRow& row = joint.rows[k];
      bias[joint.first_row + static_cast<int>(k)] =
          row.bias(first.motion, second.motion, bias_first, bias_second, t, states);
      if (states != nullptr) states += row.num_states();
    }
  }
  for (std::size_t j = 0; memory != nullptr && j < model.joints.size(); ++j) {
    if (!memory->is_released(j)) continue;
    bias.segment(model.joints[j].first_row, std::ssize(model.joints[j].rows)).setZero();
  }
  return bias;
}

}  // namespace buckens::dynamics
