// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/linalg/singular_values.h"
#include "buckens/mesh_io/abaqus/mesh.h"
#include "buckens/mesh_io/abaqus/ties.h"
#include "buckens/mesh_io/abaqus/turned_coupling.h"
#include "buckens/mesh_io/skip_list.h"

namespace buckens::mesh_io {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

/// Nodes in links and terms of equations together: lines may name large sets again and again.
constexpr std::size_t kMostLinked = 20'000'000;
// Share of a direction that is rounding of sines and cosines.
constexpr double kNoShare = 1e-14;

/// The term that is eliminated comes first, so it must be the largest.
std::array<int, 3> largest_first(const Vector3d& shares) {
  std::array<int, 3> order = {0, 1, 2};
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return std::abs(shares[a]) > std::abs(shares[b]); });
  return order;
}

/// Turns what couples nodes into links, averages and equations of the mesh.
class LinkMaker {
 public:
  LinkMaker(const AbaqusLines& lines, AbaqusNames& names, fem::ImportedMesh& out)
      : lines_(lines), names_(names), out_(out) {}

  void run() {
    turns_ = names_.turning_nodes();
    find_transforms();
    for (std::size_t s = 0; s < names_.scopes().size(); ++s) {
      const AbaqusScope& scope = *names_.scopes()[s].scope;
      scope_ = static_cast<int>(s);
      for (const AbaqusLink& link : scope.links) add(link);
      for (const AbaqusEquation& equation : scope.equations) add(equation);
      for (const AbaqusSpring& spring : scope.springs) add(spring);
    }
    add_abaqus_ties(lines_, names_, turns_, out_);
  }

 private:
  void find_transforms() {
    for (std::size_t s = 0; s < names_.scopes().size(); ++s) {
      for (const AbaqusTransform& transform : names_.scopes()[s].scope->transforms) {
        for (const int node :
             names_.nodes_of_set(static_cast<int>(s), transform.node_set, transform.place)) {
          transforms_[node] = {&transform, static_cast<int>(s)};
        }
      }
    }
  }

  /// The nodes that follow, with their weights in a mean.
  std::map<int, double> followers(const AbaqusLink& link, int reference) {
    std::map<int, double> nodes;
    for (std::size_t k = 0; k < link.nodes.size(); ++k) {
      const double weight = link.weights.empty() ? 1.0 : link.weights[k];
      for (const int node : names_.nodes(scope_, link.nodes[k], link.place)) nodes[node] = weight;
    }
    for (const std::string& name : link.node_sets) {
      for (const int node : names_.nodes_of_set(scope_, name, link.place)) nodes[node] = 1.0;
    }
    for (const std::string& name : link.surfaces) {
      for (const auto& [node, share] : names_.surface_nodes(scope_, name, link.place)) {
        nodes[node] = share;
      }
    }
    for (const std::string& name : link.element_sets) {
      if (link.reference.empty()) break;  // that of the reference itself
      for (const auto& at : names_.elements_of_set(scope_, name, link.place)) {
        for (const int node : names_.element_nodes(at)) nodes[node] = 1.0;
      }
    }
    const auto& positions = names_.positions();
    std::erase_if(nodes, [&](const auto& entry) {
      const double distance = (positions[static_cast<std::size_t>(entry.first)] -
                               positions[static_cast<std::size_t>(reference)])
                                  .norm();
      return entry.first == reference || (link.radius && distance > *link.radius);
    });
    if (nodes.empty() && link.kind != AbaqusLinkKind::rigid_body) {
      lines_.fail(link.place, "no node follows the reference node");
    }
    return nodes;
  }

  /// Whether some of three directions are coupled, which mean another thing in turned axes.
  static bool is_split(const AbaqusLink& link) {
    const auto& v = link.variables;
    const auto differ = [&v](std::size_t k) { return v[k] != v[k + 1] || v[k] != v[k + 2]; };
    return differ(0) || differ(3);
  }

  void note_turned(DeckPlace place) {
    const AbaqusPlaced& placed = names_.scopes()[static_cast<std::size_t>(scope_)];
    if (placed.rotation.isIdentity(1e-12) || has_noted_) return;
    has_noted_ = true;
    out_.notes.push_back(
        {"degrees of freedom that are named within a part, which its *INSTANCE turns, are taken "
         "along "
         "the axes of the assembly",
         place.file == 0 ? place.line : 0, 1});
  }

  void count_linked(std::size_t nodes, DeckPlace place) {
    num_linked_ += nodes;
    check_linked(num_linked_, place);
  }

  void check_linked(std::size_t nodes, DeckPlace place) const {
    if (nodes <= kMostLinked) return;
    lines_.fail(place,
                fmt::format("with this line the links join more than {} nodes; do several of "
                            "them name the same large set?",
                            kMostLinked));
  }

