// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "buckens/body/nodal_part.h"
#include "buckens/fem/assembly/element_recovery.h"
#include "buckens/fem/assembly/recovery.h"
#include "buckens/fem/solid/recovery.h"
#include "buckens/results/observation.h"

namespace buckens::results {

/// Adds to observations what is read of meshes: nodal variables, section forces and stresses.
class MeshObserver {
 public:
  /// @param pool shares the work, or null; outlives this object
  explicit MeshObserver(const model::Model& model, TaskPool* pool = nullptr);

  /// Everything, of all bodies. Cost: a product with the recovery rows per flexible body.
  void add_all(Observation& now) const;
  /// What is read only. Of some elements that takes the nodal variables around them; if other
  /// processes have these, they come here by one order per body. Those find the largest stress of a
  /// body of solids and shells, too, if its nodes follow no others.
  void add(const ObservedParts& parts, Observation& now);

 private:
  /// How numbers of some elements of a body are formed.
  struct Some {
    ObservedElements elements;
    fem::ElementRecovery recovery;
    body::NodalPart nodal;
  };

  static void make_room(Observation& now);
  void add_all_of(std::size_t body, Observation& now) const;
  std::optional<double> largest_elsewhere(std::size_t body, const Observation& now) const;
  const Some& some_of(std::size_t body, const ObservedElements& elements);

  const model::Model& model_;
  TaskPool* pool_;
  std::vector<std::unique_ptr<fem::Recovery>> lines_;        // null of rigid bodies
  std::vector<std::unique_ptr<fem::SolidRecovery>> solids_;  // null where there are none
  std::map<std::size_t, Some> some_;                         // as they were last asked for
};

}  // namespace buckens::results
