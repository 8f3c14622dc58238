// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <concepts>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>

#include "buckens/base/field.h"
#include "buckens/base/field_types.h"
#include "buckens/base/marker_ref.h"
#include "buckens/base/nearest.h"
#include "buckens/model/check/marker_names.h"
#include "buckens/model/check/spec_findings.h"
#include "buckens/model_file/names.h"
#include "buckens/model_file/number_look_alikes.h"
#include "buckens/model_file/table.h"
#include "buckens/model_file/values.h"

/// Reading by field lists: any spec is filled from a YAML value by visiting its fields.
namespace buckens::model_file {

template <class T>
void read_value(const ReadPlace& place, const base::FieldNote& note, ReadContext& context, T& out);

/// Reads a map into a spec, or the single value that abbreviates it. Unknown and missing keys are
/// errors, and so is what model::problem() finds afterwards.
template <base::HasFields T>
void read_record(const ReadPlace& place, ReadContext& context, T& out);

/// The keys of a record, including those of its alternatives.
class KeyCollector {
 public:
  std::vector<std::string> keys;
  std::vector<std::string> alternatives;

  template <class T>
  void operator()(const base::Field<T>& field) {
    if constexpr (base::kIsVariant<T>) {
      for (const auto& alternative : base::alternatives_of<T>()) {
        keys.push_back(alternative.key);
        alternatives.push_back(alternative.key);
      }
    } else if (!field.note.name.empty()) {
      keys.push_back(field.note.name);
    }
  }
};

/// Reads the field that may abbreviate its whole record.
class ShorthandReader {
 public:
  ShorthandReader(const ReadPlace& place, ReadContext& context)
      : place_(place), context_(context) {}

  bool found = false;

  template <class T>
  void operator()(const base::Field<T>& field) {
    if constexpr (!base::kIsVariant<T>) {
      const bool is_whole_content = field.note.name.empty();
      const bool is_short = field.note.is_shorthand && !place_.node.is_map();
      if (!is_whole_content && !is_short) return;
      read_value(place_, field.note, context_, field.member);
      found = true;
    }
  }

 private:
  const ReadPlace& place_;
  ReadContext& context_;
};

/// Reads the fields of a map.
class RecordReader {
 public:
  RecordReader(const ReadPlace& place, ReadContext& context) : place_(place), context_(context) {}

  template <class T>
  void operator()(const base::Field<T>& field) {
    if constexpr (base::kIsVariant<T>) {
      read_alternative(field.member);
    } else if (const YamlNode* node = place_.node.find(field.note.name)) {
      read_value(inside(*node, field.note.name), field.note, context_, field.member);
    } else if (field.note.is_required) {
      const std::string example =
          field.note.example.empty()
              ? ""
              : fmt::format(", for example {}: {}", field.note.name, field.note.example);
      fail(place_, fmt::format("the key \"{}\" is missing; add it{}", field.note.name, example));
    }
  }

 private:
  ReadPlace inside(const YamlNode& node, const std::string& key) const {
    return {node, join_path(place_.path, key)};
  }

  template <class... Alternatives>
  void read_alternative(std::variant<Alternatives...>& out) {
    int count = 0;
    const auto try_one = [&]<class A>(A* /*type*/) {
      const YamlNode* node = place_.node.find(A::kKey);
      if (node == nullptr || ++count > 1) return;
      A alternative;
      read_record(inside(*node, A::kKey), context_, alternative);
      out = std::move(alternative);
    };
    (try_one(static_cast<Alternatives*>(nullptr)), ...);
    if (count == 1) return;
    const std::vector<std::string> names = {Alternatives::kKey...};
    const char* what =
        count == 0 ? "one of these keys is missing" : "only one of these keys can be";
    fail(place_, fmt::format("{}: {}", what, fmt::join(names, ", ")));
  }

