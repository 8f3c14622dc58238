// SPDX-License-Identifier: Apache-2.0
#include "buckens/base/field.h"

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
Field&& Field::like(std::string example) && {
  note.example = std::move(example);
  return std::move(*this);
}
Field&& Field::like(const char* example) && {
  note.example = example;
  return std::move(*this);
}
Field&& Field::otherwise(std::string standard) && {
  note.standard = std::move(standard);
  return std::move(*this);
}
Field&& Field::otherwise(const char* standard) && {
  note.standard = standard;
  return std::move(*this);
}
Field&& Field::or_word(std::string word) && {
  note.word = std::move(word);
  return std::move(*this);
}

Field field_of(Member member, const char* name, const char* doc) {
  return field_of(member, std::string(name), std::string(doc));
}

Field field_of(Member member, std::string name, std::string doc) {
  Field out;
  out.member = member;
  out.note.name = std::move(name);
  out.note.doc = std::move(doc);
  return out;
}

}  // namespace buckens::base
