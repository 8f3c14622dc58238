// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/nastran/rigid_elements.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "buckens/mesh_io/nastran/hinges.h"
#include "buckens/mesh_io/nastran/scattered_leads.h"

namespace buckens::mesh_io {

namespace {

using Variables = NastranVariables;

constexpr Variables kAll = {true, true, true, true, true, true};

int count_of(const Variables& v) { return static_cast<int>(std::count(v.begin(), v.end(), true)); }

/// A node of a rigid body: which of its components lead, which follow.
struct Member {
  int node = 0;
  Variables leads{}, follows{};
};

class RigidBuilder {
 public:
  RigidBuilder(const NastranCoordinates& coordinates, NastranNotes& notes, fem::ImportedMesh& mesh)
      : coordinates_(coordinates), notes_(notes), mesh_(mesh) {}

  void add_rbe2(const NastranCard& card);
  void add_rbe1(const NastranCard& card);
  void add_rigid(const NastranCard& card, int num_nodes);
  void add_crigd1(const NastranCard& card);
  void add_crigd2(const NastranCard& card);
  void add_rrod(const NastranCard& card);
  void drop_idle();

 private:
  int node(const NastranCard& card, int field) const {
    return nastran_node(card, field, coordinates_);
  }
  void check_axes(const NastranCard& card, const Variables& variables, int node) const {
    check_nastran_axes(card, variables, node, coordinates_);
  }
  void add_body(const NastranCard& card, std::vector<Member> members);
  void add_led_body(const NastranCard& card, const std::vector<Member>& members);
  void add_link(const NastranCard& card, int reference, int follower, const Variables& variables);
  bool tie_in_own_axes(const NastranCard& card, int reference, int follower,
                       const Variables& variables);

