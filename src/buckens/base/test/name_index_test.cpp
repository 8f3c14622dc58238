// SPDX-License-Identifier: Apache-2.0
#include "buckens/base/name_index.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace buckens::base {
namespace {

struct Entry {
  std::string name;
  int value = 0;
};

TEST(NameIndex, FindsTheFirstOfAName) {
  const std::vector<Entry> list = {{"a", 1}, {"b", 2}, {"a", 3}};
  NameIndex index;
  EXPECT_EQ(index.find(list, "a"), &list[0]);
  EXPECT_EQ(index.find(list, "b"), &list[1]);
  EXPECT_EQ(index.find(list, "c"), nullptr);
}

TEST(NameIndex, FollowsAListThatGrows) {
  std::vector<Entry> list;
  NameIndex index;
  EXPECT_EQ(index.find(list, "e0"), nullptr);
  for (int k = 0; k < 100; ++k) {
    list.push_back({"e" + std::to_string(k), k});
    ASSERT_EQ(index.find(list, "e" + std::to_string(k)), &list.back());
    ASSERT_EQ(index.find(list, "e0"), &list.front());
  }
}

TEST(NameIndex, IsRightWhereAListHasBeenChangedOtherwise) {
  std::vector<Entry> list = {{"a", 1}, {"b", 2}, {"c", 3}};
  NameIndex index;
  ASSERT_EQ(index.find(list, "b"), &list[1]);
  list[1].name = "d";
  EXPECT_EQ(index.find(list, "b"), nullptr);
  EXPECT_EQ(index.find(list, "d"), &list[1]);
  list.erase(list.begin());
  EXPECT_EQ(index.find(list, "c"), &list[1]);
  EXPECT_EQ(index.find(list, "a"), nullptr);
}

/// A name that counts how often it is compared.
struct CountedName {
  std::string text;
  inline static int comparisons = 0;

  operator const std::string&() const { return text; }
  friend bool operator==(const CountedName& a, const std::string& b) {
    ++comparisons;
    return a.text == b;
  }
};

struct CountedEntry {
  CountedName name;
};

TEST(NameIndex, ComparesNoNamesForAnEntryThatIsNew) {
  std::vector<CountedEntry> list;
  NameIndex index;
  CountedName::comparisons = 0;
  for (int k = 0; k < 1000; ++k) {
    const std::string name = "e" + std::to_string(k);
    ASSERT_FALSE(index.has_seen(list, name));
    list.push_back({{name}});
  }
  EXPECT_EQ(CountedName::comparisons, 0);
  for (int k = 0; k < 1000; ++k) ASSERT_TRUE(index.has_seen(list, "e" + std::to_string(k)));
  EXPECT_EQ(CountedName::comparisons, 1000);  // one each
}

TEST(NameIndex, TellsWhatIsTakenAfterEntriesHaveGone) {
  std::vector<Entry> list = {{"a", 1}, {"b", 2}, {"c", 3}};
  NameIndex index;
  ASSERT_TRUE(index.has_seen(list, "b"));
  list.pop_back();
  EXPECT_FALSE(index.has_seen(list, "c"));
  list.push_back({"d", 4});
  EXPECT_TRUE(index.has_seen(list, "d"));
  list[0].name = "e";
  EXPECT_FALSE(index.has_seen(list, "a"));
}

}  // namespace
}  // namespace buckens::base
