// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/body_fields.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>

#include "buckens/fem/element/block.h"
#include "buckens/fem/solid/recovery.h"
#include "buckens/model/state.h"
#include "buckens/results/field_quantity_note.h"
#include "buckens/results/model_geometry.h"

namespace buckens::results {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using fem::TensorColumns;
using model::FieldQuantity;

namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();
// Values of fewer are formed before a thread wakes.
constexpr std::size_t kManyPlaces = 1000;

/// Adds room at the end.
double* room_for(std::size_t count, std::vector<double>& values) {
  values.resize(values.size() + count);
  return values.data() + values.size() - count;
}

Matrix3d tensor(const Eigen::Ref<const Eigen::Matrix<double, 6, 1>>& s, double shear) {
  Matrix3d out;
  out << s[0], shear * s[3], shear * s[5],  //
      shear * s[3], s[1], shear * s[4],     //
      shear * s[5], shear * s[4], s[2];
  return out;
}

/// Turns tensors into other axes. @param shear 1 for stresses, ½ for strains with doubled shear
void rotate(const Matrix3d& R, double shear, Eigen::Ref<TensorColumns> columns) {
  for (Index k = 0; k < columns.cols(); ++k) {
    const Matrix3d T = R * tensor(columns.col(k), shear) * R.transpose();
    columns.col(k) << T(0, 0), T(1, 1), T(2, 2), T(0, 1) / shear, T(1, 2) / shear, T(0, 2) / shear;
  }
}

}  // namespace

BodyFields::BodyFields(const model::Model& model, const model::FieldPlaces& places,
                       const model::FieldOutputSpec& spec, TaskPool* pool)
    : model_(model), pool_(pool), whole_(places.whole) {
  const model::WholeBody& whole = model.wholes[static_cast<std::size_t>(whole_)];
  const fem::FeModel& mesh = *mesh_of(model, whole);
  const int num_solids = volume_elements(mesh);
  choose_quantities(spec, num_solids > 0, fem::num_solids(mesh) > num_solids);
  std::vector<bool> wanted(mesh.nodes.size(), places.is_everywhere && !at_nodes_.empty());
  if (!at_nodes_.empty()) {
    for (const int node : places.nodes) wanted[static_cast<std::size_t>(node)] = true;
  }
  if (!at_elements_.empty()) {
    elements_ = places.solids;
    std::erase_if(elements_, [num_solids](int e) { return e >= num_solids; });
    if (places.is_everywhere) {
      elements_.resize(static_cast<std::size_t>(num_solids));
      std::iota(elements_.begin(), elements_.end(), 0);
    }
  }
  // Places of loads need not be places of the mesh.
  if (std::find(wanted.begin(), wanted.end(), true) == wanted.end()) at_nodes_.clear();
  if (elements_.empty()) at_elements_.clear();
  has_stresses_ = has_tensors(at_nodes_) || has_tensors(at_elements_);
  has_extremes_ = has_stresses_ && spec.extremes != model::ExtremeRate::off;
  is_element_.assign(elements_.size(), true);
  if (is_empty()) return;
  for (int b = whole.first; b < whole.first + whole.count; ++b) add_part(b, wanted);
}

