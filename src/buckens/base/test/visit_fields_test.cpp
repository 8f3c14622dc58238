// SPDX-License-Identifier: Apache-2.0
#include "buckens/base/visit_fields.h"

#include <string>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

namespace buckens::base {
namespace {

struct Spring {
  double stiffness = 3;
  std::string name = "leg";

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(field("stiffness", stiffness, "of the spring").positive().required());
    visit(field("name", name, "of the spring"));
  }
};

TEST(VisitFields, ShowsConstantMembersWithTheirNotes) {
  const Spring spring;
  std::vector<std::string> keys;
  visit_fields(spring, [&](const auto& field) {
    static_assert(std::is_const_v<std::remove_reference_t<decltype(field.member)>>);
    keys.push_back(field.note.name);
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(field.member)>, double>) {
      EXPECT_EQ(&field.member, &spring.stiffness);
      EXPECT_TRUE(field.note.is_required);
      EXPECT_EQ(field.note.range, Range::positive);
    }
  });
  EXPECT_EQ(keys, (std::vector<std::string>{"stiffness", "name"}));
}

}  // namespace
}  // namespace buckens::base
