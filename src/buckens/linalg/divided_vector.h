// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>
#include <vector>

namespace buckens::linalg {

class DividedVectors;

/// A vector of the variables of a body of which other processes have the rows (DividedVectors);
/// empty if default-made. Copies are the same vector, which lives as long as one of them.
class DividedVector {
 public:
  DividedVector() = default;
  bool empty() const { return held_ == nullptr; }
  /// By which the other processes know it.
  int number() const { return held_->number; }

 private:
  friend class DividedVectors;
  struct Held {
    Held(std::shared_ptr<std::vector<int>> of, int which) : dropped(std::move(of)), number(which) {}
    ~Held() { dropped->push_back(number); }
    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;

    std::shared_ptr<std::vector<int>> dropped;  // of its body: those that are gone
    int number;
  };
  std::shared_ptr<Held> held_;
};

}  // namespace buckens::linalg
