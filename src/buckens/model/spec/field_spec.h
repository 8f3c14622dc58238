// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "buckens/base/field.h"
#include "buckens/base/source_location.h"

namespace buckens::model {

/// Fields that can be recorded over a mesh, and loads on a body.
enum class FieldQuantity {
  displacement,           ///< of the nodes from their undeformed positions, body axes
  velocity,               ///< of the nodes, world axes
  acceleration,           ///< of the nodes, world axes
  stress,                 ///< six components, body axes
  strain,                 ///< six components, shear as 2ε, body axes
  von_mises,              ///< equivalent stress
  principal_stress,       ///< in descending order
  strain_energy_density,  ///< ½ σ:ε
  interface_load,         ///< force and torque on the body wherever something acts on it
};

constexpr std::array<const char*, 9> choice_names(FieldQuantity) {
  return {"displacement", "velocity",         "acceleration",          "stress",        "strain",
          "von-mises",    "principal-stress", "strain-energy-density", "interface-load"};
}

enum class FieldLocation { nodes, elements, both };

constexpr std::array<const char*, 3> choice_names(FieldLocation) {
  return {"nodes", "elements", "both"};
}

/// How often the largest von Mises stress of each node is updated.
enum class ExtremeRate { off, records, steps };

constexpr std::array<const char*, 3> choice_names(ExtremeRate) {
  return {"off", "records", "steps"};
}

/// Fields over meshes: which fields, where and how often.
struct FieldOutputSpec {
  SourceLocation where;
  std::vector<FieldQuantity> record;
  std::vector<std::string> on;  ///< "body" or "body/place"; empty: every body that has the fields
  std::optional<double> every;  ///< [s]; default: with every record
  FieldLocation at = FieldLocation::nodes;
  ExtremeRate extremes = ExtremeRate::records;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field(
              "record", record,
              "fields to record: displacement, velocity, acceleration, stress, strain, "
              "von-mises, principal-stress, strain-energy-density; interface-load: forces and "
              "torques of joints and loads on a body, place by place")
              .required()
              .shorthand()
              .like("[von-mises, stress]"));
    visit(
        base::field("on", on,
                    "where: bodies, or body/place with the name of an interface, a face, a set of "
                    "the mesh or a marker")
            .like("[rod, housing/bore]")
            .otherwise("all flexible bodies; interface-load: all bodies"));
    visit(base::field("every", every,
                      "time between two records of fields, a multiple of that of `output`")
              .in(base::kTime)
              .positive()
              .like("10 ms")
              .otherwise("with every record"));
    visit(base::field("at", at,
                      "strains and stresses at nodes (averaged over the adjacent elements of one "
                      "material), at the centres of the elements, or both"));
    visit(base::field("extremes", extremes,
                      "largest von Mises stress of each node over the run and its time, found at "
                      "every record or every step"));
  }
};

}  // namespace buckens::model
