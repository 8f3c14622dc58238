// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/nastran/coordinates.h"

#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::mesh_io {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

bool same(const NastranGrid& a, const NastranGrid& b) {
  return a.cp == b.cp && a.cd == b.cd && a.x == b.x;
}

}  // namespace

NastranCoordinates::NastranCoordinates(const NastranBulk& bulk, NastranNotes& notes) {
  add_nodes(bulk, notes);
  add_systems(bulk, notes);
  for (std::size_t i = 0; i < systems_.size(); ++i) solve(systems_[i].id);
  positions_.reserve(grids_.size());
  for (std::size_t i = 0; i < grids_.size(); ++i) {
    positions_.push_back(node_position(static_cast<int>(i)));
    if (!positions_.back().allFinite()) {
      throw InputError(grids_[i].place.where(),
                       fmt::format("GRID {}: its coordinates are too large", grids_[i].id));
    }
    node_ids_.push_back(grids_[i].id);
    displacement_systems_.push_back(grids_[i].cd);
    system(grids_[i].cd, grids_[i].place);
    next_id_ = std::max(next_id_, grids_[i].id + 1);
  }
  grids_.clear();
}

void NastranCoordinates::add_nodes(const NastranBulk& bulk, NastranNotes& notes) {
  std::vector<std::int64_t> ids;
  ids.reserve(bulk.grids.size());
  for (const NastranGrid& grid : bulk.grids) ids.push_back(grid.id);
  const NastranIds all(ids);
  grids_.reserve(ids.size());
  for (std::size_t i = 0; i < bulk.grids.size(); ++i) {
    const NastranGrid& grid = bulk.grids[i];
    const NastranGrid& first = bulk.grids[static_cast<std::size_t>(all.find(grid.id))];
    if (&first != &grid) {
      if (!same(first, grid)) {
        throw InputError(grid.place.where(),
                         fmt::format("GRID {}: there is another node with this number in {}:{}",
                                     grid.id, first.place.file->name, first.place.line));
      }
      notes.add("GRID: repeated nodes with the same coordinates are taken once", grid.place);
      continue;
    }
    grids_.push_back(grid);
    if (grid.cp == NastranGrid::kBlank) grids_.back().cp = bulk.default_cp;
    if (grid.cd == NastranGrid::kBlank) grids_.back().cd = bulk.default_cd;
  }
  ids.clear();
  for (const NastranGrid& grid : grids_) ids.push_back(grid.id);
  nodes_ = NastranIds(ids);
}

void NastranCoordinates::add_systems(const NastranBulk& bulk, NastranNotes& notes) {
  const std::array<std::pair<char, Form>, 3> forms = {
      {{'R', Form::rectangular}, {'C', Form::cylindrical}, {'S', Form::spherical}}};
  for (const auto& [letter, form] : forms) {
    for (const NastranCard& card : bulk.cards_named(std::string("CORD1") + letter)) {
      // Two systems fit on one card.
      for (int first = 0; first < 8 && (first == 0 || !card.blank(first)); first += 4) {
        System system{};
        system.id = card.id(first);
        system.form = form;
        system.place = {card.file, card.line};
        for (int i = 0; i < 3; ++i) {
          const std::int64_t id = card.id(first + 1 + i);
          system.nodes[static_cast<std::size_t>(i)] = nodes_.find(id);
          if (nodes_.find(id) < 0) card.fail(first + 1 + i, fmt::format("there is no GRID {}", id));
        }
        add_system(system, notes);
      }
    }
    for (const NastranCard& card : bulk.cards_named(std::string("CORD2") + letter)) {
      System system{};
      system.id = card.id(0);
      system.form = form;
      system.base = card.integer(1, 0);
      system.place = {card.file, card.line};
      for (int i = 0; i < 9; ++i) {
        system.points[static_cast<std::size_t>(i / 3)][i % 3] = card.real(2 + i, 0.0);
      }
      add_system(system, notes);
    }
  }
}

void NastranCoordinates::add_system(const System& system, NastranNotes& notes) {
  const auto [entry, is_new] = system_of_.try_emplace(system.id, systems_.size());
  if (is_new) {
    systems_.push_back(system);
    return;
  }
  const System& first = systems_[entry->second];
  if (first.form != system.form || first.base != system.base || first.nodes != system.nodes ||
      first.points != system.points) {
    throw InputError(system.place.where(),
                     fmt::format("coordinate system {}: there is another one with this number in "
                                 "{}:{}",
                                 system.id, first.place.file->name, first.place.line));
  }
  notes.add("repeated identical coordinate systems are taken once", system.place);
}

const NastranCoordinates::System& NastranCoordinates::system(std::int64_t id,
                                                             const NastranPlace& place) const {
  static const System basic = [] {
    System out;
    out.solved = true;
    return out;
  }();
  if (id == 0) return basic;
  const auto entry = system_of_.find(id);
  if (entry != system_of_.end()) return systems_[entry->second];
  throw InputError(place.where(), fmt::format("there is no coordinate system {}", id));
}

