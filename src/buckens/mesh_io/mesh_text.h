// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

namespace buckens::mesh_io {

/// Reads a mesh file sequentially, text and binary parts, keeping track of the line.
///
/// Whatever the bytes are, it never reads beyond their end and returns only finite numbers in the
/// requested range; everything else is an InputError with file, line and column.
class MeshText {
 public:
  /// @param bytes must outlive this object
  /// @param file its name in messages
  MeshText(std::string_view bytes, std::string file) : bytes_(bytes), file_(std::move(file)) {}

  bool at_end() const { return place_ >= bytes_.size(); }
  std::size_t place() const { return place_; }
  std::size_t remaining() const { return bytes_.size() - place_; }
  int line() const { return line_; }

  /// The rest of the line without its end. @param what for the message if nothing is left
  std::string_view next_line(std::string_view what);
  /// The next line, without consuming it; empty at the end.
  std::string_view peek_line() const;
  /// The next word, skipping line ends.
  std::string_view word(std::string_view what);
  /// A word, or text between double quotes.
  std::string quoted(std::string_view what);

  std::int64_t integer(std::string_view what,
                       std::int64_t least = std::numeric_limits<std::int64_t>::min(),
                       std::int64_t most = std::numeric_limits<std::int64_t>::max());
  /// A count of items that each take at least so many bytes.
  std::size_t count(std::string_view what, std::size_t bytes_each);
  double number(std::string_view what);

  /// A value of a binary part.
  template <class T>
  T binary(std::string_view what) {
    T out;
    require(sizeof out, what);
    std::memcpy(&out, bytes_.data() + place_, sizeof out);
    place_ += sizeof out;
    return out;
  }
  /// A count of a binary part, as count().
  std::size_t binary_count(std::string_view what, std::size_t bytes_each);
  double binary_number(std::string_view what);
  /// An integer of a binary part in a range.
  template <class T>
  std::int64_t binary_integer(std::string_view what, std::int64_t least, std::int64_t most) {
    const T value = binary<T>(what);
    const bool fits = std::in_range<std::int64_t>(value);
    check_range(what, fits ? static_cast<std::int64_t>(value) : -1, least, most);
    return static_cast<std::int64_t>(value);
  }

  /// Skips past the next line that is `mark`. @return false if there is none
  /// @param after_bytes the mark may also follow binary data without a line end between
  bool skip_to(std::string_view mark, bool after_bytes = false);

  /// @throws InputError at the last word read
  [[noreturn]] void fail(const std::string& text) const;

 private:
  void skip_blanks();
  void require(std::size_t size, std::string_view what) const;
  void check_count(std::string_view what, std::uint64_t count, std::size_t bytes_each) const;
  void check_range(std::string_view what, std::int64_t value, std::int64_t least,
                   std::int64_t most) const;

  std::string_view bytes_;
  std::string file_;
  std::size_t place_ = 0;
  std::size_t line_start_ = 0;
  std::size_t word_start_ = 0;
  int line_ = 1;
  int word_line_ = 1;
};

}  // namespace buckens::mesh_io
