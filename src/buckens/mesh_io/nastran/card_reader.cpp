// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/nastran/card_reader.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/mesh_io/nastran/number.h"

namespace buckens::mesh_io {

namespace {

/// 64 MB of fields: an RBE2 with four million nodes.
constexpr std::size_t kMostFields = std::size_t{1} << 22;

[[noreturn]] void fail(const NastranLine& line, const std::string& text) {
  throw InputError({line.file->name, line.number, 1}, text);
}

bool has_sign(const NastranLine& line) { return line.text[0] == '+' || line.text[0] == '*'; }

bool ends_with_comma(const NastranLine& line) { return trimmed(line.text).ends_with(','); }

void append(NastranCard& card, const NastranRow& row, const NastranLine& line) {
  constexpr std::size_t kRow = NastranRow::kSize;
  if (row.num_data == kRow && card.fields.size() % kRow != 0) {
    card.fields.resize((card.fields.size() / kRow + 1) * kRow);
  }
  if (card.fields.size() + row.num_data + row.more.size() > kMostFields) {
    fail(line, fmt::format("the card {} has more than {} fields", card.name, kMostFields));
  }
  const auto add = [&](std::string_view field) {
    card.fields.push_back({field.data(), static_cast<std::uint32_t>(field.size()),
                           static_cast<std::uint32_t>(line.number)});
  };
  for (std::size_t i = 0; i < row.num_data; ++i) add(row.data[i]);
  for (const std::string_view field : row.more) add(field);
}

/// @param is_first whether no card came before, so that the file may be none of Nastran at all
std::string card_name(const NastranRow& row, const NastranLine& line, bool is_first) {
  std::string_view text = row.head;
  if (text.ends_with('*')) text.remove_suffix(1);
  std::string name = upper_case(trimmed(text));
  // NASTRAN-95 takes lines of an earlier run away.
  if (name == "/") return name;
  if (name.starts_with("BEGIN")) return "BEGIN";
  bool is_name = !name.empty() && name.size() <= 8 && name[0] >= 'A' && name[0] <= 'Z';
  for (const char c : name) {
    is_name = is_name && ((c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_');
  }
  if (!is_name) {
    fail(line, fmt::format("{} is not the name of a bulk data card{}", quoted_excerpt(row.head),
                           is_first ? "; is this a deck of Nastran?" : ""));
  }
  return name;
}

bool is_end(std::string_view text) {
  text = trimmed(text);
  return text.size() >= 7 && upper_case(text.substr(0, 7)) == "ENDDATA";
}

}  // namespace

std::optional<NastranLine> NastranCardReader::from_source() {
  if (found_end_) return std::nullopt;
  std::optional<NastranLine> line =
      pending_ ? std::exchange(pending_, std::nullopt) : source_.next();
  if (line && is_end(line->text)) {
    found_end_ = true;
    return std::nullopt;
  }
  if (line) {
    complete(*line);
    before_ = *line;
  }
  return line;
}

/// In NASTRAN-95 `==` in a continuation stands for the rest of the line before.
void NastranCardReader::complete(NastranLine& line) {
  const bool may_repeat = has_sign(line) && line.text.find("==") != std::string_view::npos;
  if (!may_repeat || before_.text.empty()) return;
  const NastranRow row = split_nastran_line(line), before = split_nastran_line(before_);
  const auto rest = std::find(row.data.begin(), row.data.end(), "==");
  if (rest == row.data.end() || row.num_data != before.num_data) return;
  std::string text(row.head);
  for (std::size_t i = 0; i < row.data.size(); ++i) {
    const bool is_own = i < static_cast<std::size_t>(rest - row.data.begin());
    text += fmt::format(",{}", is_own ? row.data[i] : before.data[i]);
  }
  if (!row.mark.empty()) text += fmt::format(",{}", row.mark);
  line.text = completed_.emplace_back(std::move(text));
}

std::optional<NastranLine> NastranCardReader::take() {
  if (!has_gathered_) return from_source();
  while (place_ < ahead_.size() && ahead_[place_].used) ++place_;
  if (place_ == ahead_.size()) return std::nullopt;
  return ahead_[place_++].line;
}

void NastranCardReader::put_back(const NastranLine& line) {
  if (has_gathered_) {
    --place_;
  } else {
    pending_ = line;
  }
}

void NastranCardReader::gather() {
  while (const auto line = from_source()) {
    if (has_sign(*line)) {
      const std::string_view mark = bare_mark(split_nastran_line(*line).head);
      if (!mark.empty()) marks_[upper_case(mark)].push_back(ahead_.size());
    }
    ahead_.push_back({*line});
  }
  has_gathered_ = true;
}

std::optional<NastranLine> NastranCardReader::find_continuation(std::string_view announced) {
  if (bare_mark(announced).empty()) return std::nullopt;
  if (!has_gathered_) gather();
  for (const std::string_view mark : {bare_mark(announced), trimmed(announced.substr(1))}) {
    const auto places = marks_.find(upper_case(mark));
    if (places == marks_.end()) continue;
    for (const std::size_t place : places->second) {
      if (place < place_ || ahead_[place].used) continue;
      ahead_[place].used = true;
      return ahead_[place].line;
    }
  }
  return std::nullopt;
}

/// The line that goes on with a card: the next one, or that with the announced mark.
std::optional<NastranLine> NastranCardReader::continuation_of(const NastranCard& card,
                                                              std::string_view announced,
                                                              bool after_comma) {
  const std::optional<NastranLine> line = take();
  const bool continues = line && (continues_nastran_card(*line, after_comma) ||
                                  (card.name == "DEQATN" && line->text[0] == ' '));
  if (continues) {
    const NastranRow row = split_nastran_line(*line);
    const bool fits = bare_mark(announced).empty() || bare_mark(row.head).empty() ||
                      is_same_mark(announced, row.head);
    if (fits || card.name == "DEQATN") {
      if (line->file != card.file) fail(*line, "this continues a card of another file");
      return line;
    }
  }
  if (line) put_back(*line);
  if (auto found = find_continuation(announced)) return found;
  if (!continues) return std::nullopt;
  fail(*line,
       fmt::format("found continuation {} where {} should follow, which the deck does not "
                   "have",
                   quoted_excerpt(split_nastran_line(*line).head), quoted_excerpt(announced)));
}

/// Cards are repeated without their continuations.
NastranRow NastranCardReader::first_row(const NastranLine& line) {
  NastranRow row = split_nastran_line(line);
  if (!row.repeats()) {
    replication_.take(row);
    return row;
  }
  replication_.begin(row, line);
  repeating_ = line;
  return replication_.next(line);
}

bool NastranCardReader::next(NastranCard& card) {
  NastranLine first;
  NastranRow row;
  if (replication_.is_going_on()) {
    first = repeating_;
    row = replication_.next(first);
  } else {
    const std::optional<NastranLine> line = take();
    if (!line) return false;
    if (continues_nastran_card(*line, false)) {
      fail(*line, "this continues a card, but there is none before it");
    }
    first = *line;
    row = first_row(first);
  }
  card.name = card_name(row, first, !has_card_);
  has_card_ = true;
  card.file = first.file;
  card.line = first.number;
  card.fields.clear();
  append(card, row, first);
  std::string mark(row.mark);
  bool after_comma = ends_with_comma(first);
  while (!replication_.is_going_on()) {
    const std::optional<NastranLine> line = continuation_of(card, mark, after_comma);
    if (!line) break;
    row = split_nastran_line(*line);
    if (card.name != "DEQATN") append(card, row, *line);
    mark = row.mark;
    after_comma = ends_with_comma(*line);
  }
  while (!card.fields.empty() && card.fields.back().size == 0) card.fields.pop_back();
  return true;
}

}  // namespace buckens::mesh_io
