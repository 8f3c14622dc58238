// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/nastran/row.h"

#include <algorithm>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/mesh_io/nastran/number.h"

namespace buckens::mesh_io {

namespace {

using Fields = std::vector<std::string_view>;

bool is_large(std::string_view head) { return head.starts_with('*') || head.ends_with('*'); }

bool is_gap(char c) { return c == ' ' || c == '\t'; }

bool is_figure(char c) { return c >= '0' && c <= '9'; }

/// A formula, which has no fields.
bool is_equation(std::string_view text) { return upper_case(text.substr(0, 6)) == "DEQATN"; }

/// A tab ends a field of eight columns, so that the text of a field is in one piece all the same.
NastranRow split_columns(const NastranLine& line) {
  NastranRow row;
  std::array<std::string_view, 10> fields;
  std::size_t column = 0, width = 8;
  const std::string_view text = line.text;
  for (std::size_t i = 0; i < text.size() && column < 80; ++i) {
    const char c = text[i];
    if (c == '\t') {
      column = (column / 8 + 1) * 8;
      continue;
    }
    // The head is complete when its ninth column is reached, by whatever way.
    if (column >= 8 && width == 8 && is_large(fields[0])) width = 16;
    const std::size_t at = column < 8 ? 0 : column >= 72 ? 9 : 1 + (column - 8) / width;
    ++column;
    if (c == ' ') continue;
    std::string_view& field = fields[at];
    const std::size_t begin =
        field.empty() ? i : static_cast<std::size_t>(field.data() - text.data());
    field = text.substr(begin, i + 1 - begin);
  }
  row.head = fields[0];
  row.num_data = is_large(row.head) ? 4 : NastranRow::kSize;
  std::copy_n(fields.begin() + 1, NastranRow::kSize, row.data.begin());
  row.mark = fields[9];
  return row;
}

bool is_mark(std::string_view field) {
  if (field.empty() || (field[0] != '+' && field[0] != '*')) return false;
  return !nastran_real(field);
}

/// What stands between two commas: one field, or several with blanks between.
void add_fields(std::string_view text, Fields& out) {
  text = trimmed(text);
  // "1. -1" is two numbers, "1. E-1" is one.
  const bool is_one_number =
      text.find_first_of("eEdD") != std::string_view::npos && nastran_real(text).has_value();
  if (std::none_of(text.begin(), text.end(), is_gap) || is_one_number) {
    out.push_back(text);
    return;
  }
  while (!text.empty()) {
    const auto end =
        static_cast<std::size_t>(std::find_if(text.begin(), text.end(), is_gap) - text.begin());
    out.push_back(text.substr(0, end));
    text = trimmed(text.substr(end));
  }
}

/// `8)246` puts a value into field 8; what follows goes on from there.
void place_fields(Fields& fields) {
  Fields out;
  for (const std::string_view field : fields) {
    const std::size_t close = field.find(')');
    const bool is_placed = close == 1 && is_figure(field[0]) && field[0] != '0';
    if (is_placed) {
      const auto place = static_cast<std::size_t>(field[0] - '1');
      if (place > out.size()) out.resize(place);
    }
    out.push_back(is_placed ? field.substr(close + 1) : field);
  }
  fields = std::move(out);
}

/// `///` in a line that repeats another is three fields `/`.
void part_slashes(Fields& fields) {
  Fields out;
  for (const std::string_view field : fields) {
    const bool is_many = field.size() > 1 && field.find_first_not_of('/') == field.npos;
    for (std::size_t k = 0; is_many && k < field.size(); ++k) out.push_back(field.substr(k, 1));
    if (!is_many) out.push_back(field);
  }
  fields = std::move(out);
}

Fields free_fields(std::string_view text) {
  Fields out;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    add_fields(text.substr(begin, end - begin), out);
    begin = end + 1;
  }
  if (text.find(')') != std::string_view::npos) place_fields(out);
  if (out[0].starts_with('=')) part_slashes(out);
  while (out.size() > 1 && out.back().empty()) out.pop_back();
  return out;
}

/// Removes the continuation mark from a free line, if it has one.
std::string_view take_mark(const NastranLine& line, const NastranRow& row, Fields& fields) {
  const std::size_t place = row.num_data + 1;
  const auto is_sign = [&](std::string_view field) {
    return row.repeats() ? field.starts_with('+') : is_mark(field);
  };
  std::string_view mark;
  // After the four of a large field a number is data that should be on the next line.
  const bool is_behind = fields.size() == place + 1 &&
                         (row.num_data == NastranRow::kSize || !nastran_real(fields.back()));
  if (is_behind || (fields.size() > 1 && is_sign(fields.back()))) {
    mark = fields.back();
    fields.pop_back();
  }
  for (std::size_t i = place; i < fields.size(); ++i) {
    if (!is_mark(fields[i])) continue;
    throw InputError({line.file->name, line.number, 1},
                     fmt::format("more than ten fields in one line; {} does not fit. Break the "
                                 "card into continuation lines",
                                 quoted_excerpt(fields[i])));
  }
  return mark;
}

NastranRow split_commas(const NastranLine& line) {
  NastranRow row;
  Fields fields = free_fields(line.text);
  // A line that continues a card with data in its first place.
  const std::string_view head = fields[0];
  const bool begins_with_data =
      !head.empty() && (is_figure(head[0]) || (head[0] != '=' && head.find('=') != head.npos));
  if (begins_with_data) fields.insert(fields.begin(), std::string_view());
  row.head = fields[0];
  row.num_data = is_large(row.head) && !row.repeats() ? 4 : NastranRow::kSize;
  row.mark = take_mark(line, row, fields);
  const std::size_t count = std::min(fields.size() - 1, row.num_data);
  std::copy_n(fields.begin() + 1, count, row.data.begin());
  row.more.assign(fields.begin() + 1 + static_cast<std::ptrdiff_t>(count), fields.end());
  return row;
}

bool has_comma(const NastranLine& line) { return line.text.find(',') != std::string_view::npos; }

}  // namespace

NastranRow split_nastran_line(const NastranLine& line) {
  if (is_equation(trimmed(line.text))) {
    NastranRow row;
    row.head = trimmed(line.text).substr(0, 6);
    return row;
  }
  return has_comma(line) ? split_commas(line) : split_columns(line);
}

bool continues_nastran_card(const NastranLine& line, bool after_comma) {
  const char first = line.text[0];
  if (first == '+' || first == '*' || first == ',') return true;
  if (after_comma && is_figure(first)) return true;
  return is_gap(first) && split_nastran_line(line).head.empty();
}

std::string_view bare_mark(std::string_view mark) {
  if (!mark.empty() && (mark[0] == '+' || mark[0] == '*')) mark.remove_prefix(1);
  return trimmed(mark);
}

bool is_same_mark(std::string_view announced, std::string_view found) {
  const std::string wanted = upper_case(bare_mark(found)), own = upper_case(announced);
  return bare_mark(own) == wanted ||
         (!own.empty() && trimmed(std::string_view(own).substr(1)) == wanted);
}

}  // namespace buckens::mesh_io