  void add(const AbaqusLink& link) {
    if (link.kind == AbaqusLinkKind::mpc_plane || link.kind == AbaqusLinkKind::mpc_straight) {
      return add_aligned(link);
    }
    if (link.kind != AbaqusLinkKind::kinematic && link.kind != AbaqusLinkKind::distributing &&
        link.kind != AbaqusLinkKind::rigid_body) {
      return add_pairs(link);
    }
    const int reference = link.reference.empty() ? coupled_node(link)
                                                 : names_.node(scope_, link.reference, link.place);
    std::vector<int> nodes;
    std::vector<double> weights;
    for (const auto& [node, weight] : followers(link, reference)) {
      nodes.push_back(node);
      weights.push_back(weight);
    }
    if (nodes.empty()) {
      out_.notes.push_back({"*RIGID BODY of elements without mass or stiffness is left out",
                            link.place.file == 0 ? link.place.line : 0, 1});
      return;
    }
    count_linked(nodes.size(), link.place);
    if (is_split(link) && !link.orientation.empty()) return add_turned(link, reference, nodes);
    if (is_split(link)) note_turned(link.place);
    if (link.kind == AbaqusLinkKind::distributing) {
      out_.averages.push_back({link.name,
                               reference,
                               std::move(nodes),
                               std::move(weights),
                               link.place.line,
                               link.variables,
                               {}});
    } else {
      out_.rigid_links.push_back(
          {link.name, reference, std::move(nodes), link.variables, link.place.line});
    }
  }

  void add_turned(const AbaqusLink& link, int reference, const std::vector<int>& nodes) {
    if (link.kind == AbaqusLinkKind::distributing) {
      lines_.fail(link.place,
                  "*DISTRIBUTING with ORIENTATION and some rotations released is not supported; "
                  "release all rotations or none, or remove ORIENTATION");
    }
    AbaqusTurnedCoupling(lines_, names_, turns_, out_).add(link, scope_, reference, nodes);
  }

  /// The node of the one DCOUP3D of a *DISTRIBUTING COUPLING.
  int coupled_node(const AbaqusLink& link) {
    const auto elements = names_.elements_of_set(scope_, link.element_sets.front(), link.place);
    const auto nodes =
        elements.size() == 1 ? names_.element_nodes(elements.front()) : std::vector<int>{};
    if (nodes.size() == 1) return nodes.front();
    lines_.fail(link.place, fmt::format("element set \"{}\" must hold one element of type DCOUP3D",
                                        link.element_sets.front()));
  }

  /// Nodes that stay in a plane, or on a line: what they do across it, the first nodes do there.
  void add_aligned(const AbaqusLink& link) {
    std::vector<int> nodes;
    for (const std::string& name : link.nodes) {
      const auto more = names_.nodes_in_order(scope_, name, link.place);
      nodes.insert(nodes.end(), more.begin(), more.end());
    }
    const bool is_plane = link.kind == AbaqusLinkKind::mpc_plane;
    const std::size_t num_leading = is_plane ? 3 : 2;
    if (nodes.size() <= num_leading) {
      lines_.fail(link.place, fmt::format("*MPC, {}: expected more than {} nodes, found {}",
                                          link.name, num_leading, nodes.size()));
    }
    count_linked(nodes.size(), link.place);
    const auto place = [&](int node) { return names_.positions()[static_cast<std::size_t>(node)]; };
    lead_by_widest(nodes, num_leading);
    Eigen::MatrixXd spread(3, num_leading - 1);
    for (std::size_t k = 1; k < num_leading; ++k) {
      spread.col(static_cast<Eigen::Index>(k) - 1) = place(nodes[k]) - place(nodes[0]);
    }
    // Left singular vectors beyond the first: directions across the plane or line.
    const linalg::SingularValues svd = linalg::singular_values(spread, linalg::LeftVectors::full);
    if (!(svd.values.minCoeff() > 1e-6 * svd.values.maxCoeff())) {
      lines_.fail(link.place, fmt::format("the nodes of *MPC, {} span no {}", link.name,
                                          is_plane ? "plane" : "line"));
    }
    for (std::size_t i = num_leading; i < nodes.size(); ++i) {
      const Eigen::VectorXd by = svd.solve(place(nodes[i]) - place(nodes[0]));
      for (Eigen::Index c = spread.cols(); c < 3; ++c) {
        const Vector3d across = svd.U.col(c);
        fem::ImportedEquation& equation = out_.equations.emplace_back();
        equation.line = link.place.line;
        add_shares(nodes[i], across, equation);
        add_shares(nodes[0], -(1.0 - by.sum()) * across, equation);
        for (Eigen::Index k = 0; k < by.size(); ++k) {
          add_shares(nodes[static_cast<std::size_t>(k) + 1], -by[k] * across, equation);
        }
      }
    }
  }

