// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace buckens::base {

/// Puts numbers into bytes that another process of the same run reads.
class BytesTo {
 public:
  template <class T>
  void operator()(const T& value) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
    put(&value, sizeof value);
  }
  /// `count` numbers, which take_all() takes.
  template <class T>
  void all(const T* values, std::size_t count) {
    static_assert(std::is_arithmetic_v<T> || std::is_same_v<T, std::byte>);
    put(values, count * sizeof *values);
  }
  std::span<const std::byte> bytes() const { return bytes_; }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  void put(const void* from, std::size_t count) {
    const std::size_t at = bytes_.size();
    if (count > kMany) bytes_.reserve(at + count);  // growth would double it
    bytes_.resize(at + count);
    if (count > 0) std::memcpy(bytes_.data() + at, from, count);
  }

  static constexpr std::size_t kMany = std::size_t{1} << 16;

  std::vector<std::byte> bytes_;
};

/// Takes them out again, in the same order.
class BytesFrom {
 public:
  explicit BytesFrom(std::span<const std::byte> bytes) : bytes_(bytes) {}
  template <class T>
  void operator()(T& value) {
    take_all(&value, 1);
  }
  template <class T>
  T next() {
    T value{};
    (*this)(value);
    return value;
  }
  template <class T>
  void take_all(T* values, std::size_t count) {
    if (count > 0) std::memcpy(values, bytes_.data(), count * sizeof *values);
    bytes_ = bytes_.subspan(count * sizeof *values);
  }
  bool is_at_end() const { return bytes_.empty(); }

 private:
  std::span<const std::byte> bytes_;
};

}  // namespace buckens::base
