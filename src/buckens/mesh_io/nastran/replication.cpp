// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/nastran/replication.h"

#include <cstdlib>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/mesh_io/nastran/number.h"

namespace buckens::mesh_io {

namespace {

constexpr std::int64_t kMostCopies = 1000000;

[[noreturn]] void refuse_copy(const NastranLine& line, const std::string& text) {
  throw InputError({line.file->name, line.number, 1}, text);
}

/// "4" of "4" and of "(4)".
std::string_view in_brackets(std::string_view text) {
  if (text.starts_with('(') && text.ends_with(')')) return trimmed(text.substr(1, text.size() - 2));
  return text;
}

/// A real number as a field takes it: with a decimal point.
std::string real_text(double value) {
  std::string out = fmt::format("{}", value);
  if (out.find_first_of(".e") == std::string::npos) out += '.';
  return out;
}

}  // namespace

std::string_view NastranReplication::keep(std::string text) {
  return texts_.emplace_back(std::move(text));
}

void NastranReplication::take(NastranRow& row) {
  bool copies_rest = false;
  for (std::size_t i = 0; i < NastranRow::kSize && !before_.head.empty(); ++i) {
    copies_rest = copies_rest || row.data[i] == "==";
    if (copies_rest) row.data[i] = before_.data[i];
  }
  before_ = row;
}

void NastranReplication::begin(const NastranRow& row, const NastranLine& line) {
  if (before_.head.empty()) refuse_copy(line, "\"=\" repeats the line before, but there is none");
  const std::string_view count = in_brackets(row.head.substr(1));
  copies_left_ = 1;
  if (!count.empty() && count != "=") {
    const auto number = nastran_integer(count);
    if (!number || *number < 1) {
      refuse_copy(
          line, fmt::format("{} is not a number of copies, such as =3", quoted_excerpt(row.head)));
    }
    copies_left_ = *number;
  }
  bool says_how = count == "=" || !row.mark.empty();
  for (const std::string_view field : row.data) says_how = says_how || !field.empty();
  if (says_how) {
    pattern_ = row;
  } else if (!pattern_.repeats()) {
    refuse_copy(line, "\"=n\" repeats a line of \"=\" before it, but there is none");
  }
  num_copies_ += copies_left_;
  if (num_copies_ > kMostCopies) {
    refuse_copy(line, fmt::format("more than {} lines are repetitions", kMostCopies));
  }
}

std::string_view NastranReplication::sum(std::string_view before, std::string_view step,
                                         const NastranLine& line) {
  const auto whole = nastran_integer(before), whole_step = nastran_integer(step);
  constexpr std::int64_t kMost = std::int64_t{1} << 40;
  if (whole && whole_step && std::abs(*whole) < kMost && std::abs(*whole_step) < kMost) {
    return keep(fmt::format("{}", *whole + *whole_step));
  }
  const auto value = before.empty() ? std::optional(0.0) : nastran_real(before);
  const auto real_step = nastran_real(step);
  if (!value || !real_step) {
    refuse_copy(line, fmt::format("{} cannot be added to {}", quoted_excerpt(step),
                                  quoted_excerpt(before)));
  }
  return keep(real_text(*value + *real_step));
}

/// @param step what the field before added; set to what this one adds
std::string_view NastranReplication::field(std::string_view before, std::string_view pattern,
                                           std::string_view& step, const NastranLine& line) {
  if (pattern == "=") return before;
  if (pattern == "/" && !step.empty()) return sum(before, step, line);
  if (pattern.starts_with('*') && pattern.size() > 1) {
    step = in_brackets(pattern.substr(1));
    return sum(before, step, line);
  }
  if (!pattern.starts_with('%')) return pattern;
  const auto last = nastran_real(in_brackets(pattern.substr(1)));
  const auto now = before.empty() ? std::optional(0.0) : nastran_real(before);
  if (!last || !now) refuse_copy(line, fmt::format("{} is not a number", quoted_excerpt(pattern)));
  return keep(real_text(*now + (*last - *now) / static_cast<double>(copies_left_)));
}

NastranRow NastranReplication::next(const NastranLine& line) {
  NastranRow out = before_;
  out.more.clear();
  out.mark = pattern_.mark;
  std::string_view step;
  bool copies_rest = pattern_.head == "==";
  for (std::size_t i = 0; i < NastranRow::kSize; ++i) {
    copies_rest = copies_rest || pattern_.data[i] == "==";
    if (!copies_rest) out.data[i] = field(before_.data[i], pattern_.data[i], step, line);
  }
  --copies_left_;
  before_ = out;
  return out;
}

}  // namespace buckens::mesh_io
