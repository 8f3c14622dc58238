// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "buckens/fem/mesh/imported_mesh.h"
#include "buckens/mesh_io/abaqus/elements.h"
#include "buckens/mesh_io/abaqus/lines.h"

/// The contents of a deck, before names and numbers are looked up. Names are kept as written and
/// compared in upper case. A "reference" is a number or the name of a set, optionally preceded by
/// an instance: "12", "BEARING", "ROD-1.BEARING".
namespace buckens::mesh_io {

struct AbaqusNodes {
  std::vector<std::int64_t> ids;
  std::vector<Eigen::Vector3d> positions;
  std::vector<DeckPlace> places;
};

/// The elements of one *ELEMENT.
struct AbaqusElements {
  const AbaqusElementType* type = nullptr;
  std::vector<std::int64_t> ids;
  std::vector<std::int64_t> nodes;  ///< type->num_nodes per element
  /// For each beam element the node that gives direction 1 of the section, −1: none.
  std::vector<std::int64_t> direction_nodes;
  std::vector<DeckPlace> places;
};

/// One *NSET or *ELSET; those of the same name add up.
struct AbaqusSetPart {
  struct Range {
    std::int64_t first = 0, last = 0, step = 1;
  };
  std::string instance;
  std::vector<std::int64_t> ids;
  std::vector<Range> ranges;
  std::vector<std::string> names;
  std::string of_elements;  ///< *NSET, ELSET=: the nodes of these elements
  DeckPlace place;
};

struct AbaqusSet {
  std::string name;
  bool is_internal = false;
  bool is_unsorted = false;  ///< in pairs of sets its nodes are in the order of the deck
  std::vector<AbaqusSetPart> parts;
};

struct AbaqusSurface {
  struct Item {
    std::string reference;
    std::string face;  ///< "S1", "SPOS", "": free faces
    std::string instance;
    double area = 1;  ///< of each of its nodes, in a surface of nodes
    DeckPlace place;
  };
  std::string name;
  bool is_of_nodes = false;
  bool is_internal = false;
  std::vector<Item> items;
  DeckPlace place;
};

/// A *SOLID, *SHELL or *BEAM SECTION. In units of the deck.
struct AbaqusSection {
  struct Layer {
    std::string material;
    double thickness = 0;
    double angle = 0;  ///< [rad]
    std::string orientation;
    DeckPlace place;
  };
  fem::PropertyKind kind = fem::PropertyKind::solid;
  std::string element_set;
  std::string material;
  std::string orientation;
  double area = 1;  ///< of bars
  std::optional<double> thickness;
  bool has_nodal_thickness = false;  ///< that of *NODAL THICKNESS takes precedence
  std::string thicknesses;           ///< SHELL THICKNESS=, the name of a *DISTRIBUTION
  double offset = 0;                 ///< of the nodes' surface from the middle one, in thicknesses
  std::vector<Layer> layers;
  std::optional<fem::SectionSpec> shape;
  Eigen::Vector2d measures = Eigen::Vector2d::Zero();  ///< of the shape along 1 and 2; 0: unknown
  bool is_round = false;                               ///< SECTION=CIRC
  /// From the nodes of beams to the centres of their sections, along directions 1 and 2.
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
  double turn = 0;  ///< from direction 1 to the section's first axis, about the beam [rad]
  Eigen::Vector3d n1 = -Eigen::Vector3d::UnitZ();
  DeckPlace place;
};

struct AbaqusOrientation {
  std::string name;
  std::string system;  ///< "RECTANGULAR" or one that is not supported
  /// Columns 1, 2, 3, after the additional rotation; with a distribution in the axes of this.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  std::string distribution;  ///< name of the *DISTRIBUTION of points a and b; empty: none
  /// Axis of the additional rotation, 0…2, close to the normal of shells; none: not given.
  std::optional<int> normal;
  bool is_cylindrical = false;  ///< about the line from a to b
  Eigen::Vector3d a = Eigen::Vector3d::Zero(), b = Eigen::Vector3d::UnitZ();
  DeckPlace place;
};

/// A *MASS or *ROTARY INERTIA.
struct AbaqusMass {
  std::string element_set;
  bool is_rotary = false;
  double mass = 0;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  std::string orientation;
  DeckPlace place;
};

struct AbaqusTransform {
  std::string node_set;
  bool is_cylindrical = false;
  bool is_supported = true;
  Eigen::Vector3d a, b;
  DeckPlace place;
};

enum class AbaqusLinkKind {
  kinematic,
  distributing,
  rigid_body,
  mpc_beam,
  mpc_tie,
  mpc_pin,
  mpc_link,
  mpc_plane,
  mpc_straight,
};

/// A *SPRING.
struct AbaqusSpring {
  std::string element_set;
  std::array<int, 2> variables = {-1, -1};  ///< of SPRING2, from 0
  double stiffness = 0;
  bool is_turned = false;  ///< the directions are in their own axes, ORIENTATION=
  DeckPlace place;
};

/// A *DISTRIBUTION: numbers that each element has of its own.
struct AbaqusDistribution {
  struct Entry {
    std::string reference;
    std::vector<double> values;
    DeckPlace place;
  };
  bool is_of_elements = true;
  std::vector<double> otherwise;  ///< for elements without an entry; empty: none
  std::vector<Entry> entries;
  DeckPlace place;
};

/// A line of *NODAL THICKNESS.
struct AbaqusThickness {
  std::string reference;
  double thickness = 0;
  double second = 0;  ///< of a beam, in direction 2
  DeckPlace place;
};

/// A line of *TIE.
struct AbaqusTie {
  std::string name, slave, master;
  std::optional<double> tolerance;
  bool ties_rotations = true;
  DeckPlace place;
};

/// A line of *CONTACT PAIR, as a tie if it cannot open.
struct AbaqusContact {
  std::string interaction;  ///< in capitals
  bool is_tied = false;
  AbaqusTie tie;
};

/// A *COUPLING, *KINEMATIC COUPLING, *RIGID BODY or a line of *MPC.
struct AbaqusLink {
  AbaqusLinkKind kind = AbaqusLinkKind::kinematic;
  std::string name;
  std::string reference;  ///< the leading node
  /// The nodes that follow: references on data lines, node sets, surfaces or element sets.
  std::vector<std::string> nodes, node_sets, surfaces, element_sets;
  std::array<bool, 6> variables = {true, true, true, true, true, true};
  std::string orientation;       ///< the variables are in its axes; empty: in those of the mesh
  std::optional<double> radius;  ///< *COUPLING, INFLUENCE RADIUS=
  std::vector<double> weights;   ///< of `nodes`; empty: 1 each
  DeckPlace place;
};

struct AbaqusEquation {
  struct Term {
    std::string reference;
    int variable = 0;
    double coefficient = 0;
  };
  std::vector<Term> terms;
  DeckPlace place;
};

/// Contents between *PART and *END PART, or of a deck without parts.
struct AbaqusScope {
  std::string name;
  AbaqusNodes nodes;
  std::vector<AbaqusElements> elements;
  std::map<std::string, AbaqusSet> node_sets, element_sets;  ///< by name in capitals
  /// By name in capitals. A surface of nodes and one of faces may share a name, as in CalculiX.
  std::map<std::string, AbaqusSurface> surfaces, node_surfaces;
  std::vector<AbaqusSection> sections;
  std::map<std::string, AbaqusOrientation> orientations;
  std::vector<AbaqusMass> masses;
  std::vector<AbaqusTransform> transforms;
  std::vector<AbaqusLink> links;
  std::vector<AbaqusEquation> equations;
  std::vector<AbaqusTie> ties;
  std::vector<AbaqusContact> contacts;
  std::vector<AbaqusSpring> springs;
  std::vector<AbaqusThickness> thicknesses;
  std::map<std::string, AbaqusDistribution> distributions;  ///< by name in capitals
};

/// A part placed in the assembly: first translated, then rotated.
struct AbaqusInstance {
  std::string name;
  AbaqusScope scope;  ///< a copy of the part, with the additions of the instance
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< a point of the axis of rotation
  DeckPlace place;
};

/// A type of elements that the model file asks to leave out.
struct AbaqusSkippedType {
  std::string name;
  AbaqusElementType type;
};

/// A whole deck.
struct AbaqusDeck {
  std::list<AbaqusSkippedType> skipped;  ///< elements point into it
  AbaqusScope root;                      ///< the assembly, or everything
  std::map<std::string, AbaqusScope> parts;
  std::vector<AbaqusInstance> instances;
  std::map<std::string, fem::MaterialSpec> materials;  ///< by name in capitals
  std::set<std::string> tied_interactions;             ///< of contact, in capitals
  std::set<std::string> laminae;  ///< those given by their constants in a plane, in capitals
  /// Materials whose planes of symmetry are turned from the axes of their constants, in capitals.
  std::set<std::string> turned_materials;
  std::vector<fem::ImportNote> notes;
};

}  // namespace buckens::mesh_io
