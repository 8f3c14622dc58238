// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "buckens/base/dimension.h"
#include "buckens/base/member.h"

namespace buckens::base {

/// Numbers that a field accepts.
enum class Range { any, positive, non_negative, fraction /* 0 … 1 */, poisson /* −1 … ½ */ };

/// Properties of a field besides its member. The texts outlive the program's work: they are
/// literals or lasting_text.
struct FieldNote {
  std::string_view name;  ///< key in the model file; empty: the value replaces the struct
  std::string_view doc;   ///< one sentence
  Dimension dimension;
  Range range = Range::any;
  bool is_required = false;
  bool is_shorthand = false;   ///< a struct given as a single value sets this field
  bool is_switch = false;      ///< a boolean written on | off
  bool any_dimension = false;  ///< any unit is accepted
  std::string_view example;    ///< YAML, for messages and the reference page
  std::string_view
      standard;           ///< what happens if left out, where the member's default says too little
  std::string_view word;  ///< accepted instead of the number, which is then 0
};

/// One line of a field list: a key of the model file, the member it fills, and the rules.
///
/// A spec carries its field list as the member template `fields(visit)`; the reader, the schema and
/// the reference page all visit the same list.
struct Field {
  Member member;
  FieldNote note;

  // A chain of these says the rules of one temporary, which is not moved from link to link.
  Field&& in(Dimension dimension) &&;
  Field&& required() &&;
  Field&& positive() &&;
  Field&& non_negative() &&;
  Field&& within(Range range) &&;
  Field&& shorthand() &&;
  Field&& of_any_dimension() &&;
  Field&& on_off() &&;
  Field&& like(const char* example) &&;
  Field&& otherwise(const char* standard) &&;
  Field&& or_word(const char* word) &&;
};

/// The text, kept until the program ends. For texts that are put together from a few parts, not for
/// any that come from files.
const char* lasting_text(const std::string& text);

Field field_of(Member member, const char* name, const char* doc);

template <class T>
Field field(const char* name, T& member, const char* doc) {
  return field_of(member_of(member), name, doc);
}

/// The value replaces the struct: the alternatives of a variant become keys next to the other
/// fields (exactly one of them); any other member is the whole content of the struct.
template <class T>
Field inlined(T& member, const char* doc) {
  return field_of(member_of(member), "", doc);
}

/// A value given either by the name of an entry elsewhere or in place.
template <class T>
struct Reference {
  std::string name;  ///< empty if written in place
  T value;           ///< complete in both cases

  const T& operator*() const { return value; }
  const T* operator->() const { return &value; }
};

/// Pointer to the entry called `name`, or null. Entries have a member `name`.
template <class T>
const T* find_named(const std::vector<T>& list, const std::string& name) {
  for (const T& entry : list) {
    if (entry.name == name) return &entry;
  }
  return nullptr;
}

}  // namespace buckens::base
