// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/nastran/card_reader.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/mesh_io/nastran/number.h"

namespace buckens::mesh_io {

namespace {

constexpr std::size_t kRow = 8;
/// 64 MB of fields: an RBE2 with four million nodes.
constexpr std::size_t kMostFields = std::size_t{1} << 22;

/// One line cut into its fields.
struct Row {
  std::string_view head;  ///< name, or mark of a continuation
  std::array<std::string_view, kRow> data;
  std::size_t num_data = kRow;  ///< 4 in large field
  std::string_view mark;        ///< that the next line repeats
};

[[noreturn]] void fail(const NastranLine& line, const std::string& text) {
  throw InputError({line.file->name, line.number, 1}, text);
}

/// A tab ends a field of eight columns, so that the text of a field is in one piece all the same.
Row split_columns(const NastranLine& line) {
  Row row;
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
    if (column >= 8 && width == 8) {
      const std::string_view head = fields[0];
      if (head.starts_with('*') || head.ends_with('*')) width = 16;
    }
    const std::size_t at = column < 8 ? 0 : column >= 72 ? 9 : 1 + (column - 8) / width;
    ++column;
    if (c == ' ') continue;
    std::string_view& field = fields[at];
    const std::size_t begin =
        field.empty() ? i : static_cast<std::size_t>(field.data() - text.data());
    field = text.substr(begin, i + 1 - begin);
  }
  row.head = fields[0];
  row.num_data = row.head.starts_with('*') || row.head.ends_with('*') ? 4 : kRow;
  std::copy_n(fields.begin() + 1, kRow, row.data.begin());
  row.mark = fields[9];
  return row;
}

bool is_mark(std::string_view field) {
  if (field.empty() || (field[0] != '+' && field[0] != '*')) return false;
  return !nastran_real(field);
}

Row split_commas(const NastranLine& line) {
  Row row;
  std::array<std::string_view, 10> fields;
  std::size_t count = 0, begin = 0;
  const std::string_view text = line.text;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string_view field = trimmed(text.substr(begin, end - begin));
    if (count < fields.size()) fields[count] = field;
    if (count >= fields.size() && !field.empty()) {
      fail(line, fmt::format("more than ten fields in one line; {} is too much. Break the card "
                             "into continuation lines",
                             quoted_excerpt(field)));
    }
    ++count;
    begin = end + 1;
  }
  row.head = fields[0];
  row.num_data = row.head.starts_with('*') || row.head.ends_with('*') ? 4 : kRow;
  std::size_t last = std::min(count, fields.size()) - 1;
  if (last > row.num_data || (last > 0 && is_mark(fields[last]))) {
    row.mark = fields[last];
    fields[last] = {};
  }
  for (std::size_t i = row.num_data + 1; i < fields.size(); ++i) {
    if (fields[i].empty()) continue;
    fail(line, fmt::format("more than {} data fields in one line; {} is too much. Break the card "
                           "into continuation lines",
                           row.num_data, quoted_excerpt(fields[i])));
  }
  std::copy_n(fields.begin() + 1, kRow, row.data.begin());
  return row;
}

Row split(const NastranLine& line) {
  return line.text.find(',') == std::string_view::npos ? split_columns(line) : split_commas(line);
}

bool is_continuation(const NastranLine& line) {
  const char first = line.text[0];
  if (first == '+' || first == '*' || first == ',') return true;
  if (first != ' ' && first != '\t') return false;
  return split(line).head.empty();
}

/// Cards may not be torn apart: what follows must be what the card before announced.
void check_mark(std::string_view announced, std::string_view found, const NastranLine& line) {
  const auto core = [](std::string_view mark) {
    if (!mark.empty() && (mark[0] == '+' || mark[0] == '*')) mark.remove_prefix(1);
    return trimmed(mark);
  };
  if (core(announced).empty() || core(found).empty() || core(announced) == core(found)) return;
  fail(line, fmt::format("found continuation {} where {} should follow; put the lines of a card "
                         "one after the other",
                         quoted_excerpt(found), quoted_excerpt(announced)));
}

void append(NastranCard& card, const Row& row, const NastranLine& line) {
  if (row.num_data == kRow && card.fields.size() % kRow != 0) {
    card.fields.resize((card.fields.size() / kRow + 1) * kRow);
  }
  if (card.fields.size() + kRow > kMostFields) {
    fail(line, fmt::format("the card {} has more than {} fields", card.name, kMostFields));
  }
  for (std::size_t i = 0; i < row.num_data; ++i) {
    const std::string_view field = row.data[i];
    card.fields.push_back({field.data(), static_cast<std::uint32_t>(field.size()),
                           static_cast<std::uint32_t>(line.number)});
  }
}

std::string card_name(const Row& row, const NastranLine& line) {
  std::string_view text = row.head;
  if (text.ends_with('*')) text.remove_suffix(1);
  std::string name = upper_case(trimmed(text));
  bool is_name = !name.empty() && name.size() <= 8 && name[0] >= 'A' && name[0] <= 'Z';
  for (const char c : name) {
    is_name = is_name && ((c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_');
  }
  if (!is_name) {
    fail(line, fmt::format("{} is not the name of a bulk data card", quoted_excerpt(row.head)));
  }
  return name;
}

bool is_end(std::string_view text) {
  text = trimmed(text);
  return text.size() >= 7 && upper_case(text.substr(0, 7)) == "ENDDATA";
}

}  // namespace

std::optional<NastranLine> NastranCardReader::take() {
  if (found_end_) return std::nullopt;
  std::optional<NastranLine> line =
      pending_ ? std::exchange(pending_, std::nullopt) : source_.next();
  if (line && is_end(line->text)) {
    found_end_ = true;
    return std::nullopt;
  }
  return line;
}

bool NastranCardReader::next(NastranCard& card) {
  const std::optional<NastranLine> first = take();
  if (!first) return false;
  if (is_continuation(*first)) {
    fail(*first, "this continues a card, but there is none before it");
  }
  Row row = split(*first);
  card.name = card_name(row, *first);
  card.file = first->file;
  card.line = first->number;
  card.fields.clear();
  append(card, row, *first);
  std::string_view announced = row.mark;
  while (const std::optional<NastranLine> line = take()) {
    if (!is_continuation(*line)) {
      pending_ = line;
      break;
    }
    if (line->file != card.file) fail(*line, "this continues a card of another file");
    row = split(*line);
    check_mark(announced, row.head, *line);
    append(card, row, *line);
    announced = row.mark;
  }
  while (!card.fields.empty() && card.fields.back().size == 0) card.fields.pop_back();
  return true;
}

}  // namespace buckens::mesh_io
