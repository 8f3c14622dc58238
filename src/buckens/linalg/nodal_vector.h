// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <initializer_list>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "buckens/linalg/divided_vector.h"
#include "buckens/linalg/matrix_types.h"

namespace buckens::linalg {

/// Numbers of the nodes of a body. Copies of a long vector share its memory until one of them is
/// written to; short ones are copied, which costs less than counting who shares them.
///
/// The numbers may also be held by other processes (DividedVectors): whole() then brings them here,
/// once; writing to them makes them numbers of this process only.
///
/// What whole() returns is valid until the object is written to or destroyed. What change() and
/// overwrite() return is to be written to before the object is copied or given to other processes:
/// later the copies would change as well, and the numbers of other processes would not.
///
/// Copies of one vector may be used by several threads; one object may be read by several threads
/// at a time, but written to or copied from only while no other thread writes to it.
class NodalVector {
 public:
  static constexpr Eigen::Index kShared = 64;  ///< with so many numbers copies share memory

  NodalVector() = default;
  // NOLINTBEGIN(google-explicit-constructor): they are such numbers
  NodalVector(Vector numbers) { take(std::move(numbers)); }
  template <class Derived>
  NodalVector(const Eigen::MatrixBase<Derived>& numbers) : NodalVector(Vector(numbers)) {}
  // NOLINTEND(google-explicit-constructor)
  /// One that other processes have. @pre it has at least kShared numbers
  NodalVector(std::shared_ptr<DividedVectors> of, DividedVector there);
  NodalVector(const NodalVector& other) : own_(other.own_), shared_(other.hold()) {}
  NodalVector(NodalVector&& other) noexcept
      : own_(std::move(other.own_)), shared_(std::exchange(other.shared_, nullptr)) {}
  ~NodalVector() { release(); }

  NodalVector& operator=(const NodalVector& other) {  // NOLINT: itself is no harm
    if (shared_ != other.shared_) {
      release();
      shared_ = other.hold();
    }
    own_ = other.own_;
    return *this;
  }
  NodalVector& operator=(NodalVector&& other) noexcept {
    swap(other);
    return *this;
  }
  NodalVector& operator=(Vector&& numbers) { return *this = NodalVector(std::move(numbers)); }
  /// Reuses memory that no copy shares. `numbers` may read this vector as with Eigen.
  template <class Derived>
  NodalVector& operator=(const Eigen::MatrixBase<Derived>& numbers) {
    if (!can_write(numbers.size())) return *this = NodalVector(numbers);
    numbers_here() = numbers.derived();
    return *this;
  }
  void swap(NodalVector& other) noexcept {
    own_.swap(other.own_);
    std::swap(shared_, other.shared_);
  }

  const Vector& whole() const {
    if (shared_ == nullptr) return own_;
    if (shared_->is_elsewhere.load(std::memory_order_acquire)) bring();
    return shared_->numbers;
  }
  /// The same for those who need them once: nothing stays here that was not here before.
  Vector copied() const;
  /// The same numbers as a vector of other processes, to whom they are given if they have not got
  /// them. @pre at least kShared of them
  DividedVector divided(const std::shared_ptr<DividedVectors>& of) const;
  // NOLINTNEXTLINE(google-explicit-constructor): for all that reads vectors
  operator const Vector&() const { return whole(); }
  /// The vectors of other processes that this is one of, whether its numbers are here as well or
  /// not; null: it is none.
  std::shared_ptr<DividedVectors> others() const {
    return shared_ != nullptr ? shared_->of : nullptr;
  }
  /// Products of the rows N of a body with some of its vectors, by one order, if other processes
  /// have all of them, so that they need not come here. Otherwise empty.
  static std::vector<Vector> row_products(std::initializer_list<const NodalVector*> vectors);
  /// Some of the numbers. If other processes have them, only these come here, by one order.
  Vector some(std::span<const int> which) const;
  Eigen::Index size() const;
  double operator[](Eigen::Index k) const { return whole()[k]; }
  double norm() const { return whole().norm(); }

  /// For changing numbers: the present ones, in memory that no copy shares.
  Vector& change();
  /// For writing all numbers anew: `size` undefined ones, in memory that no copy shares.
  Vector& overwrite(Eigen::Index size);
  /// Whether another object has the same memory.
  bool is_shared() const {
    // Acquires what threads that shared it did before they let go: it will be written to.
    return shared_ != nullptr && shared_->holders.load(std::memory_order_acquire) > 1;
  }

 private:
  struct Memory {
    explicit Memory(Vector own) : numbers(std::move(own)) {}
    Vector numbers;
    std::atomic<int> holders{1};
    // Whether only other processes have the numbers; who has them, if they do; which they are.
    std::atomic<bool> is_elsewhere{false};
    std::shared_ptr<DividedVectors> of;
    DividedVector there;
  };

  /// To be written to.
  Vector& numbers_here() {
    if (shared_ == nullptr) return own_;
    if (shared_->of != nullptr) stay_here();
    return shared_->numbers;
  }
  void bring() const;
  void stay_here();
  /// Whether this memory may be written to and is of the kind for so many numbers.
  bool can_write(Eigen::Index size) const {
    return (shared_ != nullptr) == (size >= kShared) && !is_shared();
  }
  void take(Vector&& numbers);
  Memory* hold() const {
    if (shared_ != nullptr) shared_->holders.fetch_add(1, std::memory_order_relaxed);
    return shared_;
  }
  void release() {
    if (shared_ != nullptr) let_go();
  }
  void let_go();

  Vector own_;                // the numbers unless shared_ has them
  Memory* shared_ = nullptr;  // freed by the last of its holders
};

inline void swap(NodalVector& a, NodalVector& b) noexcept { a.swap(b); }

}  // namespace buckens::linalg
