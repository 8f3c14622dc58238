// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "buckens/fem/element/block.h"

namespace buckens::fem {

class ShellBlock;
class SolidBlock;

/// A block of solids or shells in pieces of a hundred elements or so, in their order; another block
/// is one piece. What elements add to a matrix is listed piece by piece, several pieces at once
/// where there are threads, so that lists stay small beside the matrix. The pieces do not depend on
/// the number of threads.
class ElementPieces {
 public:
  /// @param block,nodes outlive this object
  ElementPieces(const ElementBlock& block, const std::vector<Node>& nodes);

  int count() const { return count_; }
  /// First element of a piece, or behind the last piece the number of elements.
  int begin(int piece) const;
  /// Calls visit(piece, first), `first` being the number of its first element in the block. From
  /// any thread.
  void visit(int piece,
             const std::function<void(const ElementBlock& piece, int first)>& visit) const;

 private:
  const ElementBlock* block_;
  const SolidBlock* solids_;  // null: it is none, as below
  const ShellBlock* shells_;
  int count_ = 1;
  std::vector<int> same_nodes_;
};

/// Some elements of a block of solids or shells, in their order, with the numbers of all nodes.
std::shared_ptr<const ElementBlock> some_elements(const ElementBlock& block,
                                                  const std::vector<Node>& nodes,
                                                  const std::vector<int>& elements);

}  // namespace buckens::fem
