// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "buckens/base/dimension.h"

namespace buckens::base {

/// Which numbers a field takes.
enum class Range { any, positive, non_negative, fraction /* 0 … 1 */, poisson /* −1 … ½ */ };

/// What a field list says about a field besides its member.
struct FieldNote {
  std::string name;  ///< key in the model file; empty: the value replaces the struct
  std::string doc;   ///< one sentence
  Dimension dimension;
  Range range = Range::any;
  bool is_required = false;
  bool is_shorthand = false;   ///< a struct given as a single value sets this field
  bool is_switch = false;      ///< a boolean written on | off
  bool any_dimension = false;  ///< any unit is accepted
  std::string example;         ///< YAML, for messages and the reference page
  std::string standard;  ///< what happens if left out, where the member's default says too little
  std::string word;      ///< accepted instead of the number, which is then 0
};

// Lists of fields do these a thousand times: out of line, sources that visit all fields take half
// of the time to compile.
[[gnu::noinline]] inline FieldNote note_of(const char* name, const char* doc) {
  FieldNote out;
  out.name = name;
  out.doc = doc;
  return out;
}
[[gnu::noinline]] inline void set_text(std::string& text, const char* value) { text = value; }

/// One line of a field list: a key of the model file, the member it fills, and the rules.
///
/// A spec carries its field list as the member template `fields(visit)`; the reader, the schema and
/// the reference page all visit the same list.
template <class T>
struct Field {
  T& member;
  FieldNote note;

  // A chain of these says the rules of one temporary, which is not moved from link to link.
  Field&& in(Dimension dimension) && { return note.dimension = dimension, std::move(*this); }
  Field&& required() && { return note.is_required = true, std::move(*this); }
  Field&& positive() && { return note.range = Range::positive, std::move(*this); }
  Field&& non_negative() && { return note.range = Range::non_negative, std::move(*this); }
  Field&& within(Range range) && { return note.range = range, std::move(*this); }
  Field&& shorthand() && { return note.is_shorthand = true, std::move(*this); }
  Field&& of_any_dimension() && { return note.any_dimension = true, std::move(*this); }
  Field&& on_off() && { return note.is_switch = true, std::move(*this); }
  Field&& like(std::string example) && {
    return note.example = std::move(example), std::move(*this);
  }
  Field&& like(const char* example) && { return set_text(note.example, example), std::move(*this); }
  Field&& otherwise(std::string standard) && {
    return note.standard = std::move(standard), std::move(*this);
  }
  Field&& otherwise(const char* standard) && {
    return set_text(note.standard, standard), std::move(*this);
  }
  Field&& or_word(std::string word) && { return note.word = std::move(word), std::move(*this); }
};

template <class T>
Field<T> field(std::string name, T& member, std::string doc) {
  return {
      member,
      {std::move(name), std::move(doc), {}, Range::any, false, false, false, false, {}, {}, {}}};
}

template <class T>
Field<T> field(const char* name, T& member, const char* doc) {
  return {member, note_of(name, doc)};
}

/// The value replaces the struct: a variant's alternatives become keys next to the other
/// fields (exactly one of them), any other member is the struct's whole content.
template <class T>
Field<T> inlined(T& member, std::string doc) {
  return field<T>("", member, std::move(doc));
}

/// Something given either by the name of an entry elsewhere or written out in place.
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
