// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/check/check_description.h"

#include <cstddef>
#include <type_traits>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/field_types.h"
#include "buckens/base/visit_fields.h"
#include "buckens/model/check/marker_names.h"
#include "buckens/model/check/range.h"
#include "buckens/model/check/spec_findings.h"

namespace buckens::model {

namespace {

/// The numbers of a field, empty for any other kind of field.
template <class T>
std::vector<double> numbers_in(const T& member) {
  if constexpr (std::is_arithmetic_v<T>) {
    return {static_cast<double>(member)};
  } else if constexpr (std::is_same_v<T, Eigen::Vector3d>) {
    return {member.x(), member.y(), member.z()};
  } else if constexpr (base::kIsArray<T>) {
    std::vector<double> out;
    for (const auto& entry : member) {
      for (const double number : numbers_in(entry)) out.push_back(number);
    }
    return out;
  } else {
    return {};
  }
}

/// The numbers of a record that was left alone, field by field.
template <class T>
std::vector<std::vector<double>> defaults_of() {
  const T fresh{};
  std::vector<std::vector<double>> out;
  base::visit_fields(fresh, [&](const auto& field) { out.push_back(numbers_in(field.member)); });
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
  template <base::HasFields T>
  void record(const std::string& path, const T& spec, bool is_given = true) {
    const SourceLocation outer = where;
    if constexpr (requires { spec.where; }) {
      if (!spec.where.empty()) where = spec.where;
    }
    const std::vector<std::vector<double>> defaults = defaults_of<T>();
    std::size_t index = 0;
    base::visit_fields(spec, [&](const auto& field) {
      const std::vector<double>& standard = defaults[index++];
      const bool is_required = is_given && field.note.is_required;
      if (found || (!is_required && !standard.empty() && standard == numbers_in(field.member))) {
        return;
      }
      is_given_ = is_given;
      value(join_path(path, field.note.name), field.note, field.member);
    });
    note(path, problem(spec, description_));
    if constexpr (requires { problem_when_complete(spec, description_); }) {
      note(path, problem_when_complete(spec, description_));
    }
    if (!found) where = outer;
  }

 private:
  void note(const std::string& path, const Found& one) {
    if (!found) found = under(path, one);
  }

  void value(const std::string& path, const base::FieldNote& field, double member) {
    // A word such as `auto` stands for zero.
    if (!field.word.empty() && member == 0.0) return;
    if (const auto rule = broken_rule(field, member)) {
      note(path, Finding{"", refusal(fmt::format("{:g}", member), *rule)});
    }
  }

  template <class T>
  void value(const std::string& path, const base::FieldNote& field, const T& member) {
    if (found) return;
    if constexpr (std::is_same_v<T, base::SignalLaw>) {
      if (const std::optional<double> number = member.number()) value(path, field, *number);
    } else if constexpr (std::is_same_v<T, base::MarkerRef>) {
      if (member.body.empty()) return;  // not given
      note(path, marker_problem(member, description_));
      if (found && !member.where.empty()) where = member.where;
    } else if constexpr (std::is_same_v<T, DeflectionBase>) {
      if (member == DeflectionBase::other) value(path, field, member.marker);
    } else if constexpr (std::is_same_v<T, Eigen::Vector3d>) {
      for (int i = 0; i < 3; ++i) value(fmt::format("{}.{}", path, i), field, member[i]);
    } else if constexpr (base::kIsOptional<T>) {
      if (member) entry(path, field, *member);
    } else if constexpr (base::kIsReference<T>) {
      if (field.is_required || !member.name.empty()) record(path, member.value);
    } else if constexpr (base::kIsVariant<T>) {
      std::visit([&]<class A>(const A& kind) { alternative(join_path(path, A::kKey), kind); },
                 member);
    } else if constexpr (base::kIsNamedList<T>) {
      for (const auto& entry : member) record(join_path(path, entry.name), entry);
    } else if constexpr (base::kIsArray<T> || base::kIsVector<T>) {
      for (std::size_t i = 0; i < member.size(); ++i) {
        entry(fmt::format("{}.{}", path, i), field, member[i]);
      }
    } else if constexpr (base::HasFields<T>) {
      record(path, member, field.is_required);
    } else if constexpr (std::is_same_v<T, int>) {
      value(path, field, static_cast<double>(member));
    }
  }

  /// A value that somebody wrote down.
  template <class T>
  void entry(const std::string& path, const base::FieldNote& field, const T& member) {
    if (found) return;
    if constexpr (base::kIsReference<T>) {
      record(path, member.value);
    } else if constexpr (base::HasFields<T>) {
      record(path, member);
    } else {
      value(path, field, member);
    }
  }

  /// The alternative of a variant is written down if the record around it is.
  template <class A>
  void alternative(const std::string& path, const A& kind) {
    if (!found) record(path, kind, is_given_);
  }

  const ModelDescription& description_;
  bool is_given_ = true;
};

Walker walked(const ModelDescription& description) {
  Walker walker(description);
  walker.record("", description);
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
