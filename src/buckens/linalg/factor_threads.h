// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace buckens::linalg {

/// While it lives, factorisations that the calling thread begins share their work among as many
/// threads, where they are large enough; without one, they use the calling thread alone. No bit of
/// a factor depends on it. May be nested: the inner one counts.
class FactorThreads {
 public:
  /// @param threads ≥ 1, the calling one included
  explicit FactorThreads(int threads);
  ~FactorThreads();
  FactorThreads(const FactorThreads&) = delete;
  FactorThreads& operator=(const FactorThreads&) = delete;

  /// Threads for a factorisation of the calling thread.
  static int allowed();

 private:
  int before_;
};

}  // namespace buckens::linalg
