// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "buckens/base/field.h"

namespace buckens::base {

/// Visits the field list of a spec without changing it: the visitor gets a Field<const T> per line.
///
/// For code that reads specs rather than fills them: writing a model back to YAML, comparing two.
/// @param spec has the member template fields(visit), see Field
template <class Spec, class Visitor>
void visit_fields(const Spec& spec, Visitor&& visitor) {
  auto constant = [&visitor]<class T>(Field<T>&& field) {
    visitor(Field<const T>{field.member, std::move(field.note)});
  };
  // A field list names members and changes none of them; only a visitor could, and this one cannot.
  const_cast<Spec&>(spec).fields(constant);
}

}  // namespace buckens::base
