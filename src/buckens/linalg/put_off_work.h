// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

namespace buckens::linalg {

/// Tasks on rows of vectors (RowProgram) that nobody waits for, of all bodies in the order in which
/// they were asked for. They go to the other processes with the next tasks that bring sums, and
/// before any other order that depends on them: one that takes a vector or a pair, or that ends
/// what they name. All of it with the turn of the plug-in.
class PutOffWork {
 public:
  /// @param space of the body, see DividedVectors
  static void add(int space, std::span<const std::byte> tasks);
  /// Has the others do them. @throws NumericalError if memory is too small
  static void finish() { finish_with_sums(0, nullptr); }
  /// The same before something is forgotten, where no error can be thrown: the next of the others
  /// throws it.
  static void finish_at_end() noexcept;
  /// The same. @param sums of each process, one after the other
  static void finish_with_sums(std::size_t sums_each, double* sums);
};

}  // namespace buckens::linalg
