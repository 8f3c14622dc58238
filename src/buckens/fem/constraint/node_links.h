// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

namespace buckens::fem {

/// Nodes that follow a reference node as a rigid body: u_i = u + θ × (x_i − x), θ_i = θ, in the
/// chosen variables. The others stay free.
struct RigidLink {
  std::string label;  ///< what messages call it: name, or file and line
  int reference = 0;
  std::vector<int> nodes;
  std::array<bool, 6> variables = {true, true, true, true, true, true};
};

/// A node that follows the weighted mean motion of others, see average_rows().
struct AverageLink {
  std::string label;
  int reference = 0;
  std::vector<int> nodes;
  std::vector<double> weights;  ///< as many as nodes, positive
  /// Variables of the reference node that follow. The others stay free.
  std::array<bool, 6> variables = {true, true, true, true, true, true};
  /// For each node the displacements that count, model axes; empty: all.
  std::vector<std::array<bool, 3>> components;
};

/// Σ coefficient × variable = 0. The first term is the one to eliminate, if it can be.
struct LinearEquation {
  struct Term {
    int node = 0;
    int variable = 0;  ///< 0…2 translations, 3…5 rotations, model axes
    double coefficient = 0;
  };
  std::string label;
  std::vector<Term> terms;
};

/// Linear relations between the variables of a mesh. They are eliminated, see elimination.h.
struct NodeLinks {
  std::vector<RigidLink> rigid;
  std::vector<AverageLink> averages;
  std::vector<LinearEquation> equations;

  bool empty() const { return rigid.empty() && averages.empty() && equations.empty(); }
};

}  // namespace buckens::fem
