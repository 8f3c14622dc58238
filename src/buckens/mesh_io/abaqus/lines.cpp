// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/abaqus/lines.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/files/deck_number.h"
#include "buckens/files/text_file.h"

namespace buckens::mesh_io {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kDeepest = 32;             // files open at a time
constexpr std::size_t kMostFiles = 10000;        // a file that is included again counts again
constexpr std::size_t kMostBytes = 2ull << 30;   // of all files together
constexpr std::size_t kLongestKeyword = 100000;  // with its continuation lines
constexpr std::int64_t kLargestLabel = 999'999'999;

char upper_letter(char c) { return static_cast<char>(std::toupper(static_cast<unsigned char>(c))); }

/// Capitals without blanks.
std::string squeezed(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c != ' ' && c != '\t') out.push_back(upper_letter(c));
  }
  return out;
}

/// Cuts at commas outside quotes.
std::vector<std::string_view> split_keyword(std::string_view line) {
  std::vector<std::string_view> out;
  std::size_t begin = 0;
  bool is_quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') is_quoted = !is_quoted;
    if (line[i] != ',' || is_quoted) continue;
    out.push_back(files::stripped(line.substr(begin, i - begin)));
    begin = i + 1;
  }
  out.push_back(files::stripped(line.substr(begin)));
  return out;
}

/// Many decks have a comma at the end of a keyword line and go on with numbers.
bool begins_as_data(std::string_view line) {
  if (line.empty()) return true;
  const char c = line.front();
  return std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '+' || c == '.';
}

std::string unquoted(std::string_view text) {
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') {
    text = text.substr(1, text.size() - 2);
  }
  return std::string(text);
}

/// A file name as Windows users write it.
fs::path as_path(const std::string& name) {
  std::string out = name;
  std::replace(out.begin(), out.end(), '\\', '/');
  return out;
}

}  // namespace

struct AbaqusLines::Source {
  fs::path path;
  fs::path identity;  ///< the same for all names of the file
  std::string text;
  std::size_t position = 0;
  int line = 0;
};

const std::string* DeckKeyword::find(std::string_view key) const {
  for (const Parameter& parameter : parameters) {
    if (parameter.key == key) return &parameter.value;
  }
  return nullptr;
}

AbaqusLines::AbaqusLines(const fs::path& path) { open(path, nullptr); }
AbaqusLines::~AbaqusLines() = default;

SourceLocation AbaqusLines::where(DeckPlace place) const {
  return {sources_.at(static_cast<std::size_t>(place.file))->path.string(), place.line, 1};
}

void AbaqusLines::fail(DeckPlace place, const std::string& what) const {
  throw InputError(where(place), what);
}

void AbaqusLines::open(const fs::path& path, const DeckPlace* from) {
  auto source = std::make_unique<Source>();
  source->path = path;
  std::error_code error;
  source->identity = fs::weakly_canonical(path, error);
  if (error) source->identity = path;
  if (from != nullptr) {
    for (const int open_file : stack_) {
      if (sources_[static_cast<std::size_t>(open_file)]->identity != source->identity) continue;
      fail(*from, fmt::format("\"{}\" includes itself, directly or by way of other files; remove "
                              "this *INCLUDE",
                              path.string()));
    }
    if (stack_.size() >= kDeepest || sources_.size() >= kMostFiles) {
      fail(*from, fmt::format("files are included {} deep and {} times in all; at most {} and {} "
                              "are read",
                              stack_.size(), sources_.size(), kDeepest, kMostFiles));
    }
    // Reading a pipe or a terminal could wait forever.
    if (fs::exists(path, error) && !fs::is_regular_file(path, error)) {
      fail(*from, fmt::format("\"{}\" is not a file that can be included", path.string()));
    }
    try {
      source->text = files::read_text_file(path, "included file", kMostBytes);
    } catch (const IoError& failure) {
      fail(*from, failure.what());
    }
  } else {
    source->text = files::read_text_file(path, "Abaqus deck", kMostBytes);
  }
  bytes_ += source->text.size();
  if (source->text.starts_with("\xEF\xBB\xBF")) source->position = 3;
  const std::size_t binary = source->text.find('\0');
  const std::size_t newlines =
      binary == std::string::npos
          ? 0
          : static_cast<std::size_t>(
                std::count(source->text.begin(),
                           source->text.begin() + static_cast<std::ptrdiff_t>(binary), '\n'));
  stack_.push_back(static_cast<int>(sources_.size()));
  sources_.push_back(std::move(source));
  if (binary != std::string::npos) {
    fail({stack_.back(), static_cast<int>(newlines) + 1},
         "found a zero byte: this is not text, so not a deck of Abaqus or CalculiX");
  }
  if (from != nullptr && bytes_ > kMostBytes) {
    fail(*from, fmt::format("the included files are larger than {} GB together", kMostBytes >> 30));
  }
}

void AbaqusLines::include(const std::string& name, DeckPlace place) {
  const fs::path given = as_path(name);
  const fs::path beside = sources_[static_cast<std::size_t>(place.file)]->path.parent_path();
  std::error_code error;
  fs::path path = beside / given;
  if (!fs::exists(path, error)) {
    const fs::path at_top = sources_.front()->path.parent_path() / given;
    if (fs::exists(at_top, error)) path = at_top;
  }
  open(path, &place);
}

