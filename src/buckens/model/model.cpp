// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/model.h"

#include <algorithm>

#include "buckens/model/contact_group.h"
#include "buckens/model/state.h"

namespace buckens::model {

int Model::num_constraint_rows() const {
  return joints.empty() ? 0 : joints.back().first_row + static_cast<int>(joints.back().rows.size());
}

int Model::num_law_states() const {
  int sum = 0;
  for (const Load& load : loads) sum += load.element->num_states();
  return sum;
}

int Model::num_rigid_rows() const {
  return static_cast<int>(std::count_if(loads.begin(), loads.end(),
                                        [](const Load& load) { return load.rigid_row >= 0; }));
}

const Load& Model::load_of_rigid_row(int row) const {
  return *std::find_if(loads.begin(), loads.end(),
                       [&](const Load& load) { return load.rigid_row == row; });
}

bool Model::may_have_rigid_rows() const {
  return num_rigid_rows() > 0 ||
         std::any_of(contact_groups.begin(), contact_groups.end(),
                     [](const auto& group) { return group->rigid.has_value(); });
}

int Model::num_row_states() const {
  int sum = 0;
  for (const Joint& joint : joints) {
    for (const joints::ConstraintRow& row : joint.rows) sum += row.num_states();
  }
  return sum;
}

std::pair<const Joint*, int> Model::owner_of_row(int row) const {
  const auto next = std::upper_bound(joints.begin(), joints.end(), row,
                                     [](int r, const Joint& j) { return r < j.first_row; });
  const Joint* joint = &*(next - 1);
  return {joint, row - joint->first_row};
}

int Model::find_body(const std::string& name) const {
  const auto found = std::find_if(bodies.begin(), bodies.end(),
                                  [&](const body::Body& b) { return b.name == name; });
  return found == bodies.end() ? kGround : static_cast<int>(found - bodies.begin());
}

int Model::find_whole(const std::string& name) const {
  const auto found = std::find_if(wholes.begin(), wholes.end(),
                                  [&](const WholeBody& w) { return w.name == name; });
  return found == wholes.end() ? -1 : static_cast<int>(found - wholes.begin());
}

int Model::whole_of(int body) const {
  const auto next = std::upper_bound(wholes.begin(), wholes.end(), body,
                                     [](int b, const WholeBody& w) { return b < w.first; });
  return static_cast<int>(next - wholes.begin()) - 1;
}

State placed_state(const Model& model) {
  State state;
  state.bodies.resize(model.bodies.size());
  for (std::size_t k = 0; k < model.bodies.size(); ++k) {
    BodyState& body = state.bodies[k];
    body.frame.X_WB = model.placed[k];
    const Eigen::Index n = model.bodies[k].num_dofs();
    body.d = body.d_dot = body.d_ddot = body.d_alg = linalg::Vector::Zero(n);
    if (model.bodies[k].is_flexible()) body.terms = model.bodies[k].flexible->coupling.terms;
  }
  state.lambda = linalg::Vector::Zero(model.num_constraint_rows());
  state.memory.coordinates.resize(model.coordinates.size());
  state.memory.laws = linalg::Vector::Zero(model.num_law_states());
  state.memory.rows = linalg::Vector::Zero(model.num_row_states());
  return state;
}

}  // namespace buckens::model
