// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/coupling_level.h"

#include <gtest/gtest.h>

namespace buckens::body {
namespace {

TEST(CouplingTerms, LevelsKeepWhatTheirNamesSay) {
  EXPECT_EQ(CouplingChoice(CouplingLevel::full).terms, CouplingTerms{});
  EXPECT_EQ(CouplingChoice(CouplingLevel::none).terms, CouplingTerms::none());
  const CouplingTerms first = CouplingChoice(CouplingLevel::first_order).terms;
  EXPECT_TRUE(first.jvar && first.cor_ref && first.cent0);
  EXPECT_FALSE(first.are_lagged());
  const CouplingTerms nocor = CouplingChoice(CouplingLevel::nocor).terms;
  EXPECT_FALSE(nocor.cor_ref || nocor.cor_fe);
  EXPECT_TRUE(nocor.quad_ref && nocor.jvar && nocor.cent0 && nocor.cent1 && nocor.eul_fe);
  EXPECT_FALSE(CouplingTerms::none().use_patterns());
  EXPECT_TRUE(CouplingChoice(CouplingLevel::automatic).may_use_patterns());
}

TEST(CouplingTerms, NamesOfSets) {
  EXPECT_EQ(to_string(CouplingTerms{}), "full");
  EXPECT_EQ(to_string(CouplingTerms::first_order()), "first-order");
  const CouplingChoice two(CouplingLevel::full, {CouplingTerm::cent0, CouplingTerm::cor_fe});
  EXPECT_EQ(to_string(two.terms), "drop cent0, cor-fe");
  // Dropping terms by name is equivalent to the level that neglects the same terms.
  const CouplingChoice centrifugal(CouplingLevel::full, {CouplingTerm::cent0, CouplingTerm::cent1});
  EXPECT_EQ(to_string(centrifugal.terms), "nocent");
}

}  // namespace
}  // namespace buckens::body