void BodyFields::evaluate_stresses(const model::State& state) {
  const model::WholeBody& whole = model_.wholes[static_cast<std::size_t>(whole_)];
  node_strain_.resize(6, static_cast<Index>(nodes_.size()));
  node_stress_.resize(6, static_cast<Index>(nodes_.size()));
  element_strain_.resize(6, static_cast<Index>(elements_.size()));
  element_stress_.resize(6, static_cast<Index>(elements_.size()));
  shell_mises_.assign(nodes_.size(), 0.0);
  const Eigen::Quaterniond to_whole = whole_motion(model_, whole, state).X_WB.q.conjugate();
  TensorColumns at_nodes, at_elements;
  for (const PartFields& part : parts_) {
    if (!part.strains) continue;
    const auto b = static_cast<std::size_t>(part.body);
    const model::BodyState& s = state.bodies[b];
    const body::FlexiblePart& flexible = *model_.bodies[b].flexible;
    TaskPool* pool = flexible.if_worth(pool_);
    part.evaluate(flexible, s.d, at_nodes, at_elements, pool);
    TensorColumns node_stress, element_stress;
    part.strains->stresses(at_nodes, at_elements, node_stress, element_stress, pool);
    if (part.shells) add_shells(part, s.d, at_nodes, node_stress);
    if (whole.is_divided()) {
      const Matrix3d R = (to_whole * s.frame.X_WB.q).toRotationMatrix();
      rotate(R, 0.5, at_nodes);
      rotate(R, 1.0, node_stress);
      rotate(R, 0.5, at_elements);
      rotate(R, 1.0, element_stress);
    }
    node_strain_.middleCols(part.first_place, part.num_places()) = at_nodes;
    node_stress_.middleCols(part.first_place, part.num_places()) = node_stress;
    for (Index e = 0; e < part.num_elements(); ++e) {
      const Index row = part.element_rows[static_cast<std::size_t>(e)];
      element_strain_.col(row) = at_elements.col(e);
      element_stress_.col(row) = element_stress.col(e);
    }
  }
}

void BodyFields::add_shells(const PartFields& part, const linalg::Vector& d, TensorColumns& strain,
                            TensorColumns& stress) {
  const body::Body& body = model_.bodies[static_cast<std::size_t>(part.body)];
  const auto surface = part.evaluate_shells(*body.flexible, d);
  strain.conservativeResize(6, part.num_places());
  stress.conservativeResize(6, part.num_places());
  for (std::size_t k = 0; k < part.shell_columns.size(); ++k) {
    const Index place = part.shell_columns[k], column = static_cast<Index>(k);
    strain.col(place) = surface.strain.col(column);
    stress.col(place) = surface.stress.col(column);
    shell_mises_[static_cast<std::size_t>(part.first_place + place)] = surface.mises[column];
  }
}

void BodyFields::append_motion(const model::State& state, FieldQuantity quantity,
                               std::vector<double>& values) const {
  const model::WholeBody& whole = model_.wholes[static_cast<std::size_t>(whole_)];
  const spatial::Pose X = whole_motion(model_, whole, state).X_WB;
  for (const PartFields& part : parts_) {
    const auto b = static_cast<std::size_t>(part.body);
    const body::Body& body = model_.bodies[b];
    const model::BodyState& s = state.bodies[b];
    const Matrix3d R = s.frame.X_WB.R();
    const Vector3d& w = s.frame.w;
    const Eigen::Matrix3Xd u = part.translations(*body.flexible, s.d);
    Eigen::Matrix3Xd u_dot, u_ddot;
    if (quantity != FieldQuantity::displacement) {
      u_dot = part.translations(*body.flexible, s.d_dot);
    }
    if (quantity == FieldQuantity::acceleration) {
      u_ddot = part.translations(*body.flexible, s.d_ddot);
    }
    const auto value_at = [&](Index p) {
      const auto node = static_cast<std::size_t>(part.nodes[static_cast<std::size_t>(p)]);
      const Vector3d& at = body.flexible->mesh().nodes[node].position;
      const Vector3d z = at - body.com + u.col(p);
      Vector3d value;
      if (quantity == FieldQuantity::displacement) {
        value = u.col(p);
        if (whole.is_divided()) {
          value = X.q.conjugate() * (s.frame.X_WB * z - X.p) - (at - whole.com);
        }
      } else if (quantity == FieldQuantity::velocity) {
        value = s.frame.v + R * (w.cross(z) + u_dot.col(p));
      } else {
        value = s.v_dot + R * (s.w_dot.cross(z) + w.cross(w.cross(z)) +
                               2.0 * w.cross(u_dot.col(p)) + u_ddot.col(p));
      }
      return value;
    };
    double* next = room_for(3 * part.nodes.size(), values);
    run_ranges(body.flexible->if_worth(pool_), static_cast<int>(part.num_places()),
               [&](Index begin, Index end) {
                 for (Index p = begin; p < end; ++p) Vector3d::Map(next + 3 * p) = value_at(p);
               });
  }
}

