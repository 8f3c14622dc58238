// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/nastran/points.h"

#include <unordered_map>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/mesh_io/nastran/scalar_elements.h"
#include "buckens/mesh_io/skip_list.h"
#include "buckens/spatial/principal_axes.h"

namespace buckens::mesh_io {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

int node_of(const NastranCard& card, int field, const NastranCoordinates& coordinates) {
  const int index = coordinates.find_node(card.id(field));
  if (index < 0) card.fail(field, fmt::format("there is no GRID {}", card.id(field)));
  return index;
}

Vector3d vector_at(const NastranCard& card, int first) {
  return {card.real(first, 0.0), card.real(first + 1, 0.0), card.real(first + 2, 0.0)};
}

void add_mass(const NastranCard& card, const NastranBulk& bulk,
              const NastranCoordinates& coordinates, fem::ImportedMesh& mesh) {
  const NastranPlace place{card.file, card.line};
  card.id(0);
  fem::ImportedMass out;
  out.node = node_of(card, 1, coordinates);
  out.mass = card.real(3, 0.0) * bulk.weight_to_mass;
  if (out.mass < 0) {
    card.fail(
        3, fmt::format("the mass {:g} is negative{}", card.real(3), SkipList::remedy(card.name)));
  }
  const Vector3d& position = coordinates.positions()[static_cast<std::size_t>(out.node)];
  const std::int64_t system = card.integer(2, 0);
  if (system < -1) card.fail(2, "there are no such coordinate systems");
  Matrix3d axes = Matrix3d::Identity();
  const Vector3d offset = vector_at(card, 4);
  if (system == -1) {
    // The place of the mass is given in the basic system.
    out.offset = offset - position;
  } else {
    axes = coordinates.axes_at(system, position, place);
    out.offset = axes * offset;
  }
  // I11, I21, I22, I31, I32, I33: products of inertia have the minus sign in the matrix.
  Matrix3d inertia;
  inertia(0, 0) = card.real(8, 0.0);
  inertia(1, 0) = inertia(0, 1) = -card.real(9, 0.0);
  inertia(1, 1) = card.real(10, 0.0);
  inertia(2, 0) = inertia(0, 2) = -card.real(11, 0.0);
  inertia(2, 1) = inertia(1, 2) = -card.real(12, 0.0);
  inertia(2, 2) = card.real(13, 0.0);
  const Vector3d principal = spatial::principal_values(inertia);
  // Eight digits of a small field.
  if (!(principal[0] >= -1e-7 * principal.cwiseAbs().maxCoeff())) {
    card.fail(8,
              fmt::format("a principal moment of inertia, {:g}, is negative, which no body has{}",
                          principal[0], SkipList::remedy(card.name)));
  }
  out.inertia = bulk.weight_to_mass * axes * inertia * axes.transpose();
  mesh.masses.push_back(out);
}

/// K1 to K6 of a PBUSH.
std::array<double, 6> read_stiffness(const NastranCard& card, NastranNotes& notes) {
  std::array<double, 6> out = {0, 0, 0, 0, 0, 0};
  for (int field = 1; field < card.size(); field += 8) {
    const std::string word = card.word(field);
    if (word == "K") {
      for (int i = 0; i < 6; ++i) {
        double& value = out[static_cast<std::size_t>(i)];
        value = card.real(field + 1 + i, 0.0);
        if (value < 0)
          card.fail(field + 1 + i, fmt::format("the stiffness {:g} is negative", value));
      }
    } else if (!word.empty()) {
      notes.add(fmt::format("PBUSH: {} is left out; springs have stiffness only", word),
                {card.file, card.line});
    }
  }
  return out;
}

class SpringBuilder {
 public:
  SpringBuilder(const NastranBulk& bulk, NastranCoordinates& coordinates, NastranNotes& notes,
                fem::ImportedMesh& mesh)
      : coordinates_(coordinates), notes_(notes), mesh_(mesh) {
    for (const NastranCard& card : bulk.cards_named("PBUSH1D")) {
      axial_stiffnesses_.try_emplace(card.id(0), card.real(1, 0.0));
      notes.add("PBUSH1D: only K is used; damping, mass and tables are left out",
                {card.file, card.line});
    }
    for (const NastranCard& card : bulk.cards_named("PBUSH")) {
      if (!properties_.try_emplace(card.id(0), &card).second) {
        card.fail("there is another PBUSH with this number");
      }
    }
  }

