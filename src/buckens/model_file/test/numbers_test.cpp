// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/model_file/model_file.h"
#include "buckens/model_file/table.h"

namespace buckens::model_file {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::string mass_model(const std::string& mass) {
  return "buckens: 1\nparameters: {L: 1 m}\nbodies: {a: {rigid: {mass: " + mass + "}}}\n";
}

std::string model_refusal(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    read_model_text(text, "m.yaml", overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no InputError";
}

double mass_of(const std::string& text) {
  const model::ModelDescription read = read_model_text(mass_model(text), "m.yaml");
  return std::get<body::RigidSpec>(read.bodies.front().kind).mass;
}

TEST(ModelFileNumbers, ADifferenceThatBeginsWithZeroIsNoOctalNumber) {
  EXPECT_DOUBLE_EQ(mass_of("0.5-0.2"), 0.3);
  EXPECT_DOUBLE_EQ(mass_of("0.3+0.1 kg"), 0.4);
  EXPECT_DOUBLE_EQ(mass_of("0-1+5"), 4.0);
  EXPECT_DOUBLE_EQ(mass_of("00.5e1+0"), 5.0);
  for (const char* text : {"010", "-010", "00", "00.5", "007e2"}) {
    EXPECT_THAT(model_refusal(mass_model(text)), HasSubstr("octal number; write ")) << text;
  }
}

TEST(ModelFileNumbers, WhatIsBeyondTheirRangeIsSaidSo) {
  EXPECT_THAT(model_refusal(mass_model("1e400")),
              HasSubstr("a.rigid.mass: 1e400 is outside the range"));
  EXPECT_THAT(model_refusal(mass_model("-1e400")), HasSubstr("-1e400 is outside the range"));
  EXPECT_THAT(model_refusal(mass_model("1e-400")), HasSubstr("1e-400 is outside the range"));
  // No measure has such a size, and its square or fourth power would be infinite.
  EXPECT_THAT(model_refusal(mass_model("1e300 kg")),
              HasSubstr("1e300 kg is not allowed: the value must "
                        "not exceed 1e+60 in SI units"));
  EXPECT_THAT(model_refusal(mass_model("1, com: [-1e61, 0, 0]")), HasSubstr("com.0: -1e61 is not"));
  EXPECT_DOUBLE_EQ(mass_of("1e60"), 1e60);
}

TEST(ModelFileNumbers, AnExpressionShowsItsValue) {
  EXPECT_THAT(model_refusal(mass_model("L-2 kg")),
              HasSubstr("rigid.mass: L-2 kg = -1 is not allowed"));
  EXPECT_THAT(model_refusal(mass_model("-2 kg")), HasSubstr("rigid.mass: -2 kg is not allowed"));
}

TEST(ModelFileNumbers, LettersThatOnlyLookLikeThoseOfFormulas) {
  EXPECT_THAT(model_refusal(mass_model("\u22125 kg")), HasSubstr("(U+2212); write - instead"));
  EXPECT_THAT(model_refusal(mass_model("5 \u2212 L")), HasSubstr("(U+2212); write - instead"));
  EXPECT_THAT(model_refusal(mass_model("5\u00a0kg")), HasSubstr("(U+00A0); write a blank instead"));
  EXPECT_THAT(model_refusal(mass_model("5\u00b7L")), HasSubstr("(U+00B7); write * instead"));
  EXPECT_THAT(model_refusal(mass_model("2*\u03c0")), HasSubstr("(U+03C0); write pi instead"));
  // They belong to units.
  EXPECT_THAT(model_refusal(mass_model("5 kg\u00b7foo")),
              HasSubstr("unknown unit \"kg\u00b7foo\""));
  EXPECT_THAT(model_refusal(mass_model("5 m\u00b2")), HasSubstr("is an area; expected a mass"));
}

TEST(ModelFileNumbers, AUnitInsideAFormulaIsToldFromAMisspeltName) {
  EXPECT_THAT(
      model_refusal(mass_model("L*kg")),
      HasSubstr("unknown name \"kg\"; if this is a unit, write it at the end after a space"));
  EXPECT_THAT(model_refusal(mass_model("2*(L)kg")), HasSubstr("if this is a unit"));
}

TEST(ModelFileNumbers, LawsOfTimeAreFiniteInSiUnits) {
  const auto force = [](const std::string& value) {
    return model_refusal(
        "buckens: 1\nbodies: {a: {rigid: {mass: 1}}}\nloads: {f: {force: {on: a, value: [" + value +
        ", 0, 0]}}}\n");
  };
  EXPECT_THAT(force("1e305*1 MN"), HasSubstr("has the value inf at t = 0"));
  EXPECT_THAT(force("1e305*(1+t) MN"), HasSubstr("has the value inf at t = 0"));
  EXPECT_THAT(force("1e100 N"), HasSubstr("must not exceed 1e+60"));
  EXPECT_THAT(force("{table: []}"), HasSubstr("at least one point"));
  EXPECT_THAT(force("{table: [[0, 1], [1, 2]], column: 3}"),
              HasSubstr("column: this key applies to files"));
  EXPECT_THAT(force("{table: [[0, 1], [1, 2]], unit: kg}"),
              HasSubstr("not a unit of a force, such as N"));
}

TEST(ModelFileNumbers, PlacesOfMissingValues) {
  EXPECT_THAT(model_refusal("buckens: 1\nbodies:\n  a:\njoints: {}\n"),
              HasSubstr("m.yaml:3:3: bodies.a: expected"));
  EXPECT_THAT(model_refusal(mass_model("~")),
              HasSubstr("m.yaml:3:28: bodies.a.rigid.mass: expected a mass"));
}

TEST(ModelFileNumbers, TextThatIsNoUnicode) {
  // A half of a pair of UTF-16, a slash in three bytes, a number beyond the last character.
  for (const char* bytes :
       {"\xED\xA0\x80", "\xE0\x80\xAF", "\xF4\x90\x80\x80", "\xF0\x80\x80\x80"}) {
    EXPECT_THAT(model_refusal("buckens: 1\ntitle: " + std::string(bytes) + "\n"),
                HasSubstr("m.yaml:2:8: byte 0x"))
        << bytes;
  }
  EXPECT_EQ(read_model_text("title: \u00b5\u20ac\U0001F600\n" + mass_model("1"), "m.yaml").title,
            "\u00b5\u20ac\U0001F600");
}

TEST(ModelFileNumbers, ABodyLikeAnotherIsJudgedAsWhatItIs) {
  const std::string stone = "buckens: 1\nbodies:\n  a: {rigid: {mass: 1}}\n  b: {like: a, ";
  EXPECT_THAT(
      model_refusal(stone + "geometric-stiffness: on}\n"),
      HasSubstr("m.yaml:4:37: bodies.b.geometric-stiffness: a rigid body has no stiffness"));
  EXPECT_THAT(model_refusal(stone + "frames: 3}\n"),
              HasSubstr("bodies.b.frames: a rigid body has one frame"));
  EXPECT_THAT(model_refusal(stone + "reduction: {free-free: 3}}\n"),
              HasSubstr("bodies.b.reduction: a rigid body does not deform"));
}

TEST(ModelFileNumbers, OverridesOfListsThatAreNotThere) {
  EXPECT_THAT(model_refusal(mass_model("1"), {"gravity.1=0"}),
              HasSubstr("the model file has nothing at \"gravity\", not a list; set it as a whole: "
                        "gravity=[0, -9.81 m/s^2, 0]"));
  const std::string beam =
      "buckens: 1\nmaterials: {steel: {E: 1, rho: 1}}\nbodies: {a: {beam: {to: [1, 0, 0], section: "
      "{circle: {diameter: 1}}, material: steel}}}\n";
  EXPECT_THAT(
      model_refusal(beam, {"bodies.a.beam.material.E=2"}),
      HasSubstr("holds \"steel\" in the model file; set a value of the entry of that name"));
}

class TableFile : public testing::Test {
 protected:
  CsvColumns read(const std::string& text) {
    std::ofstream(file_) << text;
    return read_csv_columns(file_, 2);
  }
  void TearDown() override { std::filesystem::remove(file_); }

  std::filesystem::path file_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string("table_") + testing::UnitTest::GetInstance()->current_test_info()->name() +
       ".csv");
};

TEST_F(TableFile, ABrokenFirstRowIsNoHeading) {
  EXPECT_THAT([this] { read("0s,1\n1,2\n"); }, ThrowsMessage<InputError>(testing::AllOf(
                                                   HasSubstr(".csv:1:1: "), HasSubstr("\"0s\""))));
  EXPECT_THAT([this] { read("0,5;1\n1;2\n"); },
              ThrowsMessage<InputError>(HasSubstr("\"0,5\" is not a number")));
  EXPECT_THAT(read("t [s],\"force, N\"\n0,1\n1,2\n").values, ElementsAre(1, 2));
}

TEST_F(TableFile, SpreadsheetsMayQuoteNumbers) {
  const CsvColumns table = read("\"t\",\"F\"\r\n\"0\",\"1.5\"\r\n\"1\",\"-2\"\r\n");
  EXPECT_THAT(table.times, ElementsAre(0, 1));
  EXPECT_THAT(table.values, ElementsAre(1.5, -2));
}

}  // namespace
}  // namespace buckens::model_file
