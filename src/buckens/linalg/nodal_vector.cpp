// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/nodal_vector.h"

namespace buckens::linalg {

Vector& NodalVector::change() {
  if (is_shared()) *this = NodalVector(Vector(whole()));
  return numbers_here();
}

Vector& NodalVector::overwrite(Eigen::Index size) {
  if (!can_write(size)) *this = NodalVector(Vector(size));
  Vector& numbers = numbers_here();
  numbers.resize(size);
  return numbers;
}

void NodalVector::take(Vector&& numbers) {
  if (numbers.size() < kShared) {
    own_ = std::move(numbers);
  } else {
    shared_ = new Memory{std::move(numbers)};
  }
}

void NodalVector::let_go() {
  if (shared_->holders.fetch_sub(1, std::memory_order_acq_rel) == 1) delete shared_;
  shared_ = nullptr;
}

}  // namespace buckens::linalg