  void add(const NastranCard& card);
  void add_axial(const NastranCard& card);

 private:
  Matrix3d axes_of(const NastranCard& card, const std::array<int, 2>& nodes,
                   const Vector3d& place) const;
  Vector3d place_of(const NastranCard& card, const std::array<int, 2>& nodes) const;
  int tie(int node, const Vector3d& place, const NastranCard& card);
  const Vector3d& position(int node) const {
    return coordinates_.positions()[static_cast<std::size_t>(node)];
  }

  NastranCoordinates& coordinates_;
  NastranNotes& notes_;
  fem::ImportedMesh& mesh_;
  std::unordered_map<std::int64_t, const NastranCard*> properties_;
  std::unordered_map<std::int64_t, double> axial_stiffnesses_;  // PBUSH1D
};

/// Axes of the spring: of CID, or x along the nodes and y near the orientation vector.
Matrix3d SpringBuilder::axes_of(const NastranCard& card, const std::array<int, 2>& nodes,
                                const Vector3d& place) const {
  const NastranPlace where{card.file, card.line};
  if (!card.blank(7)) {
    const std::int64_t system = card.integer(7);
    if (system < 0) card.fail(7, "there are no such coordinate systems");
    return coordinates_.axes_at(system, place, where);
  }
  const Vector3d along = position(nodes[1]) - position(nodes[0]);
  if (!(along.norm() > 0)) card.fail(7, "is blank; coincident nodes need a coordinate system CID");
  Vector3d v = Vector3d::Zero();
  if (!card.blank(4) && card.is_integer(4) && card.blank(5) && card.blank(6)) {
    v = position(node_of(card, 4, coordinates_)) - position(nodes[0]);
  } else if (!card.blank(4) || !card.blank(5) || !card.blank(6)) {
    v = coordinates_.displacement_axes(nodes[0]) * vector_at(card, 4);
  } else {
    // Only K1 and K4 may then be given: y does not matter.
    v = along.normalized().unitOrthogonal();
  }
  Matrix3d axes;
  axes.col(0) = along.normalized();
  const Vector3d z = axes.col(0).cross(v);
  if (!(z.norm() > 1e-6 * v.norm()))
    card.fail(4, "the orientation vector is parallel to the spring");
  axes.col(2) = z.normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

/// S along the line of the nodes (half by default), or S1, S2, S3 in the system OCID.
Vector3d SpringBuilder::place_of(const NastranCard& card, const std::array<int, 2>& nodes) const {
  const std::int64_t system = card.integer(9, -1);
  if (system >= 0) {
    return coordinates_.to_basic(system, vector_at(card, 10), {card.file, card.line});
  }
  const double s = card.real(8, 0.5);
  return (1.0 - s) * position(nodes[0]) + s * position(nodes[1]);
}

int SpringBuilder::tie(int node, const Vector3d& place, const NastranCard& card) {
  const int added = coordinates_.add_node(place);
  fem::ImportedRigidLink link;
  link.name = fmt::format("{} at node {}", card.label(),
                          coordinates_.node_ids()[static_cast<std::size_t>(node)]);
  link.reference = node;
  link.nodes = {added};
  link.line = card.line;
  mesh_.rigid_links.push_back(std::move(link));
  notes_.add("CBUSH: springs offset from their nodes get additional nodes on rigid links",
             {card.file, card.line});
  return added;
}

void SpringBuilder::add(const NastranCard& card) {
  const std::int64_t id = card.id(0);
  const std::int64_t property = card.id(1, id);
  std::array<int, 2> nodes = {node_of(card, 2, coordinates_), -1};
  if (card.blank(3) || card.text(3) == "0") {
    notes_.add("CBUSH: those to ground (GB blank) are left out; use a bushing of the model file",
               {card.file, card.line});
    return;
  }
  nodes[1] = node_of(card, 3, coordinates_);
  if (nodes[0] == nodes[1]) card.fail(3, "both ends are one node");
  const auto entry = properties_.find(property);
  if (entry == properties_.end()) card.fail(1, fmt::format("there is no PBUSH {}", property));
  const std::array<double, 6> k = read_stiffness(*entry->second, notes_);
  const Vector3d along = position(nodes[1]) - position(nodes[0]);
  const Vector3d place = place_of(card, nodes);
  const Matrix3d axes = axes_of(card, nodes, place);
  const bool is_free = card.blank(7) && card.blank(4) && card.blank(5) && card.blank(6);
  if (is_free && (k[1] != 0 || k[2] != 0 || k[4] != 0 || k[5] != 0)) {
    card.fail("K2, K3, K5 and K6 need an orientation: give G0, X1 to X3 or CID");
  }
  fem::ImportedSpring spring;
  const auto set = [&](int first) {
    const auto i = static_cast<std::size_t>(first);
    const Vector3d diagonal(k[i], k[i + 1], k[i + 2]);
    spring.stiffness.block<3, 3>(first, first) = axes * diagonal.asDiagonal() * axes.transpose();
  };
  set(0);
  set(3);
  // Forces along the line of the nodes, and moments, do not turn the nodes.
  const Vector3d across = spring.stiffness.topLeftCorner<3, 3>().colwise().norm();
  const bool is_axial =
      k[1] == 0 && k[2] == 0 && along.cross(axes.col(0)).norm() <= 1e-9 * along.norm() &&
      (place - position(nodes[0])).cross(axes.col(0)).norm() <= 1e-9 * along.norm();
  if (!is_axial && across.norm() > 0) {
    for (int& node : nodes) {
      if ((place - position(node)).norm() > 1e-9 * position(node).norm()) {
        node = tie(node, place, card);
      }
    }
  }
  spring.nodes = nodes;
  mesh_.springs.push_back(spring);
}

/// CBUSH1D: a spring along the line of its nodes, or along x of CID for nodes on that line.
void SpringBuilder::add_axial(const NastranCard& card) {
  const std::int64_t property = card.id(1, card.id(0));
  const std::array<int, 2> nodes = {
      node_of(card, 2, coordinates_),
      card.blank(3) || card.text(3) == "0" ? -1 : node_of(card, 3, coordinates_)};
  if (nodes[1] < 0) {
    notes_.add("CBUSH1D: those to ground (GB blank) are left out; use a spring of the model file",
               {card.file, card.line});
    return;
  }
  const auto entry = axial_stiffnesses_.find(property);
  if (entry == axial_stiffnesses_.end()) {
    card.fail(1, fmt::format("there is no PBUSH1D {}", property));
  }
  if (entry->second < 0) card.fail(fmt::format("the stiffness {:g} is negative", entry->second));
  const Vector3d between = position(nodes[1]) - position(nodes[0]);
  Vector3d along = between.normalized();
  if (!card.blank(4)) {
    const std::int64_t system = card.integer(4);
    if (system < 0) card.fail(4, "there are no such coordinate systems");
    along = coordinates_.axes_at(system, position(nodes[0]), {card.file, card.line}).col(0);
    if (between.cross(along).norm() > 1e-6 * between.norm()) {
      card.fail(4,
                "the x axis of CID is perpendicular to the line between the nodes; use CBUSH with "
                "K1 only");
    }
  } else if (!(between.norm() > 0)) {
    card.fail(4, "is blank; coincident nodes need a coordinate system CID");
  }
  fem::ImportedSpring spring;
  spring.nodes = nodes;
  spring.stiffness.topLeftCorner<3, 3>() = entry->second * along * along.transpose();
  mesh_.springs.push_back(spring);
}

}  // namespace

void add_nastran_points(const NastranBulk& bulk, NastranCoordinates& coordinates,
                        NastranNotes& notes, fem::ImportedMesh& mesh) {
  for (const NastranCard& card : bulk.cards_named("CONM2")) {
    add_mass(card, bulk, coordinates, mesh);
  }
  for (const NastranCard& card : bulk.cards_named("CONM1")) {
    add_nastran_mass_matrix(card, bulk, coordinates, mesh);
  }
  add_nastran_scalar_elements(bulk, coordinates, notes, mesh);
  SpringBuilder springs(bulk, coordinates, notes, mesh);
  for (const NastranCard& card : bulk.cards_named("CBUSH")) springs.add(card);
  for (const NastranCard& card : bulk.cards_named("CBUSH1D")) springs.add_axial(card);
}

}  // namespace buckens::mesh_io
