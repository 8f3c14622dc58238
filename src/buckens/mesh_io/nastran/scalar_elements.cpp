// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/nastran/scalar_elements.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <set>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/mesh_io/skip_list.h"
#include "buckens/spatial/principal_axes.h"

namespace buckens::mesh_io {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

/// Digits of a small field: what differs by less is rounding of the deck.
constexpr double kRounding = 1e-6;

/// One variable that a scalar element takes hold of.
struct Terminal {
  int node = -1;           ///< −1: a scalar point, or the ground
  int component = 0;       ///< 0 to 5 in the displacement system of the node
  std::int64_t point = 0;  ///< number of the scalar point; 0 with node −1: the ground

  bool is_ground() const { return node < 0 && point == 0; }
  bool is_point() const { return node < 0 && point != 0; }
  auto operator<=>(const Terminal&) const = default;  // NOLINT(modernize-use-nullptr)
};

[[noreturn]] void refuse(const NastranCard& card, const std::string& text) {
  card.fail(text + SkipList::remedy(card.name));
}

class ScalarBuilder {
 public:
  ScalarBuilder(const NastranBulk& bulk, NastranCoordinates& coordinates, NastranNotes& notes,
                fem::ImportedMesh& mesh);

  void add_spring(const NastranCard& card);
  void add_mass(const NastranCard& card);
  void finish();

 private:
  using Edges = std::map<Terminal, double>;

  std::int64_t read_point(const NastranCard& card, int field) const;
  std::array<Terminal, 2> read_ends(const NastranCard& card) const;
  double read_property(const NastranCard& card, const char* type,
                       const std::map<std::int64_t, double>& values) const;
  void connect(const Terminal& a, const Terminal& b, double k);
  void eliminate_points();
  void add_between(const Terminal& a, const Terminal& b, double k, const NastranCard& card);
  void add_masses();
  int arm(int node, const Vector3d& place, const NastranCard& card);
  const Vector3d& position(int node) const {
    return coordinates_.positions()[static_cast<std::size_t>(node)];
  }
  Vector3d direction(const Terminal& end) const {
    return coordinates_.displacement_axes(end.node).col(end.component % 3);
  }

