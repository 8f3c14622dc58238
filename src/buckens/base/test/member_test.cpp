// SPDX-License-Identifier: Apache-2.0
#include "buckens/base/member.h"

#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/base/field.h"
#include "buckens/base/member_types.h"

namespace buckens::base {
namespace {

using Form = MemberType::Form;

enum class Side { left, right };
constexpr std::array<const char*, 2> choice_names(Side) { return {"left", "right"}; }
constexpr std::array<const char*, 1> planned_names(Side) { return {"middle"}; }

struct Spring {
  static constexpr const char* kKey = "spring";
  static constexpr const char* kDoc = "pulls";
  double stiffness = 3;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(field("stiffness", stiffness, "of the spring").positive().required());
  }
};

struct Weight {
  static constexpr const char* kKey = "weight";
  static constexpr const char* kDoc = "hangs";
  int count = 1;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(field("count", count, "how many").or_word("none").otherwise("1"));
  }
};

struct Leg {
  std::string name;
  SourceLocation where;
  Side side = Side::right;
  std::optional<double> length;
  std::array<double, 2> range{};
  std::vector<int> steps;
  Reference<Spring> spare;
  std::variant<Spring, Weight> kind;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(field("side", side, "of the body"));
    visit(field("length", length, "from hip to heel").like("0.9 m"));
    visit(field("range", range, "of the knee"));
    visit(field("steps", steps, "counted"));
    visit(field("spare", spare, "in the box"));
    visit(inlined(kind, "what holds it"));
  }
};

TEST(Member, HasTheFieldsOfARecordWithTheirNotes) {
  Spring spring;
  const Member member = member_of(spring);
  ASSERT_EQ(member.type->form(), Form::record);
  const std::vector<Field> fields = member.fields();
  ASSERT_EQ(fields.size(), 1U);
  EXPECT_EQ(fields[0].note.name, "stiffness");
  EXPECT_EQ(fields[0].note.doc, "of the spring");
  EXPECT_TRUE(fields[0].note.is_required);
  EXPECT_EQ(fields[0].note.range, Range::positive);
  EXPECT_EQ(fields[0].member.get<double>(), &spring.stiffness);
  EXPECT_EQ(fields[0].member.get<int>(), nullptr);
}

TEST(Member, KnowsNameAndPlaceOfARecord) {
  Leg leg;
  const Member member = member_of(leg);
  EXPECT_TRUE(member.type->has_name());
  EXPECT_FALSE(member.type->has_foreign_name());
  EXPECT_EQ(member.type->name(member.at), &leg.name);
  EXPECT_EQ(member.type->where(member.at), &leg.where);
  EXPECT_EQ(member_of(leg.spare.value).type->where(&leg.spare.value), nullptr);
  EXPECT_EQ(member_of(leg.spare).type->name(&leg.spare), &leg.spare.name);
}

TEST(Member, ChoosesAmongWords) {
  Leg leg;
  const Member side = member_of(leg).fields()[0].member;
  EXPECT_EQ(side.type->choices(), (std::vector<std::string>{"left", "right"}));
  EXPECT_EQ(side.type->planned(), (std::vector<std::string>{"middle"}));
  EXPECT_EQ(side.type->index(side.at), 1U);
  side.type->choose(side.at, 0);
  EXPECT_EQ(leg.side, Side::left);
}

TEST(Member, FillsOptionalsArraysAndLists) {
  Leg leg;
  const std::vector<Field> fields = member_of(leg).fields();
  const Member length = fields[1].member, range = fields[2].member, steps = fields[3].member;
  EXPECT_TRUE(length.parts().empty());
  *length.type->add(length.at).get<double>() = 0.9;
  EXPECT_EQ(leg.length, 0.9);
  EXPECT_EQ(length.parts().size(), 1U);
  *range.parts()[1].get<double>() = 2.5;
  EXPECT_EQ(leg.range[1], 2.5);
  int five = 5;
  *steps.type->add(steps.at).get<int>() = 4;
  steps.type->take(steps.at, &five);
  EXPECT_EQ(leg.steps, (std::vector<int>{4, 5}));
  steps.type->clear(steps.at);
  EXPECT_TRUE(leg.steps.empty());
}

TEST(Member, HoldsOneAlternativeOfAVariant) {
  Leg leg;
  const Member kind = member_of(leg).fields()[5].member;
  const std::vector<AlternativeNote> known = kind.type->alternatives();
  ASSERT_EQ(known.size(), 2U);
  EXPECT_EQ(known[1].key, "weight");
  EXPECT_EQ(known[1].doc, "hangs");
  EXPECT_TRUE(known[1].type->is<Weight>());
  EXPECT_EQ(kind.type->index(kind.at), 0U);
  *kind.type->add(kind.at, 1).fields()[0].member.get<int>() = 7;
  EXPECT_EQ(std::get<Weight>(leg.kind).count, 7);
  EXPECT_EQ(kind.type->index(kind.at), 1U);
  EXPECT_TRUE(kind.parts().front().type->is<Weight>());
}

TEST(Member, MakesFreshRecords) {
  const MemberType& type = type_of<Leg>();
  const std::shared_ptr<void> made = type.make();
  EXPECT_EQ(static_cast<Leg*>(made.get())->side, Side::right);
}

TEST(Member, RefusesWhatItsFormDoesNotHave) {
  double number = 1;
  const Member member = member_of(number);
  EXPECT_THROW(member.fields(), std::logic_error);
  EXPECT_THROW(member.parts(), std::logic_error);
  EXPECT_THROW(member.type->choices(), std::logic_error);
  EXPECT_THROW(member.type->add(member.at), std::logic_error);
}

}  // namespace
}  // namespace buckens::base
