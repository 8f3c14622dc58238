// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "buckens/base/field.h"

/// Type traits that visitors of field lists need.
namespace buckens::base {

struct AnyVisitor {
  template <class T>
  void operator()(const Field<T>&) {}
};

/// A struct with a field list.
template <class T>
concept HasFields = requires(T& record, AnyVisitor& visit) {
  record.fields(visit);
};

template <class T>
inline constexpr bool kIsVariant = false;
template <class... T>
inline constexpr bool kIsVariant<std::variant<T...>> = true;

template <class T>
inline constexpr bool kIsOptional = false;
template <class T>
inline constexpr bool kIsOptional<std::optional<T>> = true;

template <class T>
inline constexpr bool kIsArray = false;
template <class T, std::size_t n>
inline constexpr bool kIsArray<std::array<T, n>> = true;

template <class T>
inline constexpr bool kIsReference = false;
template <class T>
inline constexpr bool kIsReference<Reference<T>> = true;

template <class T>
inline constexpr bool kIsVector = false;
template <class T>
inline constexpr bool kIsVector<std::vector<T>> = true;

/// A list whose entries have names is a map in the model file.
template <class T>
inline constexpr bool kIsNamedList = false;
template <HasFields T>
inline constexpr bool kIsNamedList<std::vector<T>> = requires(T& entry) {
  entry.name;
};

/// Entries whose names come from another program and may hold any characters.
template <class T>
inline constexpr bool kIsForeignNamed = requires {
  T::kHasForeignName;
};

/// Key and description of one alternative of a variant.
struct AlternativeNote {
  std::string key, doc;
};

template <class Variant>
std::vector<AlternativeNote> alternatives_of() {
  return []<class... A>(std::type_identity<std::variant<A...>>) {
    return std::vector<AlternativeNote>{{A::kKey, A::kDoc}...};
  }(std::type_identity<Variant>{});
}

/// Words of an enumeration in the order of its values.
template <class Enum>
std::vector<std::string> choices_of() {
  const auto names = choice_names(Enum{});
  return {names.begin(), names.end()};
}

/// Words that are known but not available yet.
template <class Enum>
std::vector<std::string> planned_of() {
  if constexpr (requires { planned_names(Enum{}); }) {
    const auto names = planned_names(Enum{});
    return {names.begin(), names.end()};
  } else {
    return {};
  }
}

}  // namespace buckens::base
