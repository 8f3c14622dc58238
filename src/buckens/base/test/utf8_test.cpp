// SPDX-License-Identifier: Apache-2.0
#include "buckens/base/utf8.h"

#include <string>

#include <gtest/gtest.h>

namespace buckens::base {
namespace {

TEST(Utf8, TakesCharactersOfAllLengths) {
  for (const char* text : {"", "plain", "Größe", "速度", "\xf0\x9f\x98\x80", "\xef\xbf\xbf"}) {
    EXPECT_TRUE(is_utf8(text)) << text;
  }
  EXPECT_EQ(utf8_length("ö", 0), 2U);
  EXPECT_EQ(utf8_length("速", 0), 3U);
  EXPECT_EQ(utf8_length("\xf0\x9f\x98\x80", 0), 4U);
}

TEST(Utf8, RefusesWhatUnicodeRefuses) {
  for (const char* text :
       {"\xff", "\x80", "caf\xe9", "\xc3", "\xe2\x82", "\xc0\xaf", "\xe0\x80\xaf", "\xed\xa0\x80",
        "\xf4\x90\x80\x80", "\xf5\x80\x80\x80"}) {
    EXPECT_FALSE(is_utf8(text)) << text;
  }
  EXPECT_FALSE(is_utf8(std::string("a\0b", 3)));
}

}  // namespace
}  // namespace buckens::base
