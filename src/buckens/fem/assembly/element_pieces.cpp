// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/assembly/element_pieces.h"

#include <algorithm>
#include <numeric>

#include "buckens/fem/shell/block.h"
#include "buckens/fem/solid/block.h"

namespace buckens::fem {

namespace {
// The stiffness of so many hex8 is a list of 9 MB.
constexpr int kElementsOfPiece = 1024;
}  // namespace

std::shared_ptr<const ElementBlock> some_elements(const ElementBlock& block,
                                                  const std::vector<Node>& nodes,
                                                  const std::vector<int>& elements) {
  std::vector<int> same_nodes(nodes.size());
  std::iota(same_nodes.begin(), same_nodes.end(), 0);
  if (const auto* solids = dynamic_cast<const SolidBlock*>(&block)) {
    return std::make_shared<const SolidBlock>(solids->subset(elements, same_nodes));
  }
  const auto& shells = dynamic_cast<const ShellBlock&>(block);
  return std::make_shared<const ShellBlock>(shells.subset(elements, same_nodes));
}

void visit_pieces(const ElementBlock& block, const std::vector<Node>& nodes,
                  const std::function<void(const ElementBlock& piece, int first)>& visit) {
  const auto* solids = dynamic_cast<const SolidBlock*>(&block);
  const auto* shells = dynamic_cast<const ShellBlock*>(&block);
  const int count = block.num_elements();
  if (count <= kElementsOfPiece || (solids == nullptr && shells == nullptr)) {
    visit(block, 0);
    return;
  }
  std::vector<int> same_nodes(nodes.size());
  std::iota(same_nodes.begin(), same_nodes.end(), 0);
  for (int first = 0; first < count; first += kElementsOfPiece) {
    std::vector<int> some(static_cast<std::size_t>(std::min(kElementsOfPiece, count - first)));
    std::iota(some.begin(), some.end(), first);
    if (solids != nullptr) {
      visit(solids->subset(some, same_nodes), first);
    } else {
      visit(shells->subset(some, same_nodes), first);
    }
  }
}

}  // namespace buckens::fem
