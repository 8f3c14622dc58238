// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/model_file/model_file.h"
#include "buckens/model_file/test/sample.h"
#include "buckens/model_file/yaml_tree.h"

namespace buckens::model_file {
namespace {

/// Reads a text that may be broken; anything but success or an InputError fails the test.
bool is_read(const std::string& text) {
  try {
    read_model_text(text, "broken.yaml");
    return true;
  } catch (const InputError& error) {
    // The reported position is within the text.
    const auto lines = std::count(text.begin(), text.end(), '\n') + 1;
    EXPECT_EQ(error.where().file, "broken.yaml") << error.what();
    EXPECT_LE(error.where().line, lines) << error.what();
    return false;
  } catch (const IoError&) {
    return false;  // a name of a table was broken
  }
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) out.push_back(line);
  return out;
}

bool begins_with_one_of(const std::string& line, const std::vector<std::string>& beginnings) {
  return std::any_of(beginnings.begin(), beginnings.end(),
                     [&](const std::string& text) { return line.starts_with(text); });
}

/// Whether the model may end behind this line: there is a body, and nothing that was begun misses
/// what it needs, be it an interface further down.
bool may_be_last(const std::string& line) {
  return !line.ends_with(':') &&
         !begins_with_one_of(line, {"      from:", "      to:", "      elements:", "      section:",
                                    "      box: {from", "      nodes:", "    markers: {corner"});
}

TEST(MalformedModelFile, CutOffItIsAModelOnlyWhereAllThatWasBegunIsComplete) {
  const std::string good = kSampleModel;
  const std::vector<std::string> whole = lines_of(good);
  const std::size_t first_body = good.find("\n", good.find("    rigid:"));
  for (std::size_t length = 0; length < good.size(); ++length) {
    const std::string text = good.substr(0, length);
    std::vector<std::string> lines = lines_of(text);
    while (!lines.empty() && lines.back().find_first_not_of(' ') == std::string::npos) {
      lines.pop_back();
    }
    const std::string last = lines.empty() ? "" : lines.back();
    const bool is_whole = !lines.empty() && last == whole[lines.size() - 1];
    const bool lacks_unit = last == "  every: 1" || last == "  every: 1 ";  // means seconds then
    const bool is_model = length >= first_body && ((is_whole && may_be_last(last)) || lacks_unit);
    EXPECT_EQ(is_read(text), is_model) << "cut behind\n" << last;
  }
}

TEST(MalformedModelFile, WithoutALineItIsAModelOnlyWhereNothingNeedsIt) {
  // Entries to which others refer, entries without a default, and those that open a map.
  const std::vector<std::string> needed = {
      "buckens:",       "planar:",         "parameters:",       "materials:",      "  steel:",
      "  soft: {E",     "  ply:",          "sections:",         "  rod6:",         "  tube:",
      "bodies:",        "  crank:",        "    rigid:",        "    markers: {p", "  rod:",
      "    beam:",      "      to:",       "      section:",    "      material:", "  frame:",
      "    structure:", "      nodes:",    "    markers: {top", "  block:",        "    mesh:",
      "      box:",     "    interfaces:", "      left:",       "  lump:",         "      solids:",
      "  shaft:",       "  twin:",         "joints:",           "  base:",         "loads:",
      "initial:",       "  bodies:",       "output:",           "  sensors:"};
  std::vector<std::string> lines = lines_of(kSampleModel);
  for (std::size_t left_out = 0; left_out < lines.size(); ++left_out) {
    std::string text;
    for (std::size_t k = 0; k < lines.size(); ++k) text += k == left_out ? "" : lines[k] + '\n';
    EXPECT_EQ(is_read(text), !begins_with_one_of(lines[left_out], needed))
        << "without line " << left_out + 1 << "\n"
        << lines[left_out];
  }
}

TEST(MalformedModelFile, RandomBytesInItEndCleanly) {
  std::mt19937 random(20240607);
  const std::string good = kSampleModel;
  const std::string alphabet = "{}[]:,#&*!|>'\"%@`-? \n\t0.eE+/()^tx\xc3\xff";
  std::uniform_int_distribution<std::size_t> place(0, good.size() - 1);
  std::uniform_int_distribution<std::size_t> letter(0, alphabet.size() - 1);
  for (int i = 0; i < 600; ++i) {
    std::string text = good;
    for (int k = 0; k < 1 + i % 3; ++k) text[place(random)] = alphabet[letter(random)];
    is_read(text);
  }
}

std::string repeated(const std::string& piece, int count) {
  std::string out;
  for (int i = 0; i < count; ++i) out += piece;
  return out;
}

TEST(YamlTree, HasAValueForFourBytesOfALargeText) {
  // As a model has them, and as a text has them that is there to fill memory.
  EXPECT_EQ(parse_yaml("[" + repeated("0.125, ", 600000) + "1]", "long.yaml").items.size(),
            600001U);
  try {
    parse_yaml("[" + repeated("1,", 600000) + "1]", "dense.yaml");
    FAIL() << "was read";
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_THAT(message, testing::HasSubstr("more than 500000 values")) << message;
    EXPECT_THAT(message, testing::HasSubstr("CSV")) << message;
  }
}

TEST(MalformedModelFile, DeepAndHugeTextsAreRefusedSoon) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_FALSE(is_read(repeated("[", 100000)));
  EXPECT_FALSE(is_read(repeated("{a: ", 50000)));
  EXPECT_FALSE(is_read("buckens: 1\nx: " + repeated("- ", 5000)));
  EXPECT_FALSE(is_read("buckens: 1\nx: " + repeated("[", 80) + repeated("]", 80)));
  EXPECT_FALSE(is_read(repeated("a", 9 << 20)));
  EXPECT_FALSE(is_read(repeated("? ", 10000)));
  EXPECT_FALSE(is_read("title: \"" + repeated("\\", 100001)));
  std::string many = "buckens: 1\n";
  for (int i = 0; i < 30000; ++i) many += "k" + std::to_string(i) + ": 1\n";
  EXPECT_FALSE(is_read(many));
  const std::string nested = "buckens: 1\nbodies: {a: {rigid: {mass: \"";
  EXPECT_FALSE(is_read(nested + repeated("(", 10000) + "\"}}}"));
  EXPECT_FALSE(is_read(nested + repeated("-", 19000) + "1\"}}}"));
  EXPECT_FALSE(is_read(nested + repeated("1 ", 50000) + "kg\"}}}"));
  // Some seconds at most even on a loaded machine with sanitizers; the point is that nothing hangs.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
}

TEST(YamlTree, KeepsTextsAsWritten) {
  const YamlNode root = parse_yaml("a: 010\nb: 'yes'\nc: [1, {d: ~}]\ne:\n", "t.yaml");
  ASSERT_TRUE(root.is_map());
  EXPECT_EQ(root.find("a")->text, "010");
  EXPECT_FALSE(root.find("a")->is_quoted);
  EXPECT_TRUE(root.find("b")->is_quoted);
  EXPECT_EQ(root.deepest("c.1").where.text(), "t.yaml:3:8");
  EXPECT_EQ(root.find("e")->kind, YamlNode::Kind::null);
  EXPECT_EQ(root.find("f"), nullptr);
  EXPECT_EQ(&root.deepest("c.7"), root.find("c"));
}

}  // namespace
}  // namespace buckens::model_file
