// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "buckens/fem/mesh/imported_mesh.h"
#include "buckens/mesh_io/nastran/bulk.h"

namespace buckens::mesh_io {

/// Mass that carries nothing: NSM of properties, and the cards NSM, NSM1, NSML and NSML1 that the
/// case control chooses. It becomes point masses at the corners of elements, equal shares each.
class NastranNonstructuralMass {
 public:
  /// @param has_control without it all cards count, with it those of `set`
  /// @throws InputError for cards that cannot be read
  NastranNonstructuralMass(const NastranBulk& bulk, bool has_control,
                           const std::optional<std::int64_t>& set, NastranNotes& notes);

  /// An element with its corners.
  /// @param size area or length
  /// @param density of its property, mass per area or length
  void add(const NastranElement& element, std::span<const int> corners, double size,
           double density);

  /// Point masses in order of nodes. @throws InputError for cards that name no element
  void finish(fem::ImportedMesh& mesh);

 private:
  enum class Family { shell, bar, beam, rod, tube, conrod, element, none };

  /// One value and whom it belongs to.
  struct Share {
    const NastranCard* card = nullptr;
    Family family = Family::none;
    bool all = false;
    std::set<std::int64_t> ids;  ///< of properties, or of elements
    double value = 0;
    bool is_total = false;  ///< to be spread over all of them; else per area or length
  };

  struct Member {
    std::int64_t id = 0, property = 0;
    Family family = Family::none;
    double size = 0;
    std::vector<int> corners;
  };

  static Family family_of(const NastranCard& card);
  static Family family_of(NastranElementKind kind);
  std::set<std::int64_t> chosen_sets(bool has_control,
                                     const std::optional<std::int64_t>& set) const;
  void read_pairs(const NastranCard& card, bool is_total);
  void read_list(const NastranCard& card, bool is_total);
  void spread(const Share& share);
  void give(std::span<const int> corners, double mass);

  const NastranBulk& bulk_;
  NastranNotes& notes_;
  std::vector<Share> shares_;
  std::vector<Member> members_;  // only if there are shares
  std::map<std::pair<Family, std::int64_t>, std::vector<const Member*>> places_;
  std::map<int, double> masses_;  // by node
};

}  // namespace buckens::mesh_io
