// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "buckens/fem/element/material_spec.h"
#include "buckens/fem/line/section_spec.h"
#include "buckens/fem/mesh/cell_kind.h"

namespace buckens::fem {

/// Elements of one shape and one property.
struct ImportedBlock {
  CellKind kind = CellKind::tet4;
  std::string source;               ///< what the file calls them: "C3D10", "CTETRA", "tetrahedron"
  int property = -1;                ///< in ImportedMesh::properties; −1: none
  std::vector<std::int64_t> ids;    ///< numbers of the elements in the file
  std::vector<int> nodes;           ///< num_nodes(kind) per element, in ImportedMesh::positions
  std::vector<Eigen::Vector3d> up;  ///< per line element a direction near local z; may be empty

  int num_elements() const { return static_cast<int>(ids.size()); }
};

enum class PropertyKind { solid, shell, beam, bar };

/// One layer of a laminate, from the negative to the positive side of the shell.
struct ImportedLayer {
  std::string material;
  double thickness = 0;
  double angle = 0;  ///< of material direction 1 from the shell's reference direction [rad]
};

/// Material and section of the elements in a block.
struct ImportedProperty {
  std::string name;  ///< element set, physical group, "PSHELL 3": key of `materials` in model files
  PropertyKind kind = PropertyKind::solid;
  std::string material;             ///< in ImportedMesh::materials; empty: the model file gives it
  std::optional<double> thickness;  ///< of a shell
  double offset = 0;  ///< of the shell's middle surface from its nodes, along its normal
  std::vector<ImportedLayer> layers;    ///< of a laminate, instead of material and thickness
  std::optional<SectionSpec> section;   ///< of a beam or bar
  std::optional<bool> shear_flexible;   ///< of a beam: Timoshenko or Euler–Bernoulli
  std::optional<Eigen::Matrix3d> axes;  ///< material axes 1, 2, 3 as columns, in mesh axes
  /// If no axes are given, the x axis of a shell is along the first side of each element, not close
  /// to the x axis of the mesh.
  bool along_first_side = false;
  /// Why material or section is missing although the file defines one; without a full stop.
  std::string lacking;
  int line = 0;
};

struct ImportedNodeSet {
  std::string name;
  std::vector<int> nodes;  ///< ascending
};

/// Elements are numbered consecutively over all blocks.
struct ImportedElementSet {
  std::string name;
  std::vector<int> elements;  ///< ascending
};

/// A face of a solid, given by its corner nodes, or one side of a shell.
struct ImportedFace {
  int element = 0;           ///< numbered through all blocks
  std::vector<int> corners;  ///< three or four nodes; for shells: those of the element, seen from
                             ///< the intended side counter-clockwise
};

struct ImportedFaceSet {
  std::string name;
  std::vector<ImportedFace> faces;
};

struct ImportedMass {
  int node = 0;
  double mass = 0;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the mass's own centre, mesh axes
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();   ///< of the centre from the node
};

/// Spring between the six variables of two nodes: force on b = −stiffness (u_b − u_a).
struct ImportedSpring {
  std::array<int, 2> nodes = {0, 0};
  Eigen::Matrix<double, 6, 6> stiffness = Eigen::Matrix<double, 6, 6>::Zero();  ///< mesh axes
};

/// Nodes that follow a reference node as a rigid body, in the chosen variables (RBE2, *KINEMATIC
/// COUPLING, *RIGID BODY).
struct ImportedRigidLink {
  std::string name;
  int reference = 0;
  std::vector<int> nodes;
  std::array<bool, 6> variables = {true, true, true, true, true, true};
  int line = 0;
};

/// A reference node that follows the weighted mean motion of others (RBE3, *COUPLING with
/// *DISTRIBUTING), see fem::AverageLink.
struct ImportedAverage {
  std::string name;
  int reference = 0;
  std::vector<int> nodes;
  std::vector<double> weights;  ///< as many as nodes, or empty: all equal
  int line = 0;
  std::array<bool, 6> variables = {true, true, true, true, true, true};  ///< of the reference
  std::vector<std::array<bool, 3>> components;  ///< that count of each node; empty: all
};

/// Σ coefficient × variable = 0. The first term is the one to eliminate.
struct ImportedEquation {
  struct Term {
    int node = 0;
    int variable = 0;  ///< 0…2 translations, 3…5 rotations, mesh axes
    double coefficient = 0;
  };
  std::vector<Term> terms;
  int line = 0;
};

/// Something the reader did not import, or imported as something else.
struct ImportNote {
  std::string text;  ///< a sentence saying what was done with it
  int line = 0;      ///< 0: the whole file
  int count = 1;     ///< how often it occurred
  /// Harmless: the model file specifies these data anyway, as for loads, supports and requests
  /// for output.
  bool is_expected = false;
  /// Mass or stiffness is missing at the request of the model file: results are doubtful.
  bool is_doubtful = false;
};

/// A mesh as in a file, in the units of the file: the result of all mesh readers.
///
/// Readers check that numbers are finite, references exist and counts agree. They never omit an
/// element silently: `notes` lists everything that they cannot use.
struct ImportedMesh {
  std::string file;
  std::string format;                  ///< "Gmsh 4.1 binary", "Abaqus", "Nastran"
  std::string making;                  ///< duration of each stage if generated; else empty
  std::vector<std::int64_t> node_ids;  ///< node numbers in the file
  std::vector<Eigen::Vector3d> positions;
  std::vector<ImportedBlock> blocks;
  std::vector<ImportedProperty> properties;
  std::vector<MaterialSpec> materials;  ///< in units of the file; rho 0 where it gives none
  std::vector<ImportedNodeSet> node_sets;
  std::vector<ImportedElementSet> element_sets;
  std::vector<ImportedFaceSet> face_sets;
  std::vector<ImportedMass> masses;
  std::vector<ImportedSpring> springs;
  std::vector<ImportedRigidLink> rigid_links;
  std::vector<ImportedAverage> averages;
  std::vector<ImportedEquation> equations;
  std::vector<ImportNote> notes;

  int num_nodes() const { return static_cast<int>(positions.size()); }
  int num_elements() const;
};

/// The same mesh in SI units.
/// @param length of the file's unit [m], mass of the file's unit [kg]; time is in seconds
ImportedMesh in_si(ImportedMesh mesh, double length, double mass);

}  // namespace buckens::fem
