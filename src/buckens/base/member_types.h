// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "buckens/base/field.h"
#include "buckens/base/member.h"

/// The types of members, as templates. Only sources that start a visit need them.
namespace buckens::base {

/// The visitor of field lists.
struct FieldCollector {
  std::vector<Field> fields;
  void operator()(Field&& field) { fields.push_back(std::move(field)); }
};

/// A struct with a field list.
template <class T>
concept HasFields = requires(T& record, FieldCollector& visit) {
  record.fields(visit);
};

template <class T>
class ValueType final : public MemberType {
 public:
  constexpr ValueType() : MemberType(Form::value, typeid(T)) {}
};

/// An enumeration; its words are choice_names(T), in the order of its values.
template <class T>
class ChoiceType final : public MemberType {
 public:
  constexpr ChoiceType() : MemberType(Form::choice, typeid(T)) {}
  std::vector<std::string> choices() const override { return words(choice_names(T{})); }
  std::vector<std::string> planned() const override {
    if constexpr (requires { planned_names(T{}); }) return words(planned_names(T{}));
    return {};
  }
  std::size_t index(const void* member) const override {
    return static_cast<std::size_t>(*static_cast<const T*>(member));
  }
  void choose(void* choice, std::size_t k) const override {
    *static_cast<T*>(choice) = static_cast<T>(k);
  }

 private:
  template <class Names>
  static std::vector<std::string> words(const Names& names) {
    return {names.begin(), names.end()};
  }
};

template <class T>
class OptionalType final : public MemberType {
 public:
  constexpr OptionalType() : MemberType(Form::optional, typeid(std::optional<T>)) {}
  std::size_t size(const void* member) const override {
    return static_cast<const std::optional<T>*>(member)->has_value() ? 1 : 0;
  }
  Member part(void* member, std::size_t /*k*/) const override {
    return member_of(**static_cast<std::optional<T>*>(member));
  }
  const MemberType& part_type() const override { return type_of<T>(); }
  Member add(void* member, std::size_t /*k*/) const override {
    return member_of(static_cast<std::optional<T>*>(member)->emplace());
  }
};

template <class T>
class ReferenceType final : public MemberType {
 public:
  constexpr ReferenceType() : MemberType(Form::reference, typeid(Reference<T>)) {}
  std::size_t size(const void* /*member*/) const override { return 1; }
  Member part(void* member, std::size_t /*k*/) const override {
    return member_of(static_cast<Reference<T>*>(member)->value);
  }
  const MemberType& part_type() const override { return type_of<T>(); }
  std::string* name(void* member) const override {
    return &static_cast<Reference<T>*>(member)->name;
  }
};

template <class T, std::size_t n>
class ArrayType final : public MemberType {
 public:
  constexpr ArrayType() : MemberType(Form::array, typeid(std::array<T, n>)) {}
  std::size_t size(const void* /*member*/) const override { return n; }
  Member part(void* member, std::size_t k) const override {
    return member_of((*static_cast<std::array<T, n>*>(member))[k]);
  }
  const MemberType& part_type() const override { return type_of<T>(); }
};

template <class T>
class ListType final : public MemberType {
 public:
  constexpr ListType() : MemberType(Form::list, typeid(std::vector<T>)) {}
  std::size_t size(const void* member) const override {
    return static_cast<const std::vector<T>*>(member)->size();
  }
  Member part(void* member, std::size_t k) const override { return member_of(list(member)[k]); }
  const MemberType& part_type() const override { return type_of<T>(); }
  Member add(void* member, std::size_t /*k*/) const override {
    return member_of(list(member).emplace_back());
  }
  void take(void* member, void* part) const override {
    list(member).push_back(std::move(*static_cast<T*>(part)));
  }
  void clear(void* member) const override { list(member).clear(); }

 private:
  static std::vector<T>& list(void* member) { return *static_cast<std::vector<T>*>(member); }
};

template <class... T>
class VariantType final : public MemberType {
 public:
  constexpr VariantType() : MemberType(Form::variant, typeid(std::variant<T...>)) {}
  std::size_t size(const void* /*member*/) const override { return 1; }
  std::size_t index(const void* member) const override {
    return static_cast<const Variant*>(member)->index();
  }
  Member part(void* member, std::size_t /*k*/) const override {
    return std::visit([](auto& held) { return member_of(held); }, *static_cast<Variant*>(member));
  }
  Member add(void* member, std::size_t k) const override {
    using Make = Member (*)(Variant&);
    static constexpr Make kMakers[] = {
        [](Variant& variant) { return member_of(variant.template emplace<T>()); }...};
    return kMakers[k](*static_cast<Variant*>(member));
  }
  std::vector<AlternativeNote> alternatives() const override {
    return {{T::kKey, T::kDoc, &type_of<T>()}...};
  }

 private:
  using Variant = std::variant<T...>;
};

template <HasFields T>
class RecordType final : public MemberType {
 public:
  constexpr RecordType() : MemberType(Form::record, typeid(T), kName) {}
  std::vector<Field> fields(void* record) const override {
    FieldCollector collector;
    static_cast<T*>(record)->fields(collector);
    return std::move(collector.fields);
  }
  SourceLocation* where(void* record) const override {
    if constexpr (requires(T & spec) { spec.where; }) return &static_cast<T*>(record)->where;
    return nullptr;
  }
  std::string* name(void* record) const override {
    if constexpr (kName != Name::none) return &static_cast<T*>(record)->name;
    return nullptr;
  }

 private:
  static constexpr Name name_of_type() {
    if (requires { T::kHasForeignName; }) return Name::foreign;
    return requires(T & record) { record.name; }
    ? Name::own : Name::none;
  }
  static constexpr Name kName = name_of_type();

  void* create() const override { return new T; }
  void destroy(void* record) const override { delete static_cast<T*>(record); }
};

/// Selects the template for the type T.
template <class T>
struct TypeOf {
  using Type = std::conditional_t<std::is_enum_v<T>, ChoiceType<T>, ValueType<T>>;
};
template <HasFields T>
struct TypeOf<T> {
  using Type = RecordType<T>;
};
template <class T>
struct TypeOf<std::optional<T>> {
  using Type = OptionalType<T>;
};
template <class T>
struct TypeOf<Reference<T>> {
  using Type = ReferenceType<T>;
};
template <class T, std::size_t n>
struct TypeOf<std::array<T, n>> {
  using Type = ArrayType<T, n>;
};
template <class T>
struct TypeOf<std::vector<T>> {
  using Type = ListType<T>;
};
template <class... T>
struct TypeOf<std::variant<T...>> {
  using Type = VariantType<T...>;
};

template <class T>
const MemberType& type_of() {
  static constexpr typename TypeOf<T>::Type kType{};
  return kType;
}

}  // namespace buckens::base
