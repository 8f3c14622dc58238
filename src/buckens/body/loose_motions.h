// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "buckens/fem/constraint/node_links.h"
#include "buckens/fem/fe_model.h"

namespace buckens::body {

/// What a node can do without moving mass or an element: a reference node whose links leave it a
/// motion of its own. Where elements resist, as ends of massless beams do, the motion is none of
/// these.
struct LooseMotion {
  int node = 0;
  Eigen::Matrix<double, 6, 1> variables;  ///< 0 where the node has none
};

/// The loose motions of all nodes, those of one node independent of each other. Of M and K the
/// entries between variables of one node are read, from the diagonal down.
/// @param fe after its links are solved: variables of a node follow each other
std::vector<LooseMotion> loose_motions(const fem::FeModel& fe);

/// Makes loose motions follow the rigid motion that fits the elements nearest to their node best.
/// It changes nothing of the body, since they carry nothing; but a joint there finds a node that
/// moves with the body and passes forces on. @return an equation for each
/// @param body its name, for messages
/// @param full before links are solved; its nodes come first among those of the motions
/// @throws ModelError if the nodes of all elements lie on one line and have no rotations, or for a
/// motion of another node
std::vector<fem::LinearEquation> follow_nearest(const std::string& body, const fem::FeModel& full,
                                                const std::vector<LooseMotion>& motions);

/// Names the first node and tells how many there are.
std::string loose_motions_note(const fem::FeModel& full, const std::vector<LooseMotion>& motions);

}  // namespace buckens::body
