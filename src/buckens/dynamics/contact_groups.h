// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/dynamics/circumstances.h"
#include "buckens/dynamics/forces.h"

namespace buckens::dynamics {

/// Members of elastic contact groups that touch or are near each other, ascending.
/// @param ahead the time over which they are to be found in advance [s]
std::vector<model::NearPair> find_near(const model::Model& model,
                                       const std::vector<BodyMotion>& motions, double ahead);

/// The same of rigid groups, whose forces are those of loads (model::RigidPairs). Pairs that have
/// them stay until they are further apart.
std::vector<model::NearPair> find_rigid_pairs(const model::Model& model,
                                              const std::vector<BodyMotion>& motions, double ahead);
/// The same of all that may meet on a way, however long. What is far apart at its start is found by
/// the boxes around it alone.
/// @param motions at its start, with velocities that lead to its end within 1 s
std::vector<model::NearPair> find_rigid_pairs_on(const model::Model& model,
                                                 const std::vector<BodyMotion>& motions);

/// Adds the forces of all near pairs. Without a memory those that touch at the instant.
void add_group_forces(const model::Model& model, const std::vector<BodyMotion>& motions, double t,
                      const Circumstances& around, Forces& out);
/// Appends their tangents, behind those of the loads.
void append_group_tangents(const model::Model& model, const std::vector<BodyMotion>& motions,
                           double t, const Circumstances& around, SoftRows& out);

/// Finds near pairs and their states before the first step.
void start_near(const model::Model& model, const std::vector<BodyMotion>& motions,
                model::RowMemory& out);
/// Where events have changed numbers of groups: what friction of elastic pairs holds follows at
/// once.
void restrain_near(const model::Model& model, const std::vector<BodyMotion>& motions, double t,
                   model::RowMemory& memory);
/// The same at the end of a step. @param around with the memory at its start
void advance_near(const model::Model& model, const std::vector<BodyMotion>& motions, double t,
                  const Circumstances& around, model::RowMemory& out);

/// Energy that an elastic group stores [J].
double stored_in_group(const model::Model& model, std::size_t group,
                       const std::vector<BodyMotion>& motions, double t,
                       const Circumstances& around);

/// What the contacts of one group do at one instant.
struct GroupReading {
  double normal = 0;    ///< sum of the forces across all surfaces [N]
  double friction = 0;  ///< sum of the sizes of those along them [N]
  int touching = 0;     ///< number of pairs that touch
};
GroupReading read_group(const model::Model& model, std::size_t group,
                        const std::vector<BodyMotion>& motions, double t,
                        const Circumstances& around);

}  // namespace buckens::dynamics
