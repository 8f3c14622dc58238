// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/nastran/connections.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "buckens/mesh_io/nastran/rigid_elements.h"

namespace buckens::mesh_io {

namespace {

using Variables = NastranVariables;

class ConnectionBuilder {
 public:
  ConnectionBuilder(const NastranCoordinates& coordinates, NastranNotes& notes,
                    fem::ImportedMesh& mesh)
      : coordinates_(coordinates), notes_(notes), mesh_(mesh) {}

  void add_rbe3(const NastranCard& card);
  void add_mpc(const NastranCard& card);

 private:
  int node(const NastranCard& card, int field) const {
    return nastran_node(card, field, coordinates_);
  }
  void check_axes(const NastranCard& card, const Variables& variables, int node) const {
    check_nastran_axes(card, variables, node, coordinates_);
  }
  std::array<bool, 3> read_weight(const NastranCard& card, int field, double& weight);

  const NastranCoordinates& coordinates_;
  NastranNotes& notes_;
  fem::ImportedMesh& mesh_;
};

/// A weight and the components that it holds for. @return how each of the three displacements
/// counts
std::array<bool, 3> ConnectionBuilder::read_weight(const NastranCard& card, int field,
                                                   double& weight) {
  weight = card.real(field);
  if (!(weight > 0)) card.fail(field, fmt::format("the weight {:g} must be positive", weight));
  const Variables used = read_nastran_variables(card, field + 1);
  if (is_without(used, 0)) {
    card.fail(field + 1,
              "no displacement component (1, 2, 3) of the nodes is used; averages of rotations "
              "alone are not supported");
  }
  if (!is_without(used, 3)) {
    notes_.add("RBE3: rotations of the nodes do not take part in the mean", {card.file, card.line});
  }
  return {used[0], used[1], used[2]};
}

void ConnectionBuilder::add_rbe3(const NastranCard& card) {
  const NastranPlace place{card.file, card.line};
  fem::ImportedAverage average;
  average.name = card.label();
  average.line = card.line;
  card.id(0);
  average.reference = node(card, 2);
  if (card.blank(3)) card.fail(3, "is blank; give the components REFC that follow");
  average.variables = read_nastran_variables(card, 3);
  check_axes(card, average.variables, average.reference);
  double weight = 0;
  std::array<bool, 3> used = {true, true, true};
  for (int field = 4; field < card.size(); ++field) {
    if (card.blank(field)) continue;
    if (card.is_word(field)) {
      // UM chooses other variables to eliminate, which changes nothing.
      if (card.word(field) != "UM" && card.word(field) != "ALPHA") {
        card.fail(field, fmt::format("expected a node, found {}", card.word(field)));
      }
      if (card.word(field) == "ALPHA") notes_.add("RBE3: ALPHA is left out", place);
      break;
    }
    if (!card.is_integer(field)) {
      used = read_weight(card, field++, weight);
      continue;
    }
    if (weight == 0) card.fail(field, "a weight, with a decimal point, must come first");
    const int member = node(card, field);
    if (member == average.reference) card.fail(field, "the reference node is among the others");
    check_axes(card, {used[0], used[1], used[2], false, false, false}, member);
    average.nodes.push_back(member);
    average.weights.push_back(weight);
    average.components.push_back(used);
  }
  if (average.nodes.empty()) card.fail("there are no nodes to take the mean of");
  const std::array<bool, 3> all = {true, true, true};
  if (std::all_of(average.components.begin(), average.components.end(),
                  [&](const auto& own) { return own == all; })) {
    average.components.clear();
  }
  mesh_.averages.push_back(std::move(average));
}

void ConnectionBuilder::add_mpc(const NastranCard& card) {
  fem::ImportedEquation equation;
  equation.line = card.line;
  // Terms stand in fields 3 to 8 of each line, two to a line.
  for (int field = 1; field < card.size(); field += field % 8 == 1 ? 3 : 5) {
    if (card.blank(field) && card.blank(field + 2)) continue;
    const int place = node(card, field);
    const std::int64_t component = card.integer(field + 1, 0);
    if (component < 1 || component > 6) {
      card.fail(field + 1, fmt::format("component {} must be 1 to 6", component));
    }
    const double factor = card.real(field + 2);
    const Eigen::Matrix3d axes = coordinates_.displacement_axes(place);
    const int first = component > 3 ? 3 : 0;
    const Eigen::Vector3d direction = axes.col(static_cast<int>(component) - 1 - first);
    const bool is_basic = coordinates_.displacement_system(place) == 0;
    const auto begin = equation.terms.size();
    for (int i = 0; i < 3; ++i) {
      const double coefficient = factor * direction[i];
      if (coefficient == 0.0 || (!is_basic && std::abs(direction[i]) < 1e-14)) continue;
      equation.terms.push_back({place, first + i, coefficient});
    }
    // The first term is the one to eliminate: of a turned one the largest part.
    if (begin != 0) continue;
    if (equation.terms.empty()) card.fail(field + 2, "the coefficient of the first term is zero");
    for (auto& term : equation.terms) {
      if (std::abs(term.coefficient) > std::abs(equation.terms[0].coefficient)) {
        std::swap(term, equation.terms[0]);
      }
    }
  }
  if (equation.terms.empty()) card.fail("the equation has no terms");
  mesh_.equations.push_back(std::move(equation));
}

/// Which sets of MPC hold.
std::set<std::int64_t> chosen_sets(const NastranBulk& bulk, bool has_control,
                                   const std::optional<std::int64_t>& mpc_set,
                                   NastranNotes& notes) {
  std::set<std::int64_t> out;
  const std::vector<NastranCard>& sums = bulk.cards_named("MPCADD");
  const std::vector<NastranCard>& cards = bulk.cards_named("MPC");
  if (has_control && !mpc_set) {
    if (!cards.empty()) {
      notes.add("MPC: left out; the case control asks for none (MPC = n)",
                {cards[0].file, cards[0].line});
    }
    return out;
  }
  const auto take = [&](const NastranCard& sum) {
    for (int field = 1; field < sum.size(); ++field) {
      if (!sum.blank(field)) out.insert(sum.id(field));
    }
  };
  if (!mpc_set) {
    if (sums.size() == 1) {
      take(sums[0]);
    } else {
      for (const NastranCard& card : cards) out.insert(card.id(0));
    }
    if (sums.size() > 1 || (sums.empty() && out.size() > 1)) {
      notes.add("MPC: there is no case control to choose a set; all are taken",
                {cards.empty() ? sums[0].file : cards[0].file,
                 cards.empty() ? sums[0].line : cards[0].line});
    }
    return out;
  }
  out.insert(*mpc_set);
  for (const NastranCard& sum : sums) {
    if (sum.id(0) == *mpc_set) take(sum);
  }
  return out;
}

}  // namespace

void add_nastran_connections(const NastranBulk& bulk, bool has_control,
                             const std::optional<std::int64_t>& mpc_set,
                             const NastranCoordinates& coordinates, NastranNotes& notes,
                             fem::ImportedMesh& mesh) {
  ConnectionBuilder builder(coordinates, notes, mesh);
  add_nastran_rigid_elements(bulk, coordinates, notes, mesh);
  for (const NastranCard& card : bulk.cards_named("RBE3")) builder.add_rbe3(card);
  const std::set<std::int64_t> sets = chosen_sets(bulk, has_control, mpc_set, notes);
  for (const NastranCard& card : bulk.cards_named("MPC")) {
    if (sets.contains(card.id(0))) {
      builder.add_mpc(card);
    } else if (has_control && mpc_set) {
      notes.add(
          fmt::format("MPC {}: left out; the case control asks for MPC = {}", card.id(0), *mpc_set),
          {card.file, card.line});
    }
  }
}

}  // namespace buckens::mesh_io
