// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "buckens/base/field.h"
#include "buckens/base/source_location.h"

namespace buckens::fem {

/// Variables of a node.
enum class NodeVariable { x, y, z, rotation_x, rotation_y, rotation_z };

constexpr std::array<const char*, 6> choice_names(NodeVariable) {
  return {"x", "y", "z", "rotation-x", "rotation-y", "rotation-z"};
}

/// Nodes of a structure that follow another node as a rigid body.
struct RigidLinkSpec {
  SourceLocation where;
  std::string reference;
  std::vector<std::string> nodes;
  std::vector<NodeVariable> variables;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(
        base::field("reference", reference, "node that the others follow").required().like("hub"));
    visit(base::field("nodes", nodes, "nodes that follow").required().like("[a, b, c]"));
    visit(base::field("variables", variables,
                      "variables that follow, in model axes; the rest is free")
              .like("[x, y, z]")
              .otherwise("all"));
  }
};

/// A node of a structure that follows the mean motion of other nodes.
struct AverageLinkSpec {
  SourceLocation where;
  std::string reference;
  std::vector<std::string> nodes;
  std::vector<double> weights;
  std::vector<NodeVariable> variables;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("reference", reference, "node that follows").required().like("hub"));
    visit(base::field("nodes", nodes, "nodes whose mean displacement and rotation it follows")
              .required()
              .like("[a, b, c]"));
    visit(base::field("weights", weights, "weight of each of the nodes")
              .positive()
              .like("[1, 2, 1]")
              .otherwise("all alike"));
    visit(base::field("variables", variables,
                      "variables of the reference that follow, in model axes; the rest is free")
              .like("[x, y, z]")
              .otherwise("all"));
  }
};

struct EquationTermSpec {
  SourceLocation where;
  std::string node;
  NodeVariable variable = NodeVariable::x;
  double coefficient = 1;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("node", node, "node").required().like("a"));
    visit(base::field("variable", variable, "displacement or rotation, model axes")
              .required()
              .like("x"));
    visit(base::field("coefficient", coefficient,
                      "factor; a rotation combined with displacements needs a lever arm in metres")
              .like("-1"));
  }
};

/// A linear relation between the variables of a structure.
struct EquationSpec {
  SourceLocation where;
  std::vector<EquationTermSpec> terms;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("terms", terms,
                      "the sum of coefficient times variable is zero; the first variable is "
                      "expressed by the others. Rigid motion must satisfy it")
              .required()
              .like("[{node: a, variable: x}, {node: b, variable: x, coefficient: -1}]"));
  }
};

/// A spring between two nodes of a structure.
struct NodeSpringSpec {
  SourceLocation where;
  std::array<std::string, 2> between;
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< [N/m]
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();     ///< [N m/rad]

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("between", between, "the two nodes").required().like("[a, b]"));
    visit(base::field("translation", translation,
                      "stiffness along x, y, z midway between the nodes, model axes")
              .in(base::kStiffness)
              .non_negative()
              .like("[1e6 N/m, 1e6 N/m, 0]"));
    visit(base::field("rotation", rotation, "stiffness about x, y, z")
              .in(base::kRotationalStiffness)
              .non_negative()
              .like("[0, 0, 100 N m/rad]"));
  }
};

/// Links between the nodes of a structure, eliminated before the equations of motion are formed.
struct StructureLinksSpec {
  SourceLocation where;
  std::vector<RigidLinkSpec> rigid;
  std::vector<AverageLinkSpec> averages;
  std::vector<EquationSpec> equations;
  std::vector<NodeSpringSpec> springs;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("rigid", rigid, "nodes that follow another one as a rigid body")
              .like("[{reference: hub, nodes: [a, b, c]}]"));
    visit(base::field("averages", averages, "nodes that follow the mean motion of others")
              .like("[{reference: hub, nodes: [a, b, c]}]"));
    visit(base::field("equations", equations, "linear relations between variables of nodes"));
    visit(base::field("springs", springs, "springs between two nodes")
              .like("[{between: [a, b], translation: [1e6 N/m, 0, 0]}]"));
  }
};

}  // namespace buckens::fem
