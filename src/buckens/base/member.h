// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <typeinfo>
#include <vector>

#include "buckens/base/source_location.h"

namespace buckens::base {

class MemberType;
struct Field;

/// A member of a spec whose type is known only at run time.
///
/// Code that visits field lists (reader, checks, schema, comparison) is written once for members
/// and not compiled for every spec. A Member of a constant spec must not be modified.
struct Member {
  void* at = nullptr;
  const MemberType* type = nullptr;

  /// The member itself if it is a T, otherwise null.
  template <class T>
  T* get() const;

  /// The contents of an optional, a reference, an array, a list or a variant.
  std::vector<Member> parts() const;
  /// The entries of a record's field list.
  std::vector<Field> fields() const;
};

/// Key and description of one alternative of a variant.
struct AlternativeNote {
  const char* key = "";
  const char* doc = "";
  const MemberType* type = nullptr;
};

/// Operations on members of one type. The form determines which functions are supported; the
/// others throw std::logic_error. A member is given by its address.
class MemberType {
 public:
  enum class Form {
    value,      ///< a number, a text, a law, …: see Member::get
    choice,     ///< an enumeration
    optional,   ///< one part or none
    reference,  ///< a name or one part: Reference
    array,      ///< a fixed number of parts
    list,       ///< any number of parts
    variant,    ///< one part out of several alternatives
    record      ///< a spec with a field list
  };

  Form form() const { return form_; }
  const std::type_info& id() const { return id_; }
  template <class T>
  bool is() const {
    return id_ == typeid(T);
  }

  // ---- optional, reference, array, list, variant
  virtual std::size_t size(const void* member) const;
  virtual Member part(void* member, std::size_t k) const;
  virtual const MemberType& part_type() const;  ///< not of a variant
  /// Creates a new part: of a list, at its end; of a variant, as alternative k.
  virtual Member add(void* member, std::size_t k = 0) const;
  /// Moves `part` to the end of a list.
  virtual void take(void* list, void* part) const;
  virtual void clear(void* list) const;
  virtual std::vector<AlternativeNote> alternatives() const;

  // ---- variant, choice
  /// Index of the current alternative or of the chosen word.
  virtual std::size_t index(const void* member) const;
  virtual std::vector<std::string> choices() const;
  virtual std::vector<std::string> planned() const;  ///< words that are not available yet
  virtual void choose(void* choice, std::size_t k) const;

  // ---- record
  std::shared_ptr<void> make() const;
  virtual std::vector<Field> fields(void* record) const;
  bool has_name() const { return name_ != Name::none; }
  /// Whether names come from another program and may contain any characters.
  bool has_foreign_name() const { return name_ == Name::foreign; }
  virtual SourceLocation* where(void* record) const;  ///< null: keeps no place
  /// The name of a record that has one, or of a reference; otherwise null.
  virtual std::string* name(void* member) const;

 protected:
  enum class Name { none, own, foreign };

  // What is the same for all members of a type is data: functions would be compiled for each of
  // several hundred types.
  constexpr MemberType(Form form, const std::type_info& id, Name name = Name::none)
      : form_(form), name_(name), id_(id) {}
  ~MemberType() = default;

  virtual void* create() const;
  virtual void destroy(void* record) const;

 private:
  Form form_;
  Name name_;
  const std::type_info& id_;
};

template <class T>
T* Member::get() const {
  return type->is<T>() ? static_cast<T*>(at) : nullptr;
}

/// The run-time type of T. Defined in member_types.h, which only the few sources that start a visit
/// include: it visits the field lists of T and of everything in it.
template <class T>
const MemberType& type_of();

template <class T>
Member member_of(T& member) {
  return {&member, &type_of<T>()};
}

}  // namespace buckens::base
