// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/static_state.h"

#include <algorithm>
#include <cmath>

namespace buckens::analysis {

using linalg::Vector;

Compliances::Compliances(const model::Model& model) {
  for (const body::Body& body : model.bodies) {
    if (body.is_flexible()) owned.push_back(std::make_unique<ElasticCompliance>(body));
    of_body.push_back(body.is_flexible() ? owned.back().get() : nullptr);
  }
}

StaticPoint static_point(const model::Model& model, const model::State& state) {
  StaticPoint point;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const body::Body& body = model.bodies[b];
    point.poses.push_back(state.bodies[b].frame.X_WB);
    point.y.push_back(body.row_values(state.bodies[b].d).head(body.num_interface_rows()));
  }
  point.lambda = Vector::Zero(model.num_constraint_rows());
  return point;
}

void set_static_state(const StaticPoint& point, const dynamics::Forces& forces,
                      const Compliances& compliances, model::State& state) {
  for (std::size_t b = 0; b < state.bodies.size(); ++b) {
    model::BodyState& s = state.bodies[b];
    for (Eigen::Vector3d* rate : {&s.frame.w, &s.frame.v, &s.w_dot, &s.v_dot, &s.w_alg, &s.v_alg}) {
      rate->setZero();
    }
    for (Vector* rate : {&s.d_dot, &s.d_ddot, &s.d_alg}) rate->setZero(s.d.size());
    s.frame.X_WB = point.poses[b];
    if (const ElasticCompliance* compliance = compliances.of_body[b]) {
      s.d = compliance->columns() * forces.interface[b];
    }
  }
  state.lambda = point.lambda;
  state.history = 0;
  state.lambda_time = state.t;
}

double largest_nodal_rotation(const body::Body& body, const Vector& d) {
  double largest = 0.0;
  if (!body.is_flexible()) return largest;
  const Vector nodal = body.flexible->nodal(d);
  for (const auto& node : body.flexible->mesh().dofs.node_dofs) {
    for (std::size_t k = 3; k < 6; ++k) {
      if (node[k] >= 0) largest = std::max(largest, std::abs(nodal[node[k]]));
    }
  }
  return largest;
}

double strongest_load(const model::Model& model, const StaticPoint& point, double t) {
  double largest = 0.0;
  const auto count = [&](const spatial::Wrench& wrench, double factor) {
    largest = std::max(
        {largest, factor * wrench.force.norm(), factor * wrench.torque.norm() / model.length});
  };
  std::vector<dynamics::BodyMotion> motions(model.bodies.size());
  for (std::size_t b = 0; b < motions.size(); ++b) {
    largest = std::max(largest, model.bodies[b].mass * model.gravity.norm());
    motions[b].frame.X_WB = point.poses[b];
    motions[b].y = motions[b].y_dot = Vector::Zero(model.bodies[b].num_rows());
    motions[b].y.head(point.y[b].size()) = point.y[b];
  }
  for (const model::Load& load : model.loads) {
    const auto first = dynamics::evaluate_marker(model, load.first, motions);
    const auto second = dynamics::evaluate_marker(model, load.second, motions);
    const loads::Action action = load.element->evaluate(t, first.motion, second.motion);
    const double factor = load.element->is_applied() ? std::abs(point.load_factor) : 1.0;
    largest = std::max(largest, factor * std::abs(action.along_pattern));
    count(action.on_first, factor);
    count(action.on_second, factor);
  }
  for (const model::Joint& joint : model.joints) {
    for (std::size_t k = 0; k < joint.rows.size(); ++k) {
      const double lambda = std::abs(point.lambda[joint.first_row + static_cast<int>(k)]);
      largest = std::max(largest, joint.rows[k].is_length() ? lambda : lambda / model.length);
    }
  }
  return largest;
}

}  // namespace buckens::analysis
