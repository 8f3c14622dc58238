// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/spec/description_member.h"

#include <stdexcept>
#include <string>

#include "buckens/base/member_types.h"

namespace buckens::model {

// The one place where all field lists become types of members: it takes as long to compile as ten
// others.
base::Member description_member(ModelDescription& description) {
  return base::member_of(description);
}

base::Member description_member(const ModelDescription& description) {
  return description_member(const_cast<ModelDescription&>(description));
}

base::Member field_member(const base::Member& record, const char* key) {
  for (const base::Field& field : record.fields()) {
    if (field.note.name == key) return field.member;
  }
  throw std::logic_error(std::string("no field ") + key);
}

base::Member kind_member(const base::Member& entry) {
  // A variant is inlined: its field has no name.
  return field_member(entry, "").parts().front();
}

}  // namespace buckens::model
