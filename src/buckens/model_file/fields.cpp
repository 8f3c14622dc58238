// SPDX-License-Identifier: Apache-2.0
#include "buckens/model_file/fields.h"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>

#include "buckens/base/field.h"
#include "buckens/base/marker_ref.h"
#include "buckens/base/nearest.h"
#include "buckens/model/check/marker_names.h"
#include "buckens/model/check/record_rules.h"
#include "buckens/model_file/names.h"
#include "buckens/model_file/number_look_alikes.h"
#include "buckens/model_file/table.h"

namespace buckens::model_file {

namespace {

using base::Field;
using base::FieldNote;
using base::Member;
using Form = base::MemberType::Form;

void read_value(const ReadPlace& place, const FieldNote& note, ReadContext& context,
                const Member& out);

ReadPlace inside(const ReadPlace& place, const YamlNode& node, std::string_view key) {
  return {node, join_path(place.path, key)};
}

/// The keys of a record, including those of its alternatives.
std::vector<std::string_view> keys_of(const std::vector<Field>& fields) {
  std::vector<std::string_view> out;
  for (const Field& field : fields) {
    if (field.member.type->form() == Form::variant) {
      for (const auto& alternative : field.member.type->alternatives()) {
        out.push_back(alternative.key);
      }
    } else if (!field.note.name.empty()) {
      out.push_back(field.note.name);
    }
  }
  return out;
}

bool takes_list(const base::MemberType& type) {
  if (type.form() == Form::optional) return takes_list(type.part_type());
  return type.form() == Form::array || type.form() == Form::list || type.is<Eigen::Vector3d>();
}

/// Reads the field that may abbreviate its whole record. Of two, one takes lists.
/// @returns whether there is one
bool read_shorthand(const ReadPlace& place, ReadContext& context,
                    const std::vector<Field>& fields) {
  const auto num_short = std::count_if(fields.begin(), fields.end(),
                                       [](const Field& field) { return field.note.is_shorthand; });
  bool is_found = false;
  for (const Field& field : fields) {
    if (field.member.type->form() == Form::variant) continue;
    const bool is_whole_content = field.note.name.empty();
    const bool is_short =
        field.note.is_shorthand && !place.node.is_map() &&
        (num_short == 1 || takes_list(*field.member.type) == place.node.is_list());
    if (!is_whole_content && !is_short) continue;
    read_value(place, field.note, context, field.member);
    is_found = true;
  }
  return is_found;
}

void read_alternative(const ReadPlace& place, ReadContext& context, const Member& out) {
  const std::vector<base::AlternativeNote> known = out.type->alternatives();
  int count = 0;
  std::vector<std::string_view> names;
  for (std::size_t k = 0; k < known.size(); ++k) {
    names.push_back(known[k].key);
    const YamlNode* node = place.node.find(known[k].key);
    if (node == nullptr || ++count > 1) continue;
    read_record(inside(place, *node, known[k].key), context, out.type->add(out.at, k));
  }
  if (count == 1) return;
  const char* what = count == 0 ? "one of these keys is missing" : "only one of these keys can be";
  fail(place, fmt::format("{}: {}", what, fmt::join(names, ", ")));
}

void read_field(const ReadPlace& place, ReadContext& context, const Field& field) {
  const FieldNote& note = field.note;
  if (field.member.type->form() == Form::variant) {
    read_alternative(place, context, field.member);
  } else if (const YamlNode* node = place.node.find(note.name)) {
    read_value(inside(place, *node, note.name), note, context, field.member);
  } else if (note.is_required) {
    const std::string example =
        note.example.empty() ? "" : fmt::format(", for example {}: {}", note.name, note.example);
    fail(place, fmt::format("the key \"{}\" is missing; add it{}", note.name, example));
  }
}

/// Makes a named entry known to what follows.
void finish(const Member& entry, const ReadPlace& place, ReadContext& context) {
  if (auto* parameter = entry.get<model::ParameterSpec>()) finish_entry(*parameter, place, context);
  if (auto* body = entry.get<body::BodySpec>()) finish_entry(*body, place, context);
  if (auto* load = entry.get<loads::LoadSpec>()) finish_entry(*load, place, context);
  if (auto* start = entry.get<model::InitialBodySpec>()) finish_entry(*start, place, context);
}

/// Reads {name: entry, ...}. An entry is in the list when it is complete.
void read_named(const ReadPlace& place, ReadContext& context, const Member& out) {
  if (!place.node.is_map()) {
    fail(place,
         fmt::format("expected a map of names to entries, found {}", place.node.description()));
  }
  const base::MemberType& type = out.type->part_type();
  for (const YamlEntry& given : place.node.entries) {
    const std::string path = join_path(place.path, given.key);
    if (!type.has_foreign_name()) check_name(given, path);
    const std::shared_ptr<void> made = type.make();
    const Member entry{made.get(), &type};
    *type.name(entry.at) = given.key;
    read_record({given.value, path}, context, entry);
    if (SourceLocation* where = type.where(entry.at)) *where = given.where;
    finish(entry, {given.value, path}, context);
    out.type->take(out.at, entry.at);
  }
}

/// Checks that a list is given, and how many items it has; `count` < 0 accepts any number.
void check_items(const ReadPlace& place, const FieldNote& note, int count) {
  const auto given = static_cast<int>(place.node.items.size());
  if (place.node.is_list() && count >= 0 && given > count) {
    if (const auto found = cut_item_problem(place.node, count)) fail(place, *found);
  }
  if (place.node.is_list() && (count < 0 || given == count)) return;
  const std::string number = count < 0 ? "" : fmt::format(" of {} values", count);
  const std::string example = note.example.empty() ? "" : fmt::format(" such as {}", note.example);
  const std::string what =
      place.node.is_list() ? fmt::format("a list of {} values", given) : place.node.description();
  fail(place, fmt::format("expected a list{1}{2}, found {0}", what, number, example));
}

ReadPlace item_at(const ReadPlace& place, std::size_t k) {
  return {place.node.items[k], fmt::format("{}.{}", place.path, k)};
}

void read_list(const ReadPlace& place, const FieldNote& note, ReadContext& context,
               const Member& out) {
  const base::MemberType& items = out.type->part_type();
  if (items.form() == Form::record && items.has_name()) return read_named(place, context, out);
  // A single text stands for a list of one.
  if (items.is<std::string>() && place.node.is_scalar()) {
    return read_value(place, note, context, out.type->add(out.at));
  }
  out.type->clear(out.at);
  check_items(place, note, -1);
  for (std::size_t k = 0; k < place.node.items.size(); ++k) {
    read_value(item_at(place, k), note, context, out.type->add(out.at));
  }
}

template <class Spec>
void take_definition(const Member& reference, const FieldNote& note, const ReadPlace& place,
                     const std::vector<Spec>& known) {
  auto* out = reference.get<base::Reference<Spec>>();
  if (out == nullptr) return;
  const Spec* found = base::find_named(known, out->name);
  if (found == nullptr) fail_unknown(place, note.name, out->name, model::names_of(known));
  out->value = *found;
}

void read_reference(const ReadPlace& place, const FieldNote& note, ReadContext& context,
                    const Member& out) {
  if (!place.node.is_scalar()) return read_record(place, context, out.parts().front());
  *out.type->name(out.at) = place.node.text;
  take_definition(out, note, place, context.model->materials);
  take_definition(out, note, place, context.model->sections);
}

Eigen::Vector3d read_vector(const ReadPlace& place, const FieldNote& note,
                            const ReadContext& context) {
  check_items(place, note, 3);
  Eigen::Vector3d out;
  for (int i = 0; i < 3; ++i) {
    out[i] = read_quantity(item_at(place, static_cast<std::size_t>(i)), note, context);
  }
  return out;
}

/// Fills the member with what `read` returns, if it is of that type.
template <class Read>
bool fills(const Member& member, const Read& read) {
  auto* out = member.get<decltype(read())>();
  if (out != nullptr) *out = read();
  return out != nullptr;
}

/// Reads what is no structure of other members.
void read_simple(const ReadPlace& place, const FieldNote& note, const ReadContext& context,
                 const Member& out) {
  const bool is_read = fills(out, [&] { return read_quantity(place, note, context); }) ||
                       fills(out, [&] { return read_integer(place, note, context); }) ||
                       fills(out, [&] { return read_frames(place, note, context); }) ||
                       fills(out, [&] { return read_truth(place, note); }) ||
                       fills(out, [&] { return read_text(place); }) ||
                       fills(out, [&] { return read_vector(place, note, context); }) ||
                       fills(out, [&] { return read_time_law(place, note, context); }) ||
                       fills(out, [&] { return read_signal_law(place, note, context); }) ||
                       fills(out, [&] { return read_characteristic(place, note, context); }) ||
                       fills(out, [&] { return read_position_law(place, note, context); }) ||
                       fills(out, [&] { return read_marker(place, context); }) ||
                       fills(out, [&] { return read_deflection_base(place, context); });
  if (is_read) return;
  throw std::logic_error(fmt::format("no reader for members of type {}", out.type->id().name()));
}

void read_value(const ReadPlace& place, const FieldNote& note, ReadContext& context,
                const Member& out) {
  switch (out.type->form()) {
    case Form::value:
      return read_simple(place, note, context, out);
    case Form::choice:
      return out.type->choose(out.at, read_choice(place, out.type->choices(), out.type->planned()));
    case Form::optional:
      return read_value(place, note, context, out.type->add(out.at));
    case Form::reference:
      return read_reference(place, note, context, out);
    case Form::list:
      return read_list(place, note, context, out);
    case Form::array: {
      const std::vector<Member> items = out.parts();
      check_items(place, note, static_cast<int>(items.size()));
      for (std::size_t k = 0; k < items.size(); ++k) {
        read_value(item_at(place, k), note, context, items[k]);
      }
      return;
    }
    case Form::variant:
      return read_alternative(place, context, out);
    case Form::record:
      return read_record(place, context, out);
  }
}

}  // namespace

void read_record(const ReadPlace& place, ReadContext& context, const Member& record) {
  if (SourceLocation* where = record.type->where(record.at)) *where = place.node.where;
  const std::vector<Field> fields = record.fields();
  if (!read_shorthand(place, context, fields)) {
    const std::vector<std::string_view> known = keys_of(fields);
    if (!place.node.is_map()) {
      fail(place, fmt::format("expected a map with the keys {1}, found {0}",
                              place.node.description(), fmt::join(known, ", ")));
    }
    check_keys(place, known);
    for (const Field& field : fields) read_field(place, context, field);
  }
  if (const auto* table = record.get<TableLawSpec>()) fail_if_found(problem(*table), place);
  fail_if_found(model::written_problem(record, *context.model), place);
}

}  // namespace buckens::model_file
