// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/check/check_description.h"

#include <cstddef>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/field.h"
#include "buckens/model/check/marker_names.h"
#include "buckens/model/check/range.h"
#include "buckens/model/check/record_rules.h"
#include "buckens/model/spec/description_member.h"

namespace buckens::model {

namespace {

using Form = base::MemberType::Form;

/// The numbers of a field, empty for any other kind of field.
std::vector<double> numbers_in(const base::Member& member) {
  if (const double* number = member.get<double>()) return {*number};
  if (const int* number = member.get<int>()) return {static_cast<double>(*number)};
  if (const bool* truth = member.get<bool>()) return {*truth ? 1.0 : 0.0};
  if (const auto* vector = member.get<Eigen::Vector3d>()) {
    return {vector->x(), vector->y(), vector->z()};
  }
  std::vector<double> out;
  if (member.type->form() != Form::array) return out;
  for (const base::Member& entry : member.parts()) {
    for (const double number : numbers_in(entry)) out.push_back(number);
  }
  return out;
}

/// Walks through a description in the order of the model file up to the first finding.
class Walker {
 public:
  explicit Walker(const ModelDescription& description) : description_(description) {}

  Found found;
  SourceLocation where;  ///< of the innermost spec around the finding that knows its place

  /// @param is_given whether the record was written down; false where that cannot be known. Then a
  ///        number that stays at its default counts as not given, required or not.
  void record(const std::string& path, const base::Member& spec, bool is_given = true) {
    const SourceLocation outer = where;
    if (const SourceLocation* own = spec.type->where(spec.at)) {
      if (!own->empty()) where = *own;
    }
    const std::shared_ptr<void> fresh = spec.type->make();
    const std::vector<base::Field> defaults = spec.type->fields(fresh.get());
    std::size_t index = 0;
    for (const base::Field& field : spec.fields()) {
      const std::vector<double> standard = numbers_in(defaults[index++].member);
      const bool is_required = is_given && field.note.is_required;
      if (found || (!is_required && !standard.empty() && standard == numbers_in(field.member))) {
        continue;
      }
      is_given_ = is_given;
      value(join_path(path, field.note.name), field.note, field.member);
    }
    note(path, record_problem(spec, description_));
    if (!found) where = outer;
  }

 private:
  void note(const std::string& path, const Found& one) {
    if (!found) found = under(path, one);
  }

  void number(const std::string& path, const base::FieldNote& field, double member) {
    // A word such as `auto` stands for zero.
    if (!field.word.empty() && member == 0.0) return;
    if (const auto rule = broken_rule(field, member)) {
      note(path, Finding{"", refusal(fmt::format("{:g}", member), *rule)});
    }
  }

  void value(const std::string& path, const base::FieldNote& field, const base::Member& member) {
    if (found) return;
    switch (member.type->form()) {
      case Form::value:
        return simple_value(path, field, member);
      case Form::choice:
        return;
      case Form::record:
        return record(path, member, field.is_required);
      case Form::optional:
        for (const base::Member& part : member.parts()) entry(path, field, part);
        return;
      case Form::reference:
        if (field.is_required || !member.type->name(member.at)->empty()) {
          record(path, member.parts().front());
        }
        return;
      case Form::variant: {
        // The alternative is written down if the record around it is.
        const std::string key = member.type->alternatives()[member.type->index(member.at)].key;
        return record(join_path(path, key), member.parts().front(), is_given_);
      }
      case Form::array:
      case Form::list:
        return items(path, field, member.parts());
    }
  }

  void simple_value(const std::string& path, const base::FieldNote& field,
                    const base::Member& member) {
    if (const auto* real = member.get<double>()) number(path, field, *real);
    if (const auto* integer = member.get<int>()) number(path, field, *integer);
    if (const auto* law = member.get<base::SignalLaw>()) {
      if (const std::optional<double> constant = law->number()) number(path, field, *constant);
    }
    if (const auto* vector = member.get<Eigen::Vector3d>()) {
      for (int i = 0; i < 3; ++i) number(fmt::format("{}.{}", path, i), field, (*vector)[i]);
    }
    if (const auto* marker = member.get<base::MarkerRef>()) look_for(path, *marker);
    const auto* deflection = member.get<DeflectionBase>();
    if (deflection != nullptr && *deflection == DeflectionBase::other) {
      look_for(path, deflection->marker);
    }
  }

  void look_for(const std::string& path, const base::MarkerRef& marker) {
    if (found || marker.body.empty()) return;  // not given
    note(path, marker_problem(marker, description_, bodies_));
    if (found && !marker.where.empty()) where = marker.where;
  }

  void items(const std::string& path, const base::FieldNote& field,
             const std::vector<base::Member>& members) {
    for (std::size_t i = 0; i < members.size() && !found; ++i) {
      const base::Member& item = members[i];
      const bool is_record = item.type->form() == Form::record;
      if (is_record && item.type->has_name()) {
        record(join_path(path, *item.type->name(item.at)), item);
      } else {
        entry(fmt::format("{}.{}", path, i), field, item);
      }
    }
  }

  /// A value that somebody wrote down.
  void entry(const std::string& path, const base::FieldNote& field, const base::Member& member) {
    if (found) return;
    switch (member.type->form()) {
      case Form::reference:
        return record(path, member.parts().front());
      case Form::record:
        return record(path, member);
      default:
        return value(path, field, member);
    }
  }

  const ModelDescription& description_;
  base::NameIndex bodies_;
  bool is_given_ = true;
};

Walker walked(const ModelDescription& description) {
  Walker walker(description);
  walker.record("", description_member(description));
  return walker;
}

}  // namespace

Found check(const ModelDescription& description) { return walked(description).found; }

void require_sound(const ModelDescription& description) {
  const Walker walker = walked(description);
  if (!walker.found) return;
  const std::string& path = walker.found->field_path;
  throw InputError(walker.where, path.empty() ? walker.found->text
                                              : fmt::format("{}: {}", path, walker.found->text));
}

}  // namespace buckens::model
