// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <vector>

#include "buckens/model/build/rigid_contact_rows.h"
#include "buckens/model/model.h"

namespace buckens::model {

/// Gives a model the loads of those pairs in its rigid contact groups that are near each other.
///
/// They stand behind all other loads, in the order of the pairs, so nothing else changes its place.
/// What is made for a pair follows from the model as placed: it is the same whenever the pair comes
/// near. Theory: docs/theory/25-contact.md §5.
class RigidPairs {
 public:
  /// @param model must outlive this object
  explicit RigidPairs(Model& model) : model_(model) {}

  /// Whether a model has rigid groups.
  static bool are_needed(const Model& model);
  /// Replaces the loads of all pairs by those of these. @param pairs ascending, each can touch
  void set(const std::vector<NearPair>& pairs);
  const Model& model() const { return model_; }

 private:
  const std::vector<RigidContactRow>& rows_of(const NearPair& pair);

  Model& model_;
  std::map<NearPair, std::vector<RigidContactRow>> known_;
};

/// The places in which two members of a group can touch, the first one being the surface.
std::vector<spatial::RigidTouch> touches_of(const Model& model, const ContactMember& first,
                                            const ContactMember& second);

}  // namespace buckens::model
