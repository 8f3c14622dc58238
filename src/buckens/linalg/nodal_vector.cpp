// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/nodal_vector.h"

#include <mutex>

#include "buckens/linalg/row_program.h"

namespace buckens::linalg {

namespace {
std::mutex& turn_to_bring() {
  static std::mutex turn;
  return turn;
}
}  // namespace

NodalVector::NodalVector(std::shared_ptr<DividedVectors> of, DividedVector there)
    : shared_(new Memory(Vector())) {
  shared_->of = std::move(of);
  shared_->there = std::move(there);
  shared_->is_elsewhere.store(true, std::memory_order_release);
}

Eigen::Index NodalVector::size() const {
  if (shared_ == nullptr) return own_.size();
  return shared_->of != nullptr ? shared_->of->size() : shared_->numbers.size();
}

std::vector<Vector> NodalVector::row_products(std::initializer_list<const NodalVector*> vectors) {
  // Brought or not: who has looked at them does not change a bit of the products.
  const std::shared_ptr<DividedVectors> of = (*vectors.begin())->others();
  if (!of) return {};
  std::vector<const DividedVector*> there;
  for (const NodalVector* x : vectors) {
    if (x->others() != of) return {};
    there.push_back(&x->shared_->there);
  }
  RowProgram program(*of);
  const RowProgram::Sums products = program.row_products(there);
  program.run();
  const Vector all = program.sum(products);
  std::vector<Vector> out;
  const auto count = static_cast<Eigen::Index>(there.size());
  for (Eigen::Index k = 0; k < count; ++k) {
    out.emplace_back(all.segment(k * all.size() / count, all.size() / count));
  }
  return out;
}

Vector NodalVector::some(std::span<const int> which) const {
  if (shared_ != nullptr && shared_->is_elsewhere.load(std::memory_order_acquire)) {
    RowProgram program(*shared_->of);
    const RowProgram::Sums picked = program.pick(shared_->there, which);
    program.run();
    return program.sum(picked);
  }
  const Vector& numbers = whole();
  Vector out(static_cast<Eigen::Index>(which.size()));
  for (std::size_t k = 0; k < which.size(); ++k) {
    out[static_cast<Eigen::Index>(k)] = numbers[which[k]];
  }
  return out;
}

void NodalVector::bring() const {
  const std::scoped_lock lock(turn_to_bring());
  if (!shared_->is_elsewhere.load(std::memory_order_acquire)) return;
  shared_->of->take(shared_->there, shared_->numbers);
  shared_->is_elsewhere.store(false, std::memory_order_release);
}

Vector NodalVector::copied() const {
  if (shared_ == nullptr || !shared_->is_elsewhere.load(std::memory_order_acquire)) return whole();
  Vector out;
  shared_->of->take(shared_->there, out);
  return out;
}

void NodalVector::stay_here() {
  shared_->of = nullptr;
  shared_->there = {};
  shared_->is_elsewhere.store(false, std::memory_order_release);
}

DividedVector NodalVector::divided(const std::shared_ptr<DividedVectors>& of) const {
  if (shared_->of == of) return shared_->there;
  const Vector& numbers = whole();
  const std::scoped_lock lock(turn_to_bring());
  if (shared_->of != of) {
    shared_->there = of->put(numbers);
    shared_->of = of;
  }
  return shared_->there;
}

Vector& NodalVector::change() {
  (void)whole();
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
    shared_ = new Memory(std::move(numbers));
  }
}

void NodalVector::let_go() {
  if (shared_->holders.fetch_sub(1, std::memory_order_acq_rel) == 1) delete shared_;
  shared_ = nullptr;
}

}  // namespace buckens::linalg