std::vector<std::int64_t> NastranCoordinates::needs(const System& system) const {
  if (system.nodes[0] < 0) return {system.base};
  std::vector<std::int64_t> out;
  for (const int node : system.nodes) out.push_back(grids_[static_cast<std::size_t>(node)].cp);
  return out;
}

/// Chains may be long, hence no recursion.
void NastranCoordinates::solve(std::int64_t id) {
  std::vector<std::int64_t> open = {id};
  while (!open.empty()) {
    System& top = systems_[system_of_.at(open.back())];
    if (top.solved) {
      open.pop_back();
      continue;
    }
    const std::size_t depth = open.size();
    for (const std::int64_t need : needs(top)) {
      const System& other = system(need, top.place);
      if (other.solved) continue;
      if (other.visited || need == top.id) {
        throw InputError(top.place.where(),
                         fmt::format("coordinate system {}: it depends on itself by way of system "
                                     "{}",
                                     top.id, need));
      }
      open.push_back(need);
      break;
    }
    top.visited = true;
    if (open.size() > depth) continue;
    place_axes(top);
    top.solved = true;
    open.pop_back();
  }
}

void NastranCoordinates::place_axes(System& system_to_place) {
  System& s = system_to_place;
  std::array<Vector3d, 3> p;
  for (std::size_t i = 0; i < 3; ++i) {
    p[i] =
        s.nodes[0] < 0 ? point_of(system(s.base, s.place), s.points[i]) : node_position(s.nodes[i]);
  }
  const Vector3d z = p[1] - p[0];
  const Vector3d y = z.cross(p[2] - p[0]);
  // Sine of the angle between both: below this the direction of x is rounding.
  const double sine = y.norm() / (z.norm() * (p[2] - p[0]).norm());
  if (!(sine > 1e-9)) {
    throw InputError(s.place.where(),
                     fmt::format("coordinate system {}: its three points lie on one line", s.id));
  }
  s.origin = p[0];
  s.axes.col(2) = z.normalized();
  s.axes.col(1) = y.normalized();
  s.axes.col(0) = s.axes.col(1).cross(s.axes.col(2));
}

Vector3d NastranCoordinates::node_position(int grid) const {
  const NastranGrid& g = grids_[static_cast<std::size_t>(grid)];
  return point_of(system(g.cp, g.place), {g.x[0], g.x[1], g.x[2]});
}

Vector3d NastranCoordinates::point_of(const System& system, const Vector3d& point) {
  Vector3d local = point;
  const double r = point[0], a = point[1] * kDegree, b = point[2] * kDegree;
  if (system.form == Form::cylindrical) local << r * std::cos(a), r * std::sin(a), point[2];
  if (system.form == Form::spherical) {
    local << r * std::sin(a) * std::cos(b), r * std::sin(a) * std::sin(b), r * std::cos(a);
  }
  return system.origin + system.axes * local;
}

int NastranCoordinates::node(std::int64_t id, const std::string& user,
                             const NastranPlace& place) const {
  const int index = nodes_.find(id);
  if (index >= 0) return index;
  throw InputError(place.where(), fmt::format("{}: there is no GRID {}", user, id));
}

int NastranCoordinates::add_node(const Vector3d& position) {
  positions_.push_back(position);
  node_ids_.push_back(next_id_++);
  displacement_systems_.push_back(0);
  return static_cast<int>(positions_.size()) - 1;
}

Matrix3d NastranCoordinates::axes_at(std::int64_t id, const Vector3d& point,
                                     const NastranPlace& place) const {
  const System& s = system(id, place);
  if (s.form == Form::rectangular) return s.axes;
  const Vector3d local = s.axes.transpose() * (point - s.origin);
  const double around = std::atan2(local.y(), local.x());
  const Matrix3d turned = Eigen::AngleAxisd(around, Vector3d::UnitZ()).toRotationMatrix();
  if (s.form == Form::cylindrical) return s.axes * turned;
  const double down = std::atan2(local.head<2>().norm(), local.z());
  Matrix3d spherical;
  spherical.col(0) = turned * Vector3d(std::sin(down), 0, std::cos(down));
  spherical.col(1) = turned * Vector3d(std::cos(down), 0, -std::sin(down));
  spherical.col(2) = turned.col(1);
  return s.axes * spherical;
}

Vector3d NastranCoordinates::to_basic(std::int64_t id, const Vector3d& point,
                                      const NastranPlace& place) const {
  return point_of(system(id, place), point);
}

bool NastranCoordinates::is_rectangular(std::int64_t id, const NastranPlace& place) const {
  return system(id, place).form == Form::rectangular;
}

Matrix3d NastranCoordinates::displacement_axes(int node) const {
  const auto i = static_cast<std::size_t>(node);
  return axes_at(displacement_systems_[i], positions_[i], {});
}

}  // namespace buckens::mesh_io