bool AbaqusLines::physical_line(std::string_view& line, DeckPlace& place) {
  while (!stack_.empty()) {
    Source& source = *sources_[static_cast<std::size_t>(stack_.back())];
    if (source.position >= source.text.size()) {
      // The text of a file that was read is still referred to by rows, so it stays.
      stack_.pop_back();
      continue;
    }
    const std::string_view text = source.text;
    const std::size_t end = std::min(text.find('\n', source.position), text.size());
    line = files::stripped(text.substr(source.position, end - source.position));
    source.position = end + 1;
    place = {stack_.back(), ++source.line};
    return true;
  }
  return false;
}

/// Looks at the next line that is no comment, following *INCLUDE.
bool AbaqusLines::peek() {
  while (!has_line_) {
    if (!physical_line(line_, place_)) return false;
    if (line_.starts_with("**")) continue;
    if (line_.starts_with('*') && squeezed(line_.substr(0, 12)).starts_with("*INCLUDE")) {
      const DeckKeyword keyword = parse_keyword(std::string(line_), place_);
      const std::string* name = keyword.find("INPUT");
      if (keyword.name == "INCLUDE") {
        if (name == nullptr || name->empty()) {
          fail(place_, "*INCLUDE needs the name of a file: *INCLUDE, INPUT=nodes.inp");
        }
        include(*name, place_);
        continue;
      }
    }
    has_line_ = true;
  }
  return true;
}

bool AbaqusLines::next_keyword(DeckKeyword& out) {
  while (peek()) {
    has_line_ = false;
    if (!line_.starts_with('*')) continue;
    const DeckPlace place = place_;
    std::string line(line_);
    while (line.ends_with(',') && peek() && !line_.starts_with('*') && !begins_as_data(line_)) {
      line += line_;
      has_line_ = false;
      if (line.size() > kLongestKeyword) fail(place, "the keyword line is too long");
    }
    out = parse_keyword(line, place);
    return true;
  }
  return false;
}

DeckKeyword AbaqusLines::parse_keyword(const std::string& line, DeckPlace place) const {
  DeckKeyword out;
  out.place = place;
  const auto parts = split_keyword(line);
  out.name = squeezed(parts[0].substr(1));
  out.written = upper(parts[0].substr(0, 40));
  if (out.name.empty()) return out;
  for (std::size_t i = 1; i < parts.size(); ++i) {
    if (parts[i].empty()) continue;
    const std::size_t equals = parts[i].find('=');
    DeckKeyword::Parameter& parameter = out.parameters.emplace_back();
    parameter.key = squeezed(parts[i].substr(0, equals));
    if (std::isdigit(static_cast<unsigned char>(parameter.key[0])) != 0) {
      fail(place, fmt::format("\"{}\" is not a parameter of {}; a comma at the end of a keyword "
                              "line makes the next line part of it, so remove it before data",
                              parameter.key.substr(0, 40), out.written));
    }
    if (equals == std::string_view::npos) continue;
    parameter.value = unquoted(files::stripped(parts[i].substr(equals + 1)));
  }
  return out;
}

bool AbaqusLines::next_row(DeckRow& out, bool with_blank) {
  out.cells.clear();
  out.continues = false;
  do {
    if (!peek() || line_.starts_with('*')) return false;
    has_line_ = false;
  } while (line_.empty() && !with_blank);
  out.place = place_;
  if (line_.empty()) return true;
  std::size_t begin = 0;
  while (begin <= line_.size()) {
    const std::size_t end = std::min(line_.find(',', begin), line_.size());
    std::string_view cell = files::stripped(line_.substr(begin, end - begin));
    if (cell.size() > 2 && cell.front() == '"' && cell.back() == '"') {
      cell = cell.substr(1, cell.size() - 2);
    }
    out.cells.push_back(cell);
    begin = end + 1;
  }
  if (line_.back() == ',') {
    out.continues = true;
    out.cells.pop_back();
  }
  return true;
}

std::string AbaqusLines::first_cell_ahead() {
  if (!peek() || line_.starts_with('*')) return "";
  return std::string(files::stripped(line_.substr(0, line_.find(','))));
}

double AbaqusLines::number(const DeckRow& row, std::size_t i, const char* what) const {
  const std::string_view text = row.cell(i);
  if (text.empty()) {
    fail(row.place, fmt::format("{} is missing: value {} of this line", what, i + 1));
  }
  if (const auto value = files::deck_number(text)) return *value;
  fail(row.place,
       fmt::format("{}: \"{}\" is not a finite number", what, std::string(text.substr(0, 40))));
}

double AbaqusLines::number_or(const DeckRow& row, std::size_t i, double otherwise,
                              const char* what) const {
  return row.cell(i).empty() ? otherwise : number(row, i, what);
}

std::int64_t AbaqusLines::label(std::string_view text, DeckPlace place, const char* what) const {
  const auto value = files::deck_integer(text);
  if (value && *value >= 1 && *value <= kLargestLabel) return *value;
  fail(place, fmt::format("{}: \"{}\" is not a number from 1 to {}", what,
                          std::string(text.substr(0, 40)), kLargestLabel));
}

std::string upper(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(), upper_letter);
  return out;
}

}  // namespace buckens::mesh_io