double BodyFields::mises_at(const TensorColumns& stress, Index column) const {
  const double own = fem::mises_stress(stress.col(column));
  return &stress == &node_stress_ ? std::max(own, shell_mises_[static_cast<std::size_t>(column)])
                                  : own;
}

void BodyFields::append_tensors(FieldQuantity quantity, const TensorColumns& strain,
                                const TensorColumns& stress, const std::vector<bool>& known,
                                std::vector<double>& values) const {
  const std::size_t components = std::max<std::size_t>(1, note_of(quantity).components.size());
  double* first = room_for(components * known.size(), values);
  const auto put = [&](Index p, double* to) {
    if (!known[static_cast<std::size_t>(p)]) {
      std::fill_n(to, components, kNoValue);
      return;
    }
    switch (quantity) {
      case FieldQuantity::stress:
        std::copy_n(stress.col(p).data(), 6, to);
        break;
      case FieldQuantity::strain:
        std::copy_n(strain.col(p).data(), 6, to);
        break;
      case FieldQuantity::von_mises:
        *to = mises_at(stress, p);
        break;
      case FieldQuantity::principal_stress:
        Vector3d::Map(to) = fem::principal_stresses(stress.col(p));
        break;
      default:
        *to = 0.5 * stress.col(p).dot(strain.col(p));
    }
  };
  TaskPool* pool = known.size() >= kManyPlaces ? pool_ : nullptr;
  run_ranges(pool, static_cast<int>(known.size()), [&](Index begin, Index end) {
    for (Index p = begin; p < end; ++p) put(p, first + components * static_cast<std::size_t>(p));
  });
}

void BodyFields::append(const model::State& state, std::vector<double>& values) const {
  for (const FieldQuantity quantity : at_nodes_) {
    if (is_motion(quantity)) {
      append_motion(state, quantity, values);
    } else {
      append_tensors(quantity, node_strain_, node_stress_, has_stress_, values);
    }
  }
  for (const FieldQuantity quantity : at_elements_) {
    append_tensors(quantity, element_strain_, element_stress_, is_element_, values);
  }
}

void BodyFields::update_extremes(double t) {
  if (!has_extremes_) return;
  const auto update = [t, this](const TensorColumns& stress, const std::vector<bool>& known,
                                std::vector<double>& largest, std::vector<double>& times) {
    const bool is_first = largest.empty();
    largest.resize(known.size(), kNoValue);
    times.resize(known.size(), kNoValue);
    for (std::size_t p = 0; p < known.size(); ++p) {
      if (!known[p]) continue;
      const double now = mises_at(stress, static_cast<Index>(p));
      if (!is_first && !(now > largest[p])) continue;
      largest[p] = now;
      times[p] = t;
    }
  };
  update(node_stress_, has_stress_, largest_.nodes, largest_.node_times);
  update(element_stress_, is_element_, largest_.elements, largest_.element_times);
}

void BodyFields::append_extremes(std::vector<double>& values) const {
  if (!has_extremes_) return;
  const auto append = [&values](const std::vector<FieldQuantity>& quantities,
                                const std::vector<double>& largest,
                                const std::vector<double>& times) {
    if (!has_tensors(quantities)) return;
    values.insert(values.end(), largest.begin(), largest.end());
    values.insert(values.end(), times.begin(), times.end());
  };
  append(at_nodes_, largest_.nodes, largest_.node_times);
  append(at_elements_, largest_.elements, largest_.element_times);
}

void BodyFields::visit_saved(const base::SaveVisit& visit) {
  visit.list_or_none("nodes", largest_.nodes, has_stress_.size());
  visit.list_or_none("node_times", largest_.node_times, largest_.nodes.size());
  visit.list_or_none("elements", largest_.elements, is_element_.size());
  visit.list_or_none("element_times", largest_.element_times, largest_.elements.size());
}

}  // namespace buckens::results