  const ReadPlace& place_;
  ReadContext& context_;
};

template <base::HasFields T>
void read_record(const ReadPlace& place, ReadContext& context, T& out) {
  if constexpr (requires { out.where; }) out.where = place.node.where;
  ShorthandReader shorthand(place, context);
  out.fields(shorthand);
  if (!shorthand.found) {
    KeyCollector known;
    out.fields(known);
    if (!place.node.is_map()) {
      fail(place, fmt::format("expected a map with the keys {1}, found {0}",
                              place.node.description(), fmt::join(known.keys, ", ")));
    }
    check_keys(place, known.keys);
    RecordReader reader(place, context);
    out.fields(reader);
  }
  if constexpr (std::is_same_v<T, TableLawSpec>) {
    fail_if_found(problem(out), place);
  } else {
    fail_if_found(model::problem(out, *context.model), place);
  }
}

/// Reads {name: entry, ...}.
template <class T>
void read_named(const ReadPlace& place, ReadContext& context, std::vector<T>& out) {
  if (!place.node.is_map()) {
    fail(place,
         fmt::format("expected a map of names to entries, found {}", place.node.description()));
  }
  for (const YamlEntry& entry : place.node.entries) {
    const std::string path = join_path(place.path, entry.key);
    if constexpr (!base::kIsForeignNamed<T>) check_name(entry, path);
    T value;
    value.name = entry.key;
    read_record({entry.value, path}, context, value);
    value.where = entry.where;
    finish_entry(value, {entry.value, path}, context);
    out.push_back(std::move(value));
  }
}

/// Reads a list item by item; `count` < 0 accepts any number.
template <class Sequence>
void read_items(const ReadPlace& place, const base::FieldNote& note, ReadContext& context,
                int count, Sequence&& item) {
  const auto given = static_cast<int>(place.node.items.size());
  if (place.node.is_list() && count >= 0 && given > count) {
    if (const auto found = cut_item_problem(place.node, count)) fail(place, *found);
  }
  if (!place.node.is_list() || (count >= 0 && given != count)) {
    const std::string number = count < 0 ? "" : fmt::format(" of {} values", count);
    const std::string example = note.example.empty() ? "" : " such as " + note.example;
    const std::string what =
        place.node.is_list() ? fmt::format("a list of {} values", given) : place.node.description();
    fail(place, fmt::format("expected a list{1}{2}, found {0}", what, number, example));
  }
  for (int i = 0; i < given; ++i) {
    item(ReadPlace{place.node.items[static_cast<std::size_t>(i)],
                   fmt::format("{}.{}", place.path, i)},
         i);
  }
  static_cast<void>(context);
}

template <class T>
void read_reference(const ReadPlace& place, const base::FieldNote& note, ReadContext& context,
                    base::Reference<T>& out) {
  if (!place.node.is_scalar()) return read_record(place, context, out.value);
  out.name = place.node.text;
  const auto& known = definitions(context, &out.value);
  const T* found = base::find_named(known, out.name);
  if (found == nullptr) fail_unknown(place, note.name, out.name, model::names_of(known));
  out.value = *found;
}

template <class T>
void read_value(const ReadPlace& place, const base::FieldNote& note, ReadContext& context, T& out) {
  const auto read_item = [&](auto& items) {
    return [&](const ReadPlace& item, int i) {
      read_value(item, note, context, items[static_cast<std::size_t>(i)]);
    };
  };
  if constexpr (std::is_same_v<T, double>) {
    out = read_quantity(place, note, context);
  } else if constexpr (std::is_same_v<T, int>) {
    out = read_integer(place, note, context);
  } else if constexpr (std::is_same_v<T, body::FrameDivision>) {
    out = read_frames(place, note, context);
  } else if constexpr (std::is_same_v<T, bool>) {
    out = read_truth(place, note);
  } else if constexpr (std::is_same_v<T, std::string>) {
    out = read_text(place);
  } else if constexpr (std::is_enum_v<T>) {
    out = static_cast<T>(read_choice(place, base::choices_of<T>(), base::planned_of<T>()));
  } else if constexpr (std::is_same_v<T, Eigen::Vector3d>) {
    read_items(place, note, context, 3,
               [&](const ReadPlace& item, int i) { out[i] = read_quantity(item, note, context); });
  } else if constexpr (std::is_same_v<T, base::TimeLaw>) {
    out = read_time_law(place, note, context);
  } else if constexpr (std::is_same_v<T, base::SignalLaw>) {
    out = read_signal_law(place, note, context);
  } else if constexpr (std::is_same_v<T, base::Characteristic>) {
    out = read_characteristic(place, note, context);
  } else if constexpr (std::is_same_v<T, model::PositionLaw>) {
    out = read_position_law(place, note, context);
  } else if constexpr (std::is_same_v<T, base::MarkerRef>) {
    out = read_marker(place, context);
  } else if constexpr (std::is_same_v<T, model::DeflectionBase>) {
    out = read_deflection_base(place, context);
  } else if constexpr (base::kIsOptional<T>) {
    read_value(place, note, context, out.emplace());
  } else if constexpr (base::kIsArray<T>) {
    read_items(place, note, context, static_cast<int>(out.size()), read_item(out));
  } else if constexpr (base::kIsReference<T>) {
    read_reference(place, note, context, out);
  } else if constexpr (base::kIsNamedList<T>) {
    read_named(place, context, out);
  } else if constexpr (std::is_same_v<T, std::vector<std::string>>) {
    if (place.node.is_scalar()) return read_value(place, note, context, out.emplace_back());
    out.resize(place.node.items.size());
    read_items(place, note, context, -1, read_item(out));
  } else if constexpr (base::kIsVector<T>) {
    out.resize(place.node.items.size());
    read_items(place, note, context, -1, read_item(out));
  } else {
    read_record(place, context, out);
  }
}

}  // namespace buckens::model_file
