// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/nastran/card.h"

#include <algorithm>
#include <functional>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/mesh_io/nastran/number.h"

namespace buckens::mesh_io {

namespace {

constexpr std::int64_t kLargestId = 999999999999999;  // of which a double holds each

}  // namespace

std::string_view NastranCard::text(int i) const {
  if (blank(i)) return {};
  const NastranField& field = fields[static_cast<std::size_t>(i)];
  return {field.begin, field.size};
}

std::string NastranCard::word(int i) const { return upper_case(text(i)); }

bool NastranCard::is_integer(int i) const { return nastran_integer(text(i)).has_value(); }

bool NastranCard::is_word(int i) const {
  if (blank(i)) return false;
  const char c = text(i)[0];
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

std::int64_t NastranCard::integer(int i) const {
  if (blank(i)) fail(i, "is blank; expected an integer");
  const auto value = nastran_integer(text(i));
  if (!value) fail(i, fmt::format("{} is not an integer", quoted_excerpt(text(i))));
  return *value;
}

std::int64_t NastranCard::integer(int i, std::int64_t otherwise) const {
  return blank(i) ? otherwise : integer(i);
}

std::int64_t NastranCard::id(int i) const {
  const std::int64_t value = integer(i);
  if (value < 1 || value > kLargestId) {
    fail(i, fmt::format("{} is not a number from 1 to {}", value, kLargestId));
  }
  return value;
}

std::int64_t NastranCard::id(int i, std::int64_t otherwise) const {
  return blank(i) ? otherwise : id(i);
}

double NastranCard::real(int i) const {
  if (blank(i)) fail(i, "is blank; expected a number");
  const auto value = nastran_real(text(i));
  if (!value) {
    fail(i, fmt::format("{} is not a number; write 1.5, 1.5E-3 or 1.5-3", quoted_excerpt(text(i))));
  }
  return *value;
}

double NastranCard::real(int i, double otherwise) const { return blank(i) ? otherwise : real(i); }

double NastranCard::positive(int i) const {
  const double value = real(i);
  if (!(value > 0)) fail(i, fmt::format("{:g} must be greater than zero", value));
  return value;
}

SourceLocation NastranCard::where(int i) const {
  if (blank(i)) return where();
  const NastranField& field = fields[static_cast<std::size_t>(i)];
  int column = 1;
  // Text that a repetition made has no place in the file.
  const std::less<> is_before;
  const char* const end = file->text.data() + file->text.size();
  if (is_before(field.begin, file->text.data()) || !is_before(field.begin, end)) {
    return {file->name, static_cast<int>(field.line), column};
  }
  for (const char* c = field.begin; c != file->text.data() && *(c - 1) != '\n'; --c) ++column;
  return {file->name, static_cast<int>(field.line), column};
}

void NastranCard::fail(int i, const std::string& text) const {
  const std::string row = i < 8 ? "" : fmt::format(" of continuation {}", i / 8);
  throw InputError(where(i), fmt::format("{}, field {}{}: {}", label(), i % 8 + 2, row, text));
}

void NastranCard::fail(const std::string& text) const {
  throw InputError(where(), fmt::format("{}: {}", label(), text));
}

NastranCard NastranCard::second_half() const {
  NastranCard out = *this;
  out.fields.erase(out.fields.begin(), out.fields.begin() + std::min<std::ptrdiff_t>(4, size()));
  return out;
}

std::string NastranCard::label() const {
  return is_integer(0) ? fmt::format("{} {}", name, integer(0)) : name;
}

}  // namespace buckens::mesh_io
