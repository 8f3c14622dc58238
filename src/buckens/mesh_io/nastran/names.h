// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace buckens::mesh_io {

/// Names that pre-processors write into the comments of a deck.
///
/// Understood are
///     $HMNAME PROP                   3"housing" 4          (also COMP, MAT)
///     $ANSA_NAME_COMMENT;3;PSHELL;housing;;NO;NO;          (also $ANSA_NAME; other kinds)
///     $ Femap Property 3 : housing                         ("Femap with NX Nastran", Material)
class NastranNames {
 public:
  /// Reads a comment line, starting at its dollar sign. Others than the above are ignored.
  void add_comment(std::string_view line);

  /// Name of a property with this number, "" if none was given. Names of components are used if the
  /// deck names no properties: older decks give both the same numbers.
  std::string property(std::int64_t id) const;
  /// Name of a material, "" if none was given.
  std::string material(std::int64_t id) const;
  /// Name of a set, "" if none was given.
  std::string set(std::int64_t id) const;

 private:
  enum class Kind { property, component, material, set };

  void add_hypermesh(std::string_view rest);
  void add_ansa(std::string_view rest);
  void add_femap(std::string_view rest);
  void add(Kind kind, std::string_view id, std::string_view name);

  std::map<Kind, std::map<std::int64_t, std::string>> names_;
};

}  // namespace buckens::mesh_io
