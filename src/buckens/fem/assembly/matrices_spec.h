// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "buckens/base/field.h"
#include "buckens/fem/assembly/body_matrices.h"
#include "buckens/fem/mesh/mesh_file_spec.h"

namespace buckens::fem {

/// A body given by the mass and stiffness matrices of another program.
struct MatricesSpec {
  static constexpr const char* kKey = "matrices";
  static constexpr const char* kDoc =
      "flexible body: mass and stiffness matrices of another program, with a table of nodes";
  SourceLocation where;
  std::string mass;
  std::string stiffness;
  std::string damping;  ///< empty: none
  std::string nodes;
  LengthUnit length_unit = LengthUnit::m;
  std::optional<MassUnit> mass_unit;
  /// In SI units; set by the reader of model files.
  std::shared_ptr<const BodyMatrices> imported;

  MassUnit unit_of_mass() const {
    return mass_unit.value_or(length_unit == LengthUnit::mm ? MassUnit::t : MassUnit::kg);
  }

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("mass", mass,
                      "file with the mass matrix: Matrix Market (.mtx), or as written by *MATRIX "
                      "OUTPUT of Abaqus; file names are relative to the model file")
              .required()
              .like("rotor_mass.mtx"));
    visit(base::field("stiffness", stiffness, "file with the stiffness matrix")
              .required()
              .like("rotor_stiffness.mtx"));
    visit(base::field("damping", damping, "file with a damping matrix")
              .like("rotor_damping.mtx")
              .otherwise("none"));
    visit(base::field("nodes", nodes,
                      "CSV table of the nodes with the columns node, x, y, z and, if the order of "
                      "the rows is not that of the table, ux, uy, uz, rx, ry, rz: the row of "
                      "each displacement and rotation, counted from 1")
              .required()
              .like("rotor_nodes.csv"));
    visit(base::field("length-unit", length_unit, "unit of the lengths in matrices and table"));
    visit(base::field("mass-unit", mass_unit, "unit of mass; time is in seconds")
              .like("t")
              .otherwise("t with millimetres, else kg"));
  }
};

}  // namespace buckens::fem
