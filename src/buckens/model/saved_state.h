// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "buckens/base/saved_values.h"
#include "buckens/model/state.h"

namespace buckens::model {

/// Saves or restores a state of a model, everything that steps read of it.
/// @throws InputError if what was saved belongs to another model
void visit_saved(const base::SaveVisit& visit, const Model& model, State& state);

/// The terms of the inertial coupling that a body keeps.
void visit_saved(const base::SaveVisit& visit, body::CouplingTerms& terms);

/// The same for a list of pairs in contact groups. @param are_rigid of which groups
void visit_pairs(const base::SaveVisit& visit, const Model& model, bool are_rigid,
                 std::vector<NearPair>& near);

/// Numbers of nodes. @param n how many @param may_be_empty whether there may be none instead
void visit_nodal(const base::SaveVisit& visit, const std::string& name, Eigen::Index n,
                 bool may_be_empty, linalg::NodalVector& value);

}  // namespace buckens::model
