// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include "buckens/fem/mesh/imported_mesh.h"
#include "buckens/mesh_io/nastran/coordinates.h"
#include "buckens/mesh_io/nastran/materials.h"
#include "buckens/mesh_io/nastran/sections.h"

namespace buckens::mesh_io {

/// The properties of a deck, imported when an element uses them.
///
/// A shell property occurs once per thickness, offset and direction of its elements, always under
/// the same name.
class NastranProperties {
 public:
  /// @throws InputError if two cards of one family have the same number
  NastranProperties(const NastranBulk& bulk, const NastranNames& names,
                    const NastranCoordinates& coordinates, NastranMaterials& materials,
                    NastranNotes& notes);

  /// Index of the property of an element; its kind tells which cards apply.
  /// @param nodes positions of the corners of a shell; otherwise not used
  /// One that is missing or not supported is left to the model file: see
  /// fem::ImportedProperty::lacking.
  /// @throws InputError if its card cannot be read
  int of(const NastranElement& element, const std::vector<Eigen::Vector3d>& nodes);

  /// Non-structural mass per area or length, in the file's unit of mass.
  double nonstructural_mass(int property) const { return more(property).mass; }
  /// Of the section's y axis from Nastran's, about x [rad].
  double section_angle(int property) const { return more(property).angle; }

  /// Of the neutral axis from the line between the nodes, in Nastran's axes (y, z).
  const std::array<double, 2>& neutral_axis(int property) const { return more(property).offset; }

  std::vector<fem::ImportedProperty> take() { return std::move(properties_); }

 private:
  enum class Family { solid, shell, bar, beam, rod, tube, conrod };

  struct More {
    double mass = 0;
    double angle = 0;
    std::array<double, 2> offset = {0, 0};
  };

  struct Shell {
    fem::ImportedProperty property;
    double mass = 0;
    bool has_directions = false;
    bool is_isotropic = false;  ///< has directions, which change nothing but where stress is shown
  };

  /// Of material direction 1 of a shell.
  struct Direction {
    std::optional<Eigen::Matrix3d> axes;  ///< none: it is that of the first side
    double angle = 0;                     ///< by which it is rotated from there [rad]
  };

  /// Card, thickness, offset, first axis (zero: the first side), angle.
  using ShellKey = std::tuple<const NastranCard*, double, double, std::array<double, 3>, double>;

  const More& more(int property) const { return more_[static_cast<std::size_t>(property)]; }
  using Cards = std::unordered_map<std::int64_t, const NastranCard*>;

  static void add_card(const NastranCard& card, Cards& cards);
  /// Null if the deck has none.
  const NastranCard* card_of(const NastranElement& element, Family family) const;
  int missing(const NastranElement& element, Family family);
  std::string unique_name(const std::string& wanted);
  std::string name_of_card(const NastranCard& card);
  int add(fem::ImportedProperty property, const More& more);

  int solid(const NastranElement& element);
  int line(const NastranElement& element, Family family);
  void set_material(std::int64_t material, NastranMaterials::Use use, const NastranCard& card,
                    fem::ImportedProperty& out);
  int shell(const NastranElement& element, const std::vector<Eigen::Vector3d>& nodes);

  fem::ImportedProperty convert_solid(const NastranCard& card);
  Shell convert_pshell(const NastranCard& card);
  Shell convert_old_shell(const NastranCard& card);
  Shell convert_pcomp(const NastranCard& card);
  std::vector<fem::ImportedLayer> read_layers(const NastranCard& card, bool& is_isotropic);
  double thickness_of(const NastranElement& element, const Shell& shell,
                      const std::vector<Eigen::Vector3d>& nodes);
  Direction shell_direction(const NastranElement& element, const Shell& shell,
                            const std::vector<Eigen::Vector3d>& nodes) const;

  const NastranBulk* bulk_;
  const NastranNames* names_;
  const NastranCoordinates* coordinates_;
  NastranMaterials* materials_;
  NastranNotes* notes_;
  std::map<Family, Cards> cards_;
  std::map<std::string, Cards> old_cards_;
  std::map<const NastranCard*, std::string> card_names_;
  std::set<std::string> used_names_;
  std::map<const NastranCard*, int> plain_;                      // solids and lines
  std::map<std::pair<Family, std::int64_t>, int> without_card_;  // by number
  std::map<const NastranCard*, Shell> shells_;
  std::map<ShellKey, int> shell_variants_;
  std::vector<fem::ImportedProperty> properties_;
  std::vector<More> more_;
};

}  // namespace buckens::mesh_io