  const NastranBulk& bulk_;
  NastranCoordinates& coordinates_;
  NastranNotes& notes_;
  fem::ImportedMesh& mesh_;
  std::map<std::int64_t, double> stiffnesses_, mass_values_;  // PELAS, PMASS
  std::set<std::int64_t> points_;
  std::map<Terminal, Edges> graph_;  // both ways
  std::map<Terminal, const NastranCard*> first_cards_;
  std::map<int, std::array<double, 6>> masses_;  // by node and component
  std::map<int, const NastranCard*> mass_cards_;
};

ScalarBuilder::ScalarBuilder(const NastranBulk& bulk, NastranCoordinates& coordinates,
                             NastranNotes& notes, fem::ImportedMesh& mesh)
    : bulk_(bulk), coordinates_(coordinates), notes_(notes), mesh_(mesh) {
  // Two properties of springs fit on one card, four of masses.
  for (const NastranCard& card : bulk.cards_named("PELAS")) {
    for (int first = 0; first < 8 && !card.blank(first); first += 4) {
      stiffnesses_.emplace(card.id(first), card.real(first + 1, 0.0));
    }
  }
  for (const NastranCard& card : bulk.cards_named("PMASS")) {
    for (int first = 0; first < 8 && !card.blank(first); first += 2) {
      mass_values_.emplace(card.id(first), card.real(first + 1, 0.0));
    }
  }
  for (const NastranCard& card : bulk.cards_named("SPOINT")) {
    for (int field = 0; field < card.size(); ++field) {
      if (card.blank(field)) continue;
      if (card.word(field) != "THRU") {
        points_.insert(card.id(field));
        continue;
      }
      const std::int64_t last = card.id(field + 1);
      constexpr std::int64_t kMost = 10000000;
      const std::int64_t first = card.id(field - 1);
      if (last - first > kMost) card.fail(field, "the range is too long");
      for (std::int64_t id = first; id <= last; ++id) points_.insert(id);
      ++field;
    }
  }
}

/// A scalar point, 0 for the ground. Those of CELAS3, CELAS4, CMASS3 and CMASS4 need no SPOINT.
std::int64_t ScalarBuilder::read_point(const NastranCard& card, int field) const {
  if (card.blank(field) || card.text(field) == "0") return 0;
  return card.id(field);
}

std::array<Terminal, 2> ScalarBuilder::read_ends(const NastranCard& card) const {
  std::array<Terminal, 2> out;
  const char variant = card.name.back();
  if (variant == '3' || variant == '4') {
    for (std::size_t i = 0; i < 2; ++i) out[i].point = read_point(card, 2 + static_cast<int>(i));
    return out;
  }
  for (std::size_t i = 0; i < 2; ++i) {
    const int field = 2 + 2 * static_cast<int>(i);
    const std::int64_t id = read_point(card, field);
    const std::int64_t component = card.integer(field + 1, 0);
    if (id == 0) continue;
    const int node = coordinates_.find_node(id);
    if (node < 0 && points_.contains(id)) {
      out[i].point = id;
      continue;
    }
    if (node < 0) card.fail(field, fmt::format("there is no GRID {}", id));
    if (component < 1 || component > 6) {
      card.fail(field + 1, fmt::format("component {} of a GRID must be 1 to 6", component));
    }
    out[i].node = node;
    out[i].component = static_cast<int>(component) - 1;
  }
  return out;
}

double ScalarBuilder::read_property(const NastranCard& card, const char* type,
                                    const std::map<std::int64_t, double>& values) const {
  const char variant = card.name.back();
  if (variant == '2' || variant == '4') return card.real(1, 0.0);
  const std::int64_t id = card.id(1, card.id(0));
  const auto entry = values.find(id);
  if (entry == values.end()) card.fail(1, fmt::format("there is no {} {}", type, id));
  return entry->second;
}

void ScalarBuilder::connect(const Terminal& a, const Terminal& b, double k) {
  if (a == b || k == 0.0) return;
  graph_[a][b] += k;
  graph_[b][a] += k;
}

void ScalarBuilder::add_spring(const NastranCard& card) {
  card.id(0);
  const double k = read_property(card, "PELAS", stiffnesses_);
  if (k < 0) card.fail(fmt::format("the stiffness {:g} is negative", k));
  const std::array<Terminal, 2> ends = read_ends(card);
  for (const Terminal& end : ends) first_cards_.try_emplace(end, &card);
  if ((ends[0].is_ground() && ends[1].node >= 0) || (ends[1].is_ground() && ends[0].node >= 0)) {
    notes_.add(card.name +
                   ": those to ground are left out; use a spring or bushing of the model "
                   "file",
               {card.file, card.line}, true);
  }
  connect(ends[0], ends[1], k);
}

/// Massless points are in equilibrium between their springs: each is replaced by springs between
/// all its neighbours, k_a k_b / Σk.
void ScalarBuilder::eliminate_points() {
  constexpr std::size_t kMostNeighbours = 100;
  for (auto at = graph_.begin(); at != graph_.end(); at = graph_.begin()) {
    at = std::find_if(graph_.begin(), graph_.end(),
                      [](const auto& entry) { return entry.first.is_point(); });
    if (at == graph_.end()) return;
    const Terminal point = at->first;
    const Edges edges = at->second;
    if (edges.size() > kMostNeighbours) {
      refuse(*first_cards_.at(point), fmt::format("more than {} springs meet at scalar point {}",
                                                  kMostNeighbours, point.point));
    }
    graph_.erase(at);
    double sum = 0;
    for (const auto& [other, k] : edges) {
      sum += k;
      graph_[other].erase(point);
    }
    for (auto a = edges.begin(); a != edges.end(); ++a) {
      for (auto b = std::next(a); b != edges.end(); ++b) {
        connect(a->first, b->first, a->second * b->second / sum);
      }
    }
  }
}

int ScalarBuilder::arm(int node, const Vector3d& place, const NastranCard& card) {
  const int added = coordinates_.add_node(place);
  fem::ImportedRigidLink link;
  link.name = fmt::format("{} at node {}", card.label(),
                          coordinates_.node_ids()[static_cast<std::size_t>(node)]);
  link.reference = node;
  link.nodes = {added};
  link.line = card.line;
  mesh_.rigid_links.push_back(std::move(link));
  notes_.add(card.name +
                 ": between nodes off its line it is placed midway, with rigid arms, so that it "
                 "exerts no moment on the body as a whole",
             {card.file, card.line});
  return added;
}

void ScalarBuilder::add_between(const Terminal& a, const Terminal& b, double k,
                                const NastranCard& card) {
  const Vector3d along = direction(a);
  const bool is_turning = a.component >= 3;
  if (is_turning != (b.component >= 3) || (direction(b) - along).norm() > kRounding) {
    refuse(card,
           fmt::format(
               "a spring between component {} of GRID {} and component {} of GRID {} would exert a "
               "net force on the body; inside a body both must have the same direction",
               a.component + 1, coordinates_.node_ids()[static_cast<std::size_t>(a.node)],
               b.component + 1, coordinates_.node_ids()[static_cast<std::size_t>(b.node)]));
  }
  fem::ImportedSpring spring;
  spring.nodes = {a.node, b.node};
  const int first = is_turning ? 3 : 0;
  spring.stiffness.block<3, 3>(first, first) = k * along * along.transpose();
  const Vector3d between = position(b.node) - position(a.node);
  const double beside = between.cross(along).norm();
  if (!is_turning && beside > kRounding * (between.norm() + 1e-3 * position(a.node).norm())) {
    const Vector3d place = 0.5 * (position(a.node) + position(b.node));
    for (int& node : spring.nodes) node = arm(node, place, card);
  }
  mesh_.springs.push_back(spring);
}

void ScalarBuilder::add_mass(const NastranCard& card) {
  card.id(0);
  const double m = read_property(card, "PMASS", mass_values_) * bulk_.weight_to_mass;
  if (m < 0) refuse(card, fmt::format("the mass {:g} is negative", m));
  if (m == 0.0) return;
  const std::array<Terminal, 2> ends = read_ends(card);
  for (const Terminal& end : ends) {
    if (!end.is_point()) continue;
    refuse(card,
           fmt::format(
               "scalar point {} has a mass but no position in space; use a GRID with CONM2 instead",
               end.point));
  }
  if (ends[0].node >= 0 && ends[1].node >= 0) {
    refuse(card, "masses that couple two components are not supported");
  }
  const Terminal& end = ends[0].node >= 0 ? ends[0] : ends[1];
  if (end.is_ground()) return;
  masses_.try_emplace(end.node, std::array<double, 6>{})
      .first->second[static_cast<std::size_t>(end.component)] += m;
  mass_cards_.try_emplace(end.node, &card);
}

void ScalarBuilder::add_masses() {
  for (const auto& [node, m] : masses_) {
    const NastranCard& card = *mass_cards_.at(node);
    const double least = std::min({m[0], m[1], m[2]}), most = std::max({m[0], m[1], m[2]});
    if (most - least > kRounding * most) {
      refuse(card, fmt::format("the masses at GRID {} in its three directions are {:g}, {:g} and "
                               "{:g}; a body has the same mass in all directions: use CONM2",
                               coordinates_.node_ids()[static_cast<std::size_t>(node)], m[0], m[1],
                               m[2]));
    }
    fem::ImportedMass out;
    out.node = node;
    out.mass = most;
    const Matrix3d axes = coordinates_.displacement_axes(node);
    out.inertia = axes * Vector3d(m[3], m[4], m[5]).asDiagonal() * axes.transpose();
    mesh_.masses.push_back(out);
    notes_.add("CMASS: masses at a node become point masses", {card.file, card.line});
  }
}

void ScalarBuilder::finish() {
  eliminate_points();
  for (const auto& [a, edges] : graph_) {
    if (a.is_ground()) continue;
    for (const auto& [b, k] : edges) {
      if (!(a < b) || b.is_ground()) continue;
      const auto own = first_cards_.find(a);
      add_between(a, b, k, *own->second);
    }
  }
  add_masses();
  if (!points_.empty()) {
    const NastranCard& card = bulk_.cards_named("SPOINT").front();
    notes_.add("SPOINT: scalar points are eliminated, or left out where no spring holds them",
               {card.file, card.line});
  }
}

}  // namespace

