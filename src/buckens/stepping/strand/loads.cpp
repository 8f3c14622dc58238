// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/strand/loads.h"

#include <algorithm>

namespace buckens::stepping {

using strand::BodyRows;
using strand::entry;
using strand::MeshRows;
using strand::Plane;
using strand::Space;

bool StrandLoads::suits(const model::Load& load) {
  const loads::ForceElement& element = *load.element;
  return element.num_soft_rows() == 0 && element.num_states() == 0 && !element.uses_signals() &&
         load.coordinate < 0 && load.joint < 0 && load.rigid_row < 0 && load.pattern_row < 0 &&
         load.others.empty() && load.shapes.get() == nullptr;
}

StrandLoads::StrandLoads(const model::Model& model, StrandMechanism& mechanism)
    : model_(model), mechanism_(mechanism) {
  std::vector<char> has_load(model.bodies.size(), 0);
  for (const model::Load& load : model.loads) {
    for (const model::MarkerId* id : {&load.first, &load.second}) {
      if (id->body == model::kGround) continue;
      const auto b = static_cast<std::size_t>(id->body);
      has_load[b] = 1;
      if (!mechanism.body(b).has_mesh) continue;
      // The iteration ends when the rows of its marker are at rest, too.
      const body::Body& body = model.bodies[b];
      const int node =
          StrandMechanism::node_of(body, body.markers[static_cast<std::size_t>(id->marker)]);
      for (int k = 0; k < strand::kSlots; ++k) {
        if (node < 0 || node == k) mechanism.watch_node(b, k);
      }
    }
  }
  for (std::size_t k = 0; k < mechanism.body_blocks().size(); ++k) {
    const std::vector<std::size_t>& members = mechanism.members(k);
    strand::BodyBlock& block = mechanism.body_blocks()[k];
    block.has_given = std::any_of(members.begin(), members.end(),
                                  [&](std::size_t b) { return has_load[b] != 0; });
    if (block.has_given) bodies_.insert(bodies_.end(), members.begin(), members.end());
  }
  if (empty()) return;
  motions_.resize(model.bodies.size());
  forces_.reset(model);
}

template <class S>
void StrandLoads::read_motion(const model::State& start, std::size_t b) {
  using Row = MeshRows<S>;
  double* const at = mechanism_.body(b).at;
  dynamics::BodyMotion& out = motions_[b];
  const auto number = [&](int row) { return entry(at, row); };
  if constexpr (S::T == 2) {
    out.frame.X_WB.q = Eigen::Quaterniond(number(Row::qe), 0.0, 0.0, number(Row::qe + 1));
    out.frame.X_WB.p = {number(Row::pe), number(Row::pe + 1), start.bodies[b].frame.X_WB.p.z()};
    out.frame.w = {0.0, 0.0, number(Row::we)};
    out.frame.v = {number(Row::ve), number(Row::ve + 1), 0.0};
  } else {
    const int q = Row::qe;
    out.frame.X_WB.q = Eigen::Quaterniond(number(q), number(q + 1), number(q + 2), number(q + 3));
    for (int k = 0; k < 3; ++k) {
      out.frame.X_WB.p[k] = number(Row::pe + k);
      out.frame.w[k] = number(Row::we + k);
      out.frame.v[k] = number(Row::ve + k);
    }
  }
  if (!mechanism_.body(b).has_mesh) return;
  const auto& rows = model_.bodies[b].flexible->rows;
  const std::vector<int>& order = mechanism_.order(b);
  const double rate = mechanism_.constants().s1;
  values_.resize(std::ssize(order));
  const auto fill = [&](auto value) {
    for (std::size_t i = 0; i < order.size(); ++i) {
      values_[static_cast<Eigen::Index>(i)] = value(order[i]);
    }
  };
  fill([&](int k) { return number(Row::end + k) + number(Row::dc + k); });
  out.y.noalias() = rows * values_;
  // As with the frame's, corrections of positions are none of rates.
  fill([&](int k) {
    return rate * (number(Row::end + k) - number(Row::d + k)) + number(Row::dv + k);
  });
  out.y_dot.noalias() = rows * values_;
}

template <class S>
void StrandLoads::write_loads(std::size_t b) {
  using Row = MeshRows<S>;
  double* const at = mechanism_.body(b).at;
  const Eigen::Matrix<double, 6, 1>& frame = forces_.frame[b];
  if constexpr (S::T == 2) {
    entry(at, Row::given) = frame[2];
    for (int k = 0; k < 2; ++k) entry(at, Row::given + 1 + k) = frame[3 + k];
  } else {
    for (int k = 0; k < 6; ++k) entry(at, Row::given + k) = frame[k];
  }
  if (!mechanism_.body(b).has_mesh) return;
  const body::FlexiblePart& part = *model_.bodies[b].flexible;
  values_.noalias() = part.rows.topRows(part.num_interface_rows).transpose() * forces_.interface[b];
  const std::vector<int>& order = mechanism_.order(b);
  for (std::size_t i = 0; i < order.size(); ++i) {
    entry(at, Row::given_nodes + order[i]) = values_[static_cast<Eigen::Index>(i)];
  }
}

template <class S>
void StrandLoads::evaluate_in(const model::State& start, double t) {
  for (const std::size_t b : bodies_) read_motion<S>(start, b);
  dynamics::Circumstances around;
  around.inputs = &start.inputs;
  around.memory = &start.memory;
  dynamics::evaluate_forces(model_, motions_, t, around, forces_);
  for (const std::size_t b : bodies_) write_loads<S>(b);
}

void StrandLoads::evaluate(const model::State& start, double t) {
  if (empty()) return;
  mechanism_.is_planar() ? evaluate_in<Plane>(start, t) : evaluate_in<Space>(start, t);
}

}  // namespace buckens::stepping