  /// Brings nodes that lie far from each other to the front: the second farthest from the first,
  /// the third farthest from the line of both.
  void lead_by_widest(std::vector<int>& nodes, std::size_t num_leading) const {
    const auto place = [&](int node) { return names_.positions()[static_cast<std::size_t>(node)]; };
    for (std::size_t k = 1; k < num_leading; ++k) {
      const auto height = [&](int node) {
        const Vector3d r = place(node) - place(nodes[0]);
        return k == 1 ? r.norm() : r.cross(place(nodes[1]) - place(nodes[0])).norm();
      };
      const auto begin = nodes.begin() + static_cast<std::ptrdiff_t>(k);
      const auto widest =
          std::max_element(begin, nodes.end(), [&](int a, int b) { return height(a) < height(b); });
      std::rotate(begin, widest, widest + 1);
    }
  }

  /// The displacement of a node along a direction, as terms.
  static void add_shares(int node, const Vector3d& along, fem::ImportedEquation& out) {
    for (const int k : largest_first(along)) {
      if (std::abs(along[k]) > kNoShare) out.terms.push_back({node, k, along[k]});
    }
  }

  /// Nodes of two sets in their order, or all of one set with a single node.
  void add_pairs(const AbaqusLink& link) {
    std::vector<int> first = names_.nodes_in_order(scope_, link.nodes.front(), link.place);
    std::vector<int> second = names_.nodes_in_order(scope_, link.reference, link.place);
    if (second.size() == 1) second.resize(first.size(), second.front());
    if (first.size() != second.size() || first.empty()) {
      lines_.fail(link.place, fmt::format("the sets of the *MPC have {} and {} nodes; they must "
                                          "have equally many, or the second only one",
                                          first.size(), second.size()));
    }
    count_linked(6 * first.size(), link.place);
    for (std::size_t k = 0; k < first.size(); ++k) {
      if (first[k] == second[k]) {
        lines_.fail(link.place, "the *MPC joins a node to itself");
      }
      if (link.kind == AbaqusLinkKind::mpc_beam) {
        out_.rigid_links.push_back(
            {link.name, second[k], {first[k]}, link.variables, link.place.line});
        continue;
      }
      if (link.kind == AbaqusLinkKind::mpc_link) {
        add_distance(first[k], second[k], link.place);
        continue;
      }
      const bool turn = link.kind == AbaqusLinkKind::mpc_tie &&
                        turns_[static_cast<std::size_t>(first[k])] &&
                        turns_[static_cast<std::size_t>(second[k])];
      for (int v = 0; v < (turn ? 6 : 3); ++v) {
        out_.equations.push_back({{{first[k], v, 1.0}, {second[k], v, -1.0}}, link.place.line});
      }
    }
  }

  /// Two nodes that keep their distance: (x_a − x_b)·(u_a − u_b) = 0.
  void add_distance(int a, int b, DeckPlace place) {
    const Vector3d between = names_.positions()[static_cast<std::size_t>(a)] -
                             names_.positions()[static_cast<std::size_t>(b)];
    if (!(between.norm() > 0.0)) {
      lines_.fail(place, "the *MPC LINK joins coincident nodes, between which it has no direction");
    }
    const Vector3d along = between.normalized();
    fem::ImportedEquation& out = out_.equations.emplace_back();
    out.line = place.line;
    for (const int k : largest_first(along)) {
      if (std::abs(along[k]) < kNoShare) continue;
      out.terms.push_back({a, k, along[k]});
      out.terms.push_back({b, k, -along[k]});
    }
  }

