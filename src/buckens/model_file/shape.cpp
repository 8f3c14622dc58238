// SPDX-License-Identifier: Apache-2.0
#include "buckens/model_file/shape.h"

#include <memory>
#include <stdexcept>

#include <fmt/format.h>

#include "buckens/base/member_types.h"
#include "buckens/model/spec/description_member.h"
#include "buckens/model_file/table.h"

namespace buckens::model_file {

namespace {

using base::Member;
using base::MemberType;
using Form = MemberType::Form;

Shape shape_of(const MemberType& type);

std::string default_choice(const Member& member) {
  return member.type->choices()[member.type->index(member.at)];
}

/// Default of a member as the file would write it, "" where there is none worth printing.
std::string default_text(const Member& member, const base::FieldNote& note) {
  if (note.is_required) return "";
  if (!note.standard.empty()) return std::string(note.standard);
  if (member.type->form() == Form::choice) return default_choice(member);
  if (const auto* truth = member.get<bool>()) {
    if (note.is_switch) return *truth ? "on" : "off";
    return *truth ? "true" : "false";
  }
  if (const auto* number = member.get<double>()) return fmt::format("{:g}", *number);
  if (const auto* number = member.get<int>()) return fmt::to_string(*number);
  if (const auto* text = member.get<std::string>()) return *text;
  if (const auto* frames = member.get<body::FrameDivision>()) return fmt::to_string(frames->count);
  if (member.get<model::DeflectionBase>() != nullptr) return model::DeflectionBase::kWords[0];
  if (const auto* v = member.get<Eigen::Vector3d>()) {
    return fmt::format("[{:g}, {:g}, {:g}]", v->x(), v->y(), v->z());
  }
  return "";
}

Shape simple(Shape::Kind kind) {
  Shape out;
  out.kind = kind;
  return out;
}

Shape list_of(Shape element, int count) {
  Shape out = simple(Shape::Kind::list);
  out.count = count;
  out.element.push_back(std::move(element));
  return out;
}

/// A law of time, with what else the value may be.
Shape law(std::vector<std::string> others) {
  Shape out = simple(Shape::Kind::time_law);
  out.element.push_back(shape_of(base::type_of<TableLawSpec>()));
  out.choices = std::move(others);
  return out;
}

Shape value_shape(const MemberType& type) {
  if (type.is<double>()) return simple(Shape::Kind::quantity);
  if (type.is<int>()) return simple(Shape::Kind::integer);
  if (type.is<bool>()) return simple(Shape::Kind::truth);
  if (type.is<std::string>()) return simple(Shape::Kind::text);
  if (type.is<Eigen::Vector3d>()) return list_of(simple(Shape::Kind::quantity), 3);
  if (type.is<base::TimeLaw>()) return law({});
  if (type.is<base::SignalLaw>()) return law({"or of signals"});
  if (type.is<base::Characteristic>()) return law({"or characteristic"});
  if (type.is<model::PositionLaw>()) return simple(Shape::Kind::position_law);
  if (type.is<base::MarkerRef>()) return simple(Shape::Kind::marker);
  Shape out;
  if (type.is<body::FrameDivision>()) {
    out.kind = Shape::Kind::frame_division;
    out.choices = {body::FrameDivision::kPerElement};
  } else if (type.is<model::DeflectionBase>()) {
    out.kind = Shape::Kind::word_or_marker;
    out.choices = {model::DeflectionBase::kWords.begin(), model::DeflectionBase::kWords.end()};
  } else {
    throw std::logic_error(fmt::format("no shape for members of type {}", type.id().name()));
  }
  return out;
}

Shape record_shape(const MemberType& type) {
  Shape out = simple(Shape::Kind::record);
  out.type = type.id();
  const std::shared_ptr<void> record = type.make();
  for (const base::Field& field : type.fields(record.get())) {
    if (field.member.type->form() != Form::variant) {
      out.fields.push_back(
          {field.note, shape_of(*field.member.type), default_text(field.member, field.note)});
      continue;
    }
    for (const base::AlternativeNote& one : field.member.type->alternatives()) {
      base::FieldNote note;
      note.name = one.key;
      note.doc = one.doc;
      out.alternatives.push_back({note, shape_of(*one.type), ""});
    }
  }
  return out;
}

Shape shape_of(const MemberType& type) {
  switch (type.form()) {
    case Form::value:
      return value_shape(type);
    case Form::choice: {
      Shape out = simple(Shape::Kind::choice);
      out.choices = type.choices();
      return out;
    }
    case Form::optional:
      return shape_of(type.part_type());
    case Form::reference: {
      Shape out = simple(Shape::Kind::reference);
      out.element.push_back(shape_of(type.part_type()));
      return out;
    }
    case Form::array:
      return list_of(shape_of(type.part_type()), static_cast<int>(type.size(nullptr)));
    case Form::list: {
      Shape out = list_of(shape_of(type.part_type()), -1);
      if (out.element[0].kind == Shape::Kind::record && type.part_type().has_name()) {
        out.kind = Shape::Kind::named;
      }
      return out;
    }
    case Form::variant:
      break;
    case Form::record:
      return record_shape(type);
  }
  throw std::logic_error("a variant has no shape outside of a record");
}

}  // namespace

const FieldShape* Shape::shorthand() const {
  for (const FieldShape& field : fields) {
    if (field.note.is_shorthand || field.note.name.empty()) return &field;
  }
  return nullptr;
}

const FieldShape* Shape::list_shorthand() const {
  const FieldShape* const first = shorthand();
  for (const FieldShape& field : fields) {
    if (field.note.is_shorthand && &field != first && field.shape.kind == Kind::list) return &field;
  }
  return nullptr;
}

const FieldShape* Shape::find(const std::string& key) const {
  for (const auto* list : {&fields, &alternatives}) {
    for (const FieldShape& field : *list) {
      if (field.note.name == key) return &field;
    }
  }
  return nullptr;
}

std::vector<std::string> Shape::keys() const {
  std::vector<std::string> out;
  for (const auto* list : {&alternatives, &fields}) {
    for (const FieldShape& field : *list) {
      if (!field.note.name.empty()) out.emplace_back(field.note.name);
    }
  }
  return out;
}

const Shape& model_file_shape() {
  static const Shape shape = [] {
    model::ModelDescription empty;
    return shape_of(*model::description_member(empty).type);
  }();
  return shape;
}

}  // namespace buckens::model_file
