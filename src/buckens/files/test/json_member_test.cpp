// SPDX-License-Identifier: Apache-2.0
#include "buckens/files/json_member.h"

#include <string>

#include <gtest/gtest.h>

namespace buckens::files {
namespace {

TEST(JsonMember, KeepsTheOrder) {
  nlohmann::ordered_json object = nlohmann::ordered_json::object();
  object["z"] = 1;
  add_member(object, "b", {{"dof", 0}});
  add_member(object, "a", "text");
  EXPECT_EQ(object.dump(), R"({"z":1,"b":{"dof":0},"a":"text"})");
  EXPECT_EQ(object["b"]["dof"], 0);
}

}  // namespace
}  // namespace buckens::files
