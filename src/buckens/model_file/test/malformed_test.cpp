// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <random>
#include <string>

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
  } catch (const InputError&) {
    return false;
  } catch (const IoError&) {
    return false;  // a name of a table was broken
  }
}

TEST(MalformedModelFile, EveryTruncatedCopyEndsCleanly) {
  const std::string good = kSampleModel;
  int read = 0;
  for (std::size_t length = 0; length < good.size(); ++length) {
    read += is_read(good.substr(0, length)) ? 1 : 0;
  }
  // Cut between two sections, or within the last sensors, the file can still be a model.
  EXPECT_GT(read, 0);
  EXPECT_LT(read, 300);
}

TEST(MalformedModelFile, EveryMissingLineEndsCleanly) {
  const std::string good = kSampleModel;
  for (std::size_t begin = 0; begin < good.size();) {
    const std::size_t end = good.find('\n', begin) + 1;
    is_read(good.substr(0, begin) + good.substr(end));
    begin = end;
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
