// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/assembly/element_pieces.h"

#include <numeric>

#include "buckens/fem/shell/block.h"
#include "buckens/fem/solid/block.h"

namespace buckens::fem {

namespace {

// The stiffness of so many hex8 is a list of 1.2 MB.
constexpr int kElementsOfPiece = 128;

std::vector<int> ascending(std::size_t count, int first) {
  std::vector<int> out(count);
  std::iota(out.begin(), out.end(), first);
  return out;
}

}  // namespace

std::shared_ptr<const ElementBlock> some_elements(const ElementBlock& block,
                                                  const std::vector<Node>& nodes,
                                                  const std::vector<int>& elements) {
  const std::vector<int> same_nodes = ascending(nodes.size(), 0);
  if (const auto* solids = dynamic_cast<const SolidBlock*>(&block)) {
    return std::make_shared<const SolidBlock>(solids->subset(elements, same_nodes));
  }
  const auto& shells = dynamic_cast<const ShellBlock&>(block);
  return std::make_shared<const ShellBlock>(shells.subset(elements, same_nodes));
}

ElementPieces::ElementPieces(const ElementBlock& block, const std::vector<Node>& nodes)
    : block_(&block),
      solids_(dynamic_cast<const SolidBlock*>(&block)),
      shells_(dynamic_cast<const ShellBlock*>(&block)) {
  if (solids_ == nullptr && shells_ == nullptr) return;
  if (block.num_elements() <= kElementsOfPiece) return;
  count_ = (block.num_elements() + kElementsOfPiece - 1) / kElementsOfPiece;
  same_nodes_ = ascending(nodes.size(), 0);
}

int ElementPieces::begin(int piece) const {
  return piece == count_ ? block_->num_elements() : piece * kElementsOfPiece;
}

void ElementPieces::visit(
    int piece, const std::function<void(const ElementBlock& piece, int first)>& visit) const {
  if (count_ == 1) return visit(*block_, 0);
  const int first = begin(piece);
  const auto size = static_cast<std::size_t>(begin(piece + 1) - first);
  const std::vector<int> elements = ascending(size, first);
  if (solids_ != nullptr) {
    visit(solids_->subset(elements, same_nodes_), first);
  } else {
    visit(shells_->subset(elements, same_nodes_), first);
  }
}

}  // namespace buckens::fem