  const NastranCoordinates& coordinates_;
  NastranNotes& notes_;
  fem::ImportedMesh& mesh_;
  std::vector<std::size_t> led_;  // equations of bodies that several nodes lead
  std::optional<NastranPlace> led_at_;
};

/// Single components in turned axes are equations, which only nodes at one place need no arm for.
bool RigidBuilder::tie_in_own_axes(const NastranCard& card, int reference, int follower,
                                   const Variables& variables) {
  const bool is_whole_link = (is_whole(variables, 0) || is_without(variables, 0)) &&
                             (is_whole(variables, 3) || is_without(variables, 3));
  const auto place = [&](int node) {
    return coordinates_.positions()[static_cast<std::size_t>(node)];
  };
  if (is_whole_link || coordinates_.displacement_system(follower) == 0) return false;
  if ((place(follower) - place(reference)).norm() > 1e-9 * place(follower).norm()) return false;
  Variables released;
  for (std::size_t i = 0; i < 6; ++i) released[i] = !variables[i];
  tie_nastran_nodes(reference, follower, coordinates_.displacement_axes(follower), released,
                    card.label(), card.line, mesh_);
  return true;
}

void RigidBuilder::add_link(const NastranCard& card, int reference, int follower,
                            const Variables& variables) {
  if (tie_in_own_axes(card, reference, follower, variables)) return;
  check_axes(card, variables, follower);
  fem::ImportedRigidLink link;
  link.name = card.label();
  link.line = card.line;
  link.reference = reference;
  link.nodes = {follower};
  link.variables = variables;
  mesh_.rigid_links.push_back(std::move(link));
}

void RigidBuilder::add_rbe2(const NastranCard& card) {
  fem::ImportedRigidLink link;
  link.name = card.label();
  link.line = card.line;
  card.id(0);
  link.reference = node(card, 1);
  if (card.blank(2)) card.fail(2, "is blank; give the components CM");
  link.variables = read_nastran_variables(card, 2);
  std::set<int> seen = {link.reference};
  for (int field = 3; field < card.size(); ++field) {
    if (card.blank(field)) continue;
    if (!card.is_integer(field) && field + 1 == card.size()) {
      card.real(field);
      notes_.add("RBE2: thermal expansion ALPHA is left out", {card.file, card.line});
      break;
    }
    const int follower = node(card, field);
    if (!seen.insert(follower).second) {
      card.fail(field, fmt::format("node {} appears there twice", card.id(field)));
    }
    if (tie_in_own_axes(card, link.reference, follower, link.variables)) continue;
    check_axes(card, link.variables, follower);
    link.nodes.push_back(follower);
  }
  if (seen.size() == 1) card.fail("there are no dependent nodes");
  if (!link.nodes.empty()) mesh_.rigid_links.push_back(std::move(link));
}

/// Six leading components place a rigid body, whichever they are: the motion is the same as if
/// those of one node led.
void RigidBuilder::add_body(const NastranCard& card, std::vector<Member> members) {
  int num_leading = 0;
  bool says_followers = false;
  for (const Member& member : members) {
    num_leading += count_of(member.leads);
    says_followers = says_followers || count_of(member.follows) > 0;
  }
  if (num_leading != 6) {
    card.fail(fmt::format("{} components are independent; there must be six in all", num_leading));
  }
  // A node whose components all lead comes first, else one that is rigid in all of them.
  const auto is_complete = [&](const Member& member) {
    for (std::size_t i = 0; i < 6; ++i) {
      if (!member.leads[i] && !member.follows[i] && says_followers) return false;
    }
    return true;
  };
  auto first = std::find_if(members.begin(), members.end(),
                            [](const Member& member) { return member.leads == kAll; });
  if (first == members.end()) {
    for (const Member& member : members) {
      if (!is_complete(member) && count_of(member.leads) > 0) return add_led_body(card, members);
    }
    first = std::find_if(members.begin(), members.end(), is_complete);
    if (first == members.end()) card.fail("no node follows the rigid body in all components");
  }
  std::iter_swap(first, members.begin());
  for (std::size_t k = 1; k < members.size(); ++k) {
    Variables variables = members[k].follows;
    for (std::size_t i = 0; i < 6; ++i) variables[i] = variables[i] || members[k].leads[i];
    if (!says_followers) variables = kAll;
    if (count_of(variables) > 0) add_link(card, members[0].node, members[k].node, variables);
  }
}

/// Leading components of nodes that are free in others.
void RigidBuilder::add_led_body(const NastranCard& card, const std::vector<Member>& members) {
  std::vector<NodeComponent> leads, followers;
  for (const Member& member : members) {
    const Eigen::Matrix3d axes = coordinates_.displacement_axes(member.node);
    // A node whose components all follow does so in any axes.
    const bool follows_whole = is_whole(member.follows, 0) && is_whole(member.follows, 3);
    if (!follows_whole && count_of(member.follows) > 0) {
      check_axes(card, member.follows, member.node);
    }
    for (std::size_t i = 0; i < 6; ++i) {
      const auto k = static_cast<Eigen::Index>(i % 3);
      if (member.leads[i]) leads.push_back({member.node, i > 2, axes.col(k)});
      if (member.follows[i]) {
        followers.push_back({member.node, i > 2, Eigen::Vector3d::Unit(k)});
      }
    }
  }
  const std::size_t first = mesh_.equations.size();
  if (!add_led_components(leads, followers, coordinates_.positions(), card.line, mesh_)) {
    card.fail("the six independent components do not hold the rigid body in place");
  }
  for (std::size_t k = first; k < mesh_.equations.size(); ++k) led_.push_back(k);
  if (!led_at_) led_at_ = {card.file, card.line};
}

/// To be called once all links are there.
void RigidBuilder::drop_idle() {
  const int count = drop_idle_rotations(led_, mesh_);
  for (int k = 0; k < count; ++k) {
    notes_.add("rotations of rigid elements are left out at nodes where nothing turns", *led_at_);
  }
}

/// RBAR and RTRPLT: nodes, their independent components, their dependent ones, which blank or zero
/// stands for all others.
void RigidBuilder::add_rigid(const NastranCard& card, int num_nodes) {
  card.id(0);
  std::vector<Member> members;
  // RTRPLT has its dependent components on the second line.
  const int followers = num_nodes == 2 ? 5 : 8;
  const auto read = [&card](int field) {
    return card.text(field) == "0" ? Variables{} : read_nastran_variables(card, field);
  };
  for (int i = 0; i < num_nodes; ++i) {
    Member member;
    member.node = node(card, 1 + i);
    for (const Member& other : members) {
      if (other.node == member.node) card.fail(1 + i, "two of the nodes are one");
    }
    member.leads = read(1 + num_nodes + i);
    member.follows = read(followers + i);
    members.push_back(member);
  }
  add_body(card, std::move(members));
}

/// Pairs of node and components: the independent ones, UM, the dependent ones. CRIGD3 of NASTRAN-95
/// has MSET in place of UM.
void RigidBuilder::add_rbe1(const NastranCard& card) {
  card.id(0);
  std::vector<Member> members;
  bool leads = true;
  for (int field = 1; field < card.size(); ++field) {
    if (card.blank(field)) continue;
    if (card.word(field) == "UM" || card.word(field) == "MSET") {
      leads = false;
      continue;
    }
    if (!card.is_integer(field) || card.blank(field + 1)) {
      card.real(field);
      notes_.add("RBE1: thermal expansion ALPHA is left out", {card.file, card.line});
      break;
    }
    const int place = node(card, field);
    auto member = std::find_if(members.begin(), members.end(),
                               [place](const Member& other) { return other.node == place; });
    if (member == members.end()) member = members.insert(members.end(), Member{place, {}, {}});
    (leads ? member->leads : member->follows) = read_nastran_variables(card, field + 1);
    ++field;
  }
  if (leads) card.fail("there are no dependent components (UM)");
  add_body(card, std::move(members));
}

/// NASTRAN-95: one node leads, the others, perhaps "THRU", follow.
void RigidBuilder::add_crigd1(const NastranCard& card) {
  card.id(0);
  const int reference = node(card, 1);
  for (int field = 2; field < card.size(); ++field) {
    if (card.blank(field)) continue;
    if (card.word(field) != "THRU") {
      add_link(card, reference, node(card, field), kAll);
      continue;
    }
    const std::int64_t last = card.id(field + 1);
    for (std::int64_t id = card.id(field - 1) + 1; id <= last; ++id) {
      if (id - card.id(field - 1) > 1000000) card.fail(field, "the range is too long");
      const int follower = coordinates_.find_node(id);
      if (follower >= 0) add_link(card, reference, follower, kAll);
    }
    ++field;
  }
}

void RigidBuilder::add_crigd2(const NastranCard& card) {
  card.id(0);
  const int reference = node(card, 1);
  for (int field = 2; field + 1 < card.size(); field += 2) {
    if (card.blank(field)) continue;
    add_link(card, reference, node(card, field), read_nastran_variables(card, field + 1));
  }
}

/// The distance of two nodes does not change: what they move along their line is equal. CRIGDR of
/// NASTRAN-95 names the component that follows; which it is makes no difference.
void RigidBuilder::add_rrod(const NastranCard& card) {
  card.id(0);
  const std::array<int, 2> ends = {node(card, 1), node(card, 2)};
  const auto place = [&](std::size_t end) {
    return coordinates_.positions()[static_cast<std::size_t>(ends[end])];
  };
  const Eigen::Vector3d along = place(1) - place(0);
  if (!(along.norm() > 0)) card.fail(2, "both ends are at one place");
  const std::size_t follower = card.name == "CRIGDR" || card.blank(3) ? 1 : 0;
  const Eigen::Vector3d direction = along.normalized();
  int largest = 0;
  direction.cwiseAbs().maxCoeff(&largest);
  fem::ImportedEquation equation;
  equation.line = card.line;
  equation.terms.push_back({ends[follower], largest, direction[largest]});
  for (const std::size_t end : {follower, 1 - follower}) {
    for (int i = 0; i < 3; ++i) {
      if (direction[i] == 0.0 || (end == follower && i == largest)) continue;
      equation.terms.push_back({ends[end], i, end == follower ? direction[i] : -direction[i]});
    }
  }
  mesh_.equations.push_back(std::move(equation));
}

}  // namespace

NastranVariables read_nastran_variables(const NastranCard& card, int field) {
  Variables out{};
  for (const char c : card.text(field)) {
    if (c < '1' || c > '6') {
      card.fail(field, fmt::format("\"{}\" must hold the digits 1 to 6 only", card.text(field)));
    }
    out[static_cast<std::size_t>(c - '1')] = true;
  }
  return out;
}

int nastran_node(const NastranCard& card, int field, const NastranCoordinates& coordinates) {
  const int index = coordinates.find_node(card.id(field));
  if (index < 0) card.fail(field, fmt::format("there is no GRID {}", card.id(field)));
  return index;
}

void check_nastran_axes(const NastranCard& card, const NastranVariables& variables, int node,
                        const NastranCoordinates& coordinates) {
  const bool whole = (is_whole(variables, 0) || is_without(variables, 0)) &&
                     (is_whole(variables, 3) || is_without(variables, 3));
  if (whole || coordinates.displacement_system(node) == 0) return;
  card.fail(
      fmt::format("single components at GRID {}, whose displacements are in system {}, are "
                  "not supported; tie all three translations or use the basic system",
                  coordinates.node_ids()[static_cast<std::size_t>(node)],
                  coordinates.displacement_system(node)));
}

void add_nastran_rigid_elements(const NastranBulk& bulk, const NastranCoordinates& coordinates,
                                NastranNotes& notes, fem::ImportedMesh& mesh) {
  RigidBuilder builder(coordinates, notes, mesh);
  for (const NastranCard& card : bulk.cards_named("RBE2")) builder.add_rbe2(card);
  for (const NastranCard& card : bulk.cards_named("RBAR")) builder.add_rigid(card, 2);
  for (const NastranCard& card : bulk.cards_named("RTRPLT")) builder.add_rigid(card, 3);
  for (const NastranCard& card : bulk.cards_named("RBE1")) builder.add_rbe1(card);
  for (const NastranCard& card : bulk.cards_named("CRIGD3")) builder.add_rbe1(card);
  for (const NastranCard& card : bulk.cards_named("CRIGD1")) builder.add_crigd1(card);
  for (const NastranCard& card : bulk.cards_named("CRIGD2")) builder.add_crigd2(card);
  for (const NastranCard& card : bulk.cards_named("RROD")) builder.add_rrod(card);
  for (const NastranCard& card : bulk.cards_named("CRIGDR")) builder.add_rrod(card);
  builder.drop_idle();
}

}  // namespace buckens::mesh_io
