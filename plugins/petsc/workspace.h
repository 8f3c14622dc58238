// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace buckens_petsc {

/// Address space whose memory is there when it is used, and can be given back.
class Workspace {
 public:
  Workspace() = default;
  ~Workspace() { set_aside(0); }
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  /// @return whether it was possible; what was there before goes
  bool set_aside(std::size_t numbers);
  /// Gives back what is behind the first numbers.
  void keep(std::size_t numbers);
  double* data() const { return data_; }

 private:
  double* data_ = nullptr;
  std::size_t bytes_ = 0;
};

}  // namespace buckens_petsc
