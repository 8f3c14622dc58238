// SPDX-License-Identifier: Apache-2.0
#include "../mesh_share.h"

#include <gmock/gmock.h>

namespace buckens_petsc {
namespace {

using testing::ElementsAre;
using testing::Pair;

TEST(JoinedPairs, AreThoseOfNodesOfTheSameElement) {
  JoinedPairs joined;
  // A triangle and a bar that share a node, and a bar on one node twice, which joins nothing.
  joined.find({{4, 7, 9, 11}, {0, 2, 3, 3, 1, 1, 1}}, {0, 2, 2, 4});
  EXPECT_THAT(joined.pairs, ElementsAre(Pair(0, 2), Pair(0, 3), Pair(1, 3), Pair(2, 0), Pair(2, 3),
                                        Pair(3, 0), Pair(3, 1), Pair(3, 2)));
  EXPECT_THAT(joined.counts, ElementsAre(6, 0, 10)) << "numbers for those who have the first nodes";
}

TEST(JoinedPairs, AreNoneWithoutElements) {
  JoinedPairs joined;
  joined.find({{0}, {}}, {0, 3, 5});
  EXPECT_TRUE(joined.pairs.empty());
  EXPECT_THAT(joined.counts, ElementsAre(0, 0));
}

TEST(MeshShare, ListsTheNeighboursOfItsNodes) {
  MeshShare share;
  share.weights = {3, 3, 6};
  // From several processes, some twice; the second node has no neighbours.
  share.join({12, 4, 10, 20, 12, 4, 12, 10}, 10);
  EXPECT_THAT(share.starts, ElementsAre(0, 1, 1, 3));
  EXPECT_THAT(share.neighbours, ElementsAre(20, 4, 10));
}

}  // namespace
}  // namespace buckens_petsc
