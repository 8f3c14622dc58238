// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/statics/state.h"

#include <algorithm>
#include <cmath>

#include "buckens/analysis/statics/tolerances.h"
#include "buckens/dynamics/contact_groups.h"
#include "buckens/dynamics/model_scales.h"
#include "buckens/dynamics/signals.h"
#include "buckens/dynamics/travel.h"

namespace buckens::analysis {

using linalg::Vector;

Compliances::Compliances(const model::Model& model) {
  for (const body::Body& body : model.bodies) {
    if (body.is_flexible()) owned.push_back(std::make_unique<ElasticCompliance>(body));
    of_body.push_back(body.is_flexible() ? owned.back().get() : nullptr);
  }
}

StaticPoint static_point(const model::Model& model, const RestRows& rest,
                         const model::State& state) {
  StaticPoint point;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const body::Body& body = model.bodies[b];
    point.poses.push_back(state.bodies[b].frame.X_WB);
    point.y.push_back(body.row_values(state.bodies[b].d).head(body.num_interface_rows()));
  }
  point.lambda = Vector::Zero(model.num_constraint_rows());
  RestValues values;
  rest.evaluate(motions_at(model, point), state.t, values);
  point.rest = rest.start(values);
  point.order = rest.order();
  return point;
}

void set_static_state(const StaticPoint& point, const RestRows& rest, const StaticBalance& balance,
                      const Compliances& compliances, model::State& state) {
  for (std::size_t b = 0; b < state.bodies.size(); ++b) {
    model::BodyState& s = state.bodies[b];
    for (Eigen::Vector3d* rate : {&s.frame.w, &s.frame.v, &s.w_dot, &s.v_dot, &s.w_alg, &s.v_alg}) {
      rate->setZero();
    }
    s.d_dot = s.d_ddot = s.d_alg = Vector::Zero(s.d.size());
    s.frame.X_WB = point.poses[b];
    if (const ElasticCompliance* compliance = compliances.of_body[b]) {
      s.d = compliance->columns() * balance.forces.interface[b];
    }
  }
  state.lambda = point.lambda;
  state.memory.at_rest = rest.of_loads(balance.rest, point.rest);
  dynamics::start_near(rest.model(), dynamics::motions_of(rest.model(), state), state.memory);
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

double closed_share(const model::Model& model, const StaticPoint& point) {
  return std::max(kClosed,
                  kPositionRounding * dynamics::rounding_length(model, point.poses) / model.length);
}

double spring_rounding(const model::Model& model,
                       const std::vector<dynamics::BodyMotion>& motions) {
  dynamics::SoftRows soft;
  dynamics::evaluate_soft_rows(model, motions, soft);
  const double length = dynamics::rounding_length(model, motions);
  double out = 0.0;
  for (std::size_t k = 0; k < soft.rows.size(); ++k) {
    bool is_displacement = false;
    for (const dynamics::BodyRow* part : soft.rows[k].parts()) {
      if (part->body == model::kGround) continue;
      is_displacement = is_displacement || part->frame.tail<3>().cwiseAbs().maxCoeff() > 0.0;
    }
    // Angles are known to rounding wherever the model is; torques count divided by its length.
    out =
        std::max(out, 1e-15 * soft.stiffness[k] * (is_displacement ? length : 1.0 / model.length));
  }
  return out;
}

double strongest_load(const model::Model& model, const RestRows& rest, const StaticPoint& point,
                      double t) {
  double largest = rest.strongest(point.rest);
  const auto count = [&](const spatial::Wrench& wrench, double factor) {
    largest = std::max(
        {largest, factor * wrench.force.norm(), factor * wrench.torque.norm() / model.length});
  };
  const std::vector<dynamics::BodyMotion> motions = motions_at(model, point);
  for (const body::Body& body : model.bodies) {
    largest = std::max(largest, body.mass * model.gravity.norm());
  }
  dynamics::SignalValues signals;
  const dynamics::Circumstances around = dynamics::with_signals(model, motions, t, {}, signals);
  for (std::size_t k = 0; k < model.loads.size(); ++k) {
    const model::Load& load = model.loads[k];
    const dynamics::LoadEnds ends = dynamics::ends_of(model, load, motions, nullptr);
    const loads::Action action = dynamics::action_of(model, k, t, around, ends);
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
