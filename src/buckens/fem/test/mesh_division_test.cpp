// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/assembly/mesh_division.h"

#include <gmock/gmock.h>

#include "buckens/linalg/row_order.h"

namespace buckens::fem::test {
namespace {

using testing::ElementsAre;

/// Two variables of the first node, none of the second, three of the third and one of the fourth.
DofMap some_dofs() {
  return {6,
          {{0, 1, -1, -1, -1, -1},
           {-1, -1, -1, -1, -1, -1},
           {2, 3, 4, -1, -1, -1},
           {-1, -1, -1, 5, -1, -1}}};
}

TEST(MeshDivision, VariablesGoWithTheirNodes) {
  const linalg::SharedRowOrder order = row_order(some_dofs(), {2, {1, 0, 0, 1}, 0});
  ASSERT_NE(order, nullptr);
  EXPECT_THAT(order->variables(), ElementsAre(2, 3, 4, 0, 1, 5));
  EXPECT_THAT(order->first_rows(), ElementsAre(0, 3, 6));
}

TEST(MeshDivision, WithoutPartsThereIsNoOrder) { EXPECT_EQ(row_order(some_dofs(), {}), nullptr); }

TEST(MeshDivision, APartWithoutVariablesLeavesRunsOfVariables) {
  // As where all nodes of a process follow one of another.
  EXPECT_EQ(row_order(some_dofs(), {3, {0, 1, 2, 2}, 0}), nullptr);
  EXPECT_EQ(row_order(some_dofs(), {2, {0, 1, 0, 0}, 0}), nullptr) << "the last one";
}

}  // namespace
}  // namespace buckens::fem::test
