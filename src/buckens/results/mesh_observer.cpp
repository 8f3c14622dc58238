// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/mesh_observer.h"

namespace buckens::results {

MeshObserver::MeshObserver(const model::Model& model, TaskPool* pool) : model_(model), pool_(pool) {
  for (const body::Body& body : model.bodies) {
    lines_.push_back(body.is_flexible() ? std::make_unique<fem::Recovery>(body.flexible->mesh())
                                        : nullptr);
    const bool has_solids = body.is_flexible() && fem::num_solids(body.flexible->mesh()) > 0;
    solids_.push_back(has_solids ? std::make_unique<fem::SolidRecovery>(body.flexible->mesh())
                                 : nullptr);
  }
}

void MeshObserver::make_room(Observation& now) {
  const std::size_t bodies = now.model.bodies.size();
  now.nodal.resize(bodies);
  for (auto* tables : {&now.section_forces, &now.stresses, &now.solid_stresses}) {
    tables->resize(bodies);
  }
}

void MeshObserver::add_all(Observation& now) const {
  make_room(now);
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    if (lines_[b]) add_all_of(b, now);
  }
}

void MeshObserver::add_all_of(std::size_t body, Observation& now) const {
  now.nodal[body] = model_.bodies[body].flexible->nodal(now.state.bodies[body].d);
  now.section_forces[body] = lines_[body]->section_forces(now.nodal[body]);
  now.stresses[body] = lines_[body]->stresses(now.section_forces[body]);
  if (!solids_[body]) return;
  TaskPool* pool = model_.bodies[body].flexible->if_worth(pool_);
  now.solid_stresses[body] = solids_[body]->stresses(now.nodal[body], pool);
}

void MeshObserver::add(const ObservedParts& parts, Observation& now) {
  if (parts.bodies.empty()) return;
  make_room(now);
  for (const auto& [index, elements] : parts.bodies) {
    const auto body = static_cast<std::size_t>(index);
    if (elements.largest) {
      const std::optional<double> mises = largest_elsewhere(body, now);
      if (!mises) {
        add_all_of(body, now);
        continue;
      }
      now.largest[index] = {0.0, *mises};
    }
    if (elements.lines.empty() && elements.solids.empty()) continue;
    const Some& some = some_of(body, elements);
    const linalg::NodalVector& d = now.state.bodies[body].d;
    const linalg::Vector nodal = some.nodal.apply(d.some(some.nodal.variables()));
    now.section_forces[body] = some.recovery.section_forces(nodal);
    now.stresses[body] = some.recovery.stresses(now.section_forces[body]);
    now.solid_stresses[body] = some.recovery.solid_stresses(nodal);
    now.columns[index] = elements;
  }
}

/// Where vectors are those of nodes, and beams have no stresses besides.
std::optional<double> MeshObserver::largest_elsewhere(std::size_t body,
                                                      const Observation& now) const {
  const bool is_of_solids = solids_[body] && lines_[body]->num_elements() == 0;
  if (!is_of_solids || !model_.bodies[body].flexible->recovery.is_identity()) return {};
  return solids_[body]->largest_elsewhere(now.state.bodies[body].d);
}

const MeshObserver::Some& MeshObserver::some_of(std::size_t body,
                                                const ObservedElements& elements) {
  const auto [found, is_new] = some_.try_emplace(body);
  Some& some = found->second;
  if (!is_new && some.elements == elements) return some;
  const body::FlexiblePart& part = *model_.bodies[body].flexible;
  some.recovery = {part.mesh(), *lines_[body], elements.lines, elements.solids};
  some.nodal = {part.recovery, some.recovery.variables()};
  some.elements = elements;
  return some;
}

}  // namespace buckens::results