void add_nastran_scalar_elements(const NastranBulk& bulk, NastranCoordinates& coordinates,
                                 NastranNotes& notes, fem::ImportedMesh& mesh) {
  ScalarBuilder builder(bulk, coordinates, notes, mesh);
  std::deque<NastranCard> second_halves;  // the builder keeps their addresses
  const auto visit = [&](const std::string& name, void (ScalarBuilder::*add)(const NastranCard&)) {
    for (const NastranCard& card : bulk.cards_named(name)) {
      (builder.*add)(card);
      const bool may_have_two = name.back() == '3' || name.back() == '4';
      if (may_have_two && !card.blank(4)) {
        (builder.*add)(second_halves.emplace_back(card.second_half()));
      }
    }
  };
  for (const char* name : {"CELAS1", "CELAS2", "CELAS3", "CELAS4"}) {
    visit(name, &ScalarBuilder::add_spring);
  }
  for (const char* name : {"CMASS1", "CMASS2", "CMASS3", "CMASS4"}) {
    visit(name, &ScalarBuilder::add_mass);
  }
  builder.finish();
}

void add_nastran_mass_matrix(const NastranCard& card, const NastranBulk& bulk,
                             const NastranCoordinates& coordinates, fem::ImportedMesh& mesh) {
  const NastranPlace place{card.file, card.line};
  card.id(0);
  fem::ImportedMass out;
  out.node = coordinates.find_node(card.id(1));
  if (out.node < 0) card.fail(1, fmt::format("there is no GRID {}", card.id(1)));
  Eigen::Matrix<double, 6, 6> M;
  int field = 3;
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column <= row; ++column) {
      M(row, column) = M(column, row) = card.real(field++, 0.0) * bulk.weight_to_mass;
    }
  }
  const double m = M(0, 0);
  const double size = M.diagonal().tail<3>().cwiseAbs().maxCoeff();
  const double length = m > 0 ? std::sqrt(size / m) : 0.0;
  // With the centre at r: m v² / 2 + m v·(ω × r) + ω·Jω / 2.
  const Matrix3d lower = M.bottomLeftCorner<3, 3>();
  const Vector3d moment(0.5 * (lower(2, 1) - lower(1, 2)), 0.5 * (lower(0, 2) - lower(2, 0)),
                        0.5 * (lower(1, 0) - lower(0, 1)));
  Matrix3d skew;
  skew << 0, -moment.z(), moment.y(), moment.z(), 0, -moment.x(), -moment.y(), moment.x(), 0;
  const double off_mass = (M.topLeftCorner<3, 3>() - m * Matrix3d::Identity()).norm();
  if (m < 0 || off_mass > kRounding * std::max(m, M.topLeftCorner<3, 3>().norm()) ||
      (lower - skew).norm() > kRounding * (lower.norm() + m * length)) {
    refuse(card,
           "its matrix is not that of a rigid body: masses in the three directions differ, or "
           "couple; use CONM2");
  }
  Vector3d offset = Vector3d::Zero();
  Matrix3d inertia = M.bottomRightCorner<3, 3>();
  if (m > 0) {
    offset = moment / m;
    inertia -= m * (offset.squaredNorm() * Matrix3d::Identity() - offset * offset.transpose());
  }
  const Vector3d principal = spatial::principal_values(inertia);
  if (principal[0] < -kRounding * size) {
    refuse(card, fmt::format("a principal moment of inertia, {:g}, is negative", principal[0]));
  }
  const std::int64_t system = card.integer(2, 0);
  if (system < 0) card.fail(2, "there are no such coordinate systems");
  const Matrix3d axes = coordinates.axes_at(
      system, coordinates.positions()[static_cast<std::size_t>(out.node)], place);
  out.mass = m;
  out.offset = axes * offset;
  out.inertia = axes * inertia * axes.transpose();
  mesh.masses.push_back(out);
}

}  // namespace buckens::mesh_io