  void add(const AbaqusEquation& equation) {
    std::vector<std::vector<int>> nodes;
    std::size_t listed = 0;
    for (const AbaqusEquation::Term& term : equation.terms) {
      nodes.push_back(names_.nodes_in_order(scope_, term.reference, equation.place));
      listed += nodes.back().size();
      check_linked(num_linked_ + listed, equation.place);
    }
    const std::size_t num_equations = nodes.front().size();
    for (const auto& list : nodes) {
      const bool fits = list.size() == num_equations || list.size() == 1;
      if (num_equations > 0 && fits) continue;
      lines_.fail(equation.place, fmt::format("the sets of the equation have {} and {} nodes; they "
                                              "must have equally many, or only one",
                                              num_equations, list.size()));
    }
    note_turned(equation.place);
    count_linked(num_equations * nodes.size(), equation.place);
    for (std::size_t k = 0; k < num_equations; ++k) {
      fem::ImportedEquation& out = out_.equations.emplace_back();
      out.line = equation.place.line;
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const int node = nodes[i].size() == 1 ? nodes[i].front() : nodes[i][k];
        add_term(node, equation.terms[i], out);
      }
    }
  }

  void add(const AbaqusSpring& spring) {
    for (const auto& at : names_.elements_of_set(scope_, spring.element_set, spring.place)) {
      const AbaqusElementType& type =
          *names_.scopes()[static_cast<std::size_t>(at.scope)].at(at.element).first->type;
      if (type.role != AbaqusRole::spring) continue;
      const std::vector<int> nodes = names_.element_nodes(at);
      fem::ImportedSpring own;
      own.nodes = {nodes[0], nodes[1]};
      if (type.name == "SPRINGA") {
        const Vector3d between = names_.positions()[static_cast<std::size_t>(nodes[1])] -
                                 names_.positions()[static_cast<std::size_t>(nodes[0])];
        if (!(between.norm() > 0.0)) {
          lines_.fail(spring.place, "a SPRINGA joins coincident nodes and has no direction");
        }
        const Vector3d along = between.normalized();
        own.stiffness.topLeftCorner<3, 3>() = spring.stiffness * along * along.transpose();
      } else {
        add_direction(spring, nodes, own);
      }
      out_.springs.push_back(own);
    }
  }

  /// SPRING2: between one degree of freedom of both nodes.
  void add_direction(const AbaqusSpring& spring, const std::vector<int>& nodes,
                     fem::ImportedSpring& own) const {
    const int v = spring.variables[0];
    const auto turns = [&](int node) { return turns_[static_cast<std::size_t>(node)]; };
    if (spring.is_turned || v != spring.variables[1] || v < 0 ||
        (v > 2 && !(turns(nodes[0]) && turns(nodes[1])))) {
      lines_.fail(spring.place,
                  fmt::format("*SPRING of SPRING2 with ORIENTATION, between different degrees of "
                              "freedom or at rotations that its nodes lack is not supported{}",
                              SkipList::remedy("SPRING2")));
    }
    own.stiffness(v, v) = spring.stiffness;
  }

  /// A term in the axes of *TRANSFORM becomes up to three in those of the mesh.
  void add_term(int node, const AbaqusEquation::Term& term, fem::ImportedEquation& out) const {
    const auto found = transforms_.find(node);
    if (found == transforms_.end()) {
      out.terms.push_back({node, term.variable, term.coefficient});
      return;
    }
    const Matrix3d axes = axes_at(node, *found->second.first, found->second.second);
    const int first = term.variable < 3 ? 0 : 3;
    const Vector3d shares = term.coefficient * axes.col(term.variable - first);
    for (const int k : largest_first(shares)) {
      if (std::abs(shares[k]) < kNoShare * std::abs(term.coefficient)) continue;
      out.terms.push_back({node, first + k, shares[k]});
    }
  }

  /// Columns: the directions 1, 2, 3 of a *TRANSFORM at a node.
  Matrix3d axes_at(int node, const AbaqusTransform& transform, int scope) const {
    const AbaqusPlaced& placed = names_.scopes()[static_cast<std::size_t>(scope)];
    if (!transform.is_supported) {
      lines_.fail(transform.place,
                  "an *EQUATION uses nodes of this *TRANSFORM; only TYPE=R and "
                  "TYPE=C are supported there");
    }
    Matrix3d out;
    if (transform.is_cylindrical) {
      const Vector3d axis = placed.rotation * (transform.b - transform.a).normalized();
      Vector3d radial = names_.positions()[static_cast<std::size_t>(node)] -
                        (placed.rotation * transform.a + placed.origin);
      radial -= radial.dot(axis) * axis;
      if (radial.norm() == 0.0) {
        lines_.fail(
            transform.place,
            "a node of this *TRANSFORM lies on its axis, where the radial direction is undefined");
      }
      out.col(0) = radial.normalized();
      out.col(1) = axis.cross(out.col(0));
      out.col(2) = axis;
      return out;
    }
    out.col(0) = transform.a.normalized();
    out.col(2) = transform.a.cross(transform.b).normalized();
    out.col(1) = out.col(2).cross(out.col(0));
    return placed.rotation * out;
  }

  const AbaqusLines& lines_;
  AbaqusNames& names_;
  fem::ImportedMesh& out_;
  int scope_ = 0;
  std::size_t num_linked_ = 0;
  bool has_noted_ = false;
  std::vector<bool> turns_;
  /// Per node its *TRANSFORM and the placed scope where it stands.
  std::map<int, std::pair<const AbaqusTransform*, int>> transforms_;
};

}  // namespace

void add_abaqus_links(const AbaqusLines& lines, AbaqusNames& names, fem::ImportedMesh& out) {
  LinkMaker(lines, names, out).run();
}

}  // namespace buckens::mesh_io
