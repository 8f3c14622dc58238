// SPDX-License-Identifier: Apache-2.0
#include "buckens/base/field.h"

#include <mutex>
#include <set>
#include <utility>

namespace buckens::base {

Field&& Field::in(Dimension dimension) && {
  note.dimension = dimension;
  return std::move(*this);
}
Field&& Field::required() && {
  note.is_required = true;
  return std::move(*this);
}
Field&& Field::positive() && {
  note.range = Range::positive;
  return std::move(*this);
}
Field&& Field::non_negative() && {
  note.range = Range::non_negative;
  return std::move(*this);
}
Field&& Field::within(Range range) && {
  note.range = range;
  return std::move(*this);
}
Field&& Field::shorthand() && {
  note.is_shorthand = true;
  return std::move(*this);
}
Field&& Field::of_any_dimension() && {
  note.any_dimension = true;
  return std::move(*this);
}
Field&& Field::on_off() && {
  note.is_switch = true;
  return std::move(*this);
}
Field&& Field::like(const char* example) && {
  note.example = example;
  return std::move(*this);
}
Field&& Field::otherwise(const char* standard) && {
  note.standard = standard;
  return std::move(*this);
}
Field&& Field::or_word(const char* word) && {
  note.word = word;
  return std::move(*this);
}

const char* lasting_text(const std::string& text) {
  static std::mutex guard;
  static std::set<std::string> kept;
  const std::lock_guard lock(guard);
  return kept.insert(text).first->c_str();
}

Field field_of(Member member, const char* name, const char* doc) {
  Field out;
  out.member = member;
  out.note.name = name;
  out.note.doc = doc;
  return out;
}

}  // namespace buckens::base
