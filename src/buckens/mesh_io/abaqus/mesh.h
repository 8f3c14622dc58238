// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "buckens/fem/mesh/imported_mesh.h"
#include "buckens/mesh_io/abaqus/names.h"

namespace buckens::mesh_io {

/// Makes the neutral mesh of a deck: instances placed, elements in blocks of one type and property,
/// names prefixed by their instance if there are several.
class AbaqusMesh {
 public:
  AbaqusMesh(const AbaqusDeck& deck, const AbaqusLines& lines);

  /// @throws InputError with the place of anything invalid
  fem::ImportedMesh run();

 private:
  struct Numbers {
    int first = -1;  ///< of the elements that it became, through all blocks
    int count = 0;
  };

  bool labels_meet() const;
  /// Whether a scope has elements of one of these roles.
  bool has_any(std::initializer_list<AbaqusRole> roles) const;
  /// What an element becomes: plane ones are shells if there is nothing else, and bars without a
  /// section beside others are left-over edges of a mesh generator.
  AbaqusRole role_of(int scope, int element) const;
  void refuse_without_elements() const;
  /// What an element has of its own, where its section leaves this to nodes and distributions.
  struct OwnValues {
    double thickness = 0;  ///< of a shell, or of a beam in direction 1; 0: the section's
    double second = 0;     ///< of a beam in direction 2
    std::optional<Eigen::Matrix3d> axes;  ///< in which those of the orientation are
    /// Of each layer from the section's direction 1, if some have an orientation [rad].
    std::vector<double> angles;

    std::vector<double> key() const;
  };
  OwnValues own_values(int scope, const AbaqusSection& section, int element);
  void set_mean_measures(int scope, const AbaqusSection& section, int element, OwnValues& out);
  /// The values of an element by a *DISTRIBUTION.
  /// @throws InputError if there are none, or not so many
  const std::vector<double>& distributed(int scope, const std::string& name, int element,
                                         std::size_t count, DeckPlace place);
  void set_own_measures(const AbaqusSection& section, const OwnValues& own,
                        fem::ImportedProperty& property);
  static bool has_directed_layers(const AbaqusSection& section);
  const AbaqusOrientation* reference_orientation(int scope, const AbaqusSection& section) const;
  Eigen::Vector3d shell_normal(int scope, int element) const;
  /// The two axes after the normal one, and that.
  static Eigen::Matrix3d in_order_of_shell(const Eigen::Matrix3d& axes, int normal);
  void check_normal(int scope, const AbaqusOrientation& axes, const OwnValues& own,
                    const Eigen::Vector3d& normal);
  void set_layer_angles(int scope, const AbaqusSection& section, const AbaqusOrientation* reference,
                        const Eigen::Vector3d& normal, OwnValues& out);
  /// Whether material axes make no difference.
  bool has_no_directions(const AbaqusSection& section) const;
  std::string free_property_name(int scope, const AbaqusSection& section);
  void add_nodes();
  void add_materials();
  void assign_sections(int scope);
  int property_for(int scope, const AbaqusSection& section, int element);
  void fill_property(int scope, const AbaqusSection& section, const OwnValues& own_values,
                     fem::ImportedProperty& property);
  void set_layers(const AbaqusSection& section, const OwnValues& own_values,
                  fem::ImportedProperty& property);
  void set_axes(int scope, const AbaqusSection& section, const OwnValues& own_values,
                fem::ImportedProperty& property);
  void refuse_turned(const std::string& material, DeckPlace place) const;
  void turn_material(const AbaqusSection& section, fem::ImportedProperty& property);
  std::string material_called(const std::string& name, DeckPlace place);
  const AbaqusOrientation* orientation_called(int scope, const std::string& name,
                                              DeckPlace place) const;
  void add_elements(int scope);
  void add_element(int scope, int element);
  Eigen::Vector3d up_direction(int scope, int element, int a, int b) const;
  Eigen::Vector3d shift_of(const AbaqusSection& section, int a, int b,
                           const Eigen::Vector3d& up) const;
  Eigen::Vector3d turned_up(const AbaqusSection& section, int a, int b,
                            const Eigen::Vector3d& up) const;
  int shifted_node(int node, const Eigen::Vector3d& shift, DeckPlace place);
  void number_blocks();
  void add_masses(int scope);
  void add_sets(int scope);
  void add_surfaces(int scope);
  void add_instances();
  void note_element_types();
  std::string prefixed(int scope, const std::string& name) const;
  fem::ImportNote note_at(DeckPlace place, std::string text, int count) const;

  const AbaqusDeck& deck_;
  const AbaqusLines& lines_;
  AbaqusNames names_;
  fem::ImportedMesh out_;
  /// Per placed scope and element: the section, −1: none.
  std::vector<std::vector<int>> section_of_;
  /// By file and line of the section, placed scope, kind, whether beams shear, own values.
  std::map<std::tuple<int, int, int, fem::PropertyKind, bool, std::vector<double>>, int>
      properties_;
  std::map<std::string, int> property_numbers_;  ///< the last used, by element set
  std::map<int, std::map<int, const AbaqusThickness*>> thicknesses_;  ///< of nodes, by placed scope
  /// Values of elements, by placed scope and name of the distribution.
  std::map<std::pair<int, std::string>, std::map<int, const std::vector<double>*>> distributions_;
  std::set<int> thicknesses_noted_;  ///< lines of sections
  bool has_bodies_ = false, has_planes_ = false;
  std::set<std::string> property_names_;          ///< in capitals
  std::map<std::string, std::string> materials_;  ///< names as written by names in capitals
  std::map<std::pair<const AbaqusElementType*, int>, std::size_t> block_of_;
  /// Per block: the placed scope and element of each of its elements.
  std::vector<std::vector<AbaqusElementAt>> sources_;
  std::vector<std::vector<Numbers>> numbers_;                     ///< per placed scope and element
  std::map<std::pair<int, std::array<double, 3>>, int> shifted_;  ///< by node and shift
  std::int64_t free_label_ = 0;                                   ///< of the last node added
  std::int64_t shift_ = 0;  ///< of labels from instance to instance
};

/// Adds rigid links, averages and equations.
void add_abaqus_links(const AbaqusLines& lines, AbaqusNames& names, fem::ImportedMesh& out);

}  // namespace buckens::mesh_io
