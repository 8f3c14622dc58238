// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/mesh_text.h"

#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/files/deck_number.h"

namespace buckens::mesh_io {

namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f';
}

/// A word for a message: short, and without control characters.
std::string shown(std::string_view word) {
  std::string out;
  for (const char c : word.substr(0, 40)) {
    out += static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e ? '?' : c;
  }
  return out + (word.size() > 40 ? "..." : "");
}

}  // namespace

void MeshText::fail(const std::string& text) const {
  const std::size_t at = std::max(word_start_, line_start_);
  throw InputError({file_, word_line_, static_cast<int>(at - line_start_) + 1}, text);
}

void MeshText::require(std::size_t size, std::string_view what) const {
  if (remaining() >= size) return;
  fail(fmt::format("the file ends in the middle of its data, where {} is expected", what));
}

void MeshText::check_count(std::string_view what, std::uint64_t count,
                           std::size_t bytes_each) const {
  if (count <= remaining() / bytes_each) return;
  fail(fmt::format("{} would be {}, more than the rest of the file ({} bytes) can hold", what,
                   count, remaining()));
}

void MeshText::check_range(std::string_view what, std::int64_t value, std::int64_t least,
                           std::int64_t most) const {
  if (value >= least && value <= most) return;
  fail(fmt::format("{} cannot be {}", what, value));
}

std::string_view MeshText::peek_line() const {
  const std::size_t end = std::min(bytes_.find('\n', place_), bytes_.size());
  std::string_view out = bytes_.substr(std::min(place_, bytes_.size()), end - place_);
  while (!out.empty() && is_blank(out.back())) out.remove_suffix(1);
  return out;
}

std::string_view MeshText::next_line(std::string_view what) {
  line_start_ = word_start_ = place_;
  word_line_ = line_;
  require(1, what);
  const std::string_view out = peek_line();
  const std::size_t end = bytes_.find('\n', place_);
  place_ = end == std::string_view::npos ? bytes_.size() : end + 1;
  if (end != std::string_view::npos) ++line_;
  return out;
}

void MeshText::skip_blanks() {
  while (place_ < bytes_.size() && is_blank(bytes_[place_])) {
    if (bytes_[place_] == '\n') {
      ++line_;
      line_start_ = place_ + 1;
    }
    ++place_;
  }
  word_start_ = place_;
  word_line_ = line_;
}

std::string_view MeshText::word(std::string_view what) {
  skip_blanks();
  require(1, what);
  while (place_ < bytes_.size() && !is_blank(bytes_[place_])) ++place_;
  return bytes_.substr(word_start_, place_ - word_start_);
}

std::string MeshText::quoted(std::string_view what) {
  skip_blanks();
  require(1, what);
  if (bytes_[place_] != '"') return std::string(word(what));
  const std::size_t end = bytes_.find_first_of("\"\n", place_ + 1);
  if (end == std::string_view::npos || bytes_[end] == '\n') {
    fail(fmt::format("the closing quotation mark of {} is missing", what));
  }
  const std::string_view out = bytes_.substr(place_ + 1, end - place_ - 1);
  place_ = end + 1;
  return std::string(out);
}

std::int64_t MeshText::integer(std::string_view what, std::int64_t least, std::int64_t most) {
  std::string_view text = word(what);
  // Some programs write no blank between a number and a name in quotation marks.
  const std::size_t quote = text.find('"');
  if (quote != std::string_view::npos && quote > 0) {
    place_ -= text.size() - quote;
    text = text.substr(0, quote);
  }
  const std::string_view digits = text.starts_with('+') ? text.substr(1) : text;
  std::int64_t out = 0;
  const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), out);
  if (result.ec != std::errc() || result.ptr != digits.data() + digits.size()) {
    fail(fmt::format("expected {1}, a whole number, found \"{0}\"", shown(text), what));
  }
  check_range(what, out, least, most);
  return out;
}

std::size_t MeshText::count(std::string_view what, std::size_t bytes_each) {
  const auto out =
      static_cast<std::uint64_t>(integer(what, 0, std::numeric_limits<std::int64_t>::max()));
  check_count(what, out, bytes_each);
  return static_cast<std::size_t>(out);
}

double MeshText::number(std::string_view what) {
  const std::string_view text = word(what);
  const auto out = files::deck_number(text);
  if (!out) {
    fail(fmt::format("expected {1}, a finite number, found \"{0}\"", shown(text), what));
  }
  return *out;
}

std::size_t MeshText::binary_count(std::string_view what, std::size_t bytes_each) {
  const auto out = binary<std::uint64_t>(what);
  check_count(what, out, bytes_each);
  return static_cast<std::size_t>(out);
}

double MeshText::binary_number(std::string_view what) {
  const double out = binary<double>(what);
  if (!std::isfinite(out)) fail(fmt::format("{} is not a finite number", what));
  return out;
}

bool MeshText::skip_to(std::string_view mark, bool after_bytes) {
  for (std::size_t at = bytes_.find(mark, place_); at != std::string_view::npos;
       at = bytes_.find(mark, at + 1)) {
    const bool begins_line = after_bytes || at == 0 || bytes_[at - 1] == '\n';
    const std::size_t end = at + mark.size();
    if (!begins_line || (end < bytes_.size() && !is_blank(bytes_[end]))) continue;
    for (; place_ < at; ++place_) line_ += bytes_[place_] == '\n' ? 1 : 0;
    next_line(mark);
    return true;
  }
  return false;
}

}  // namespace buckens::mesh_io
