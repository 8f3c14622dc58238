// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/matrix/file.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/files/text_file.h"
#include "buckens/files/text_lines.h"

namespace buckens::mesh_io {

namespace {

constexpr std::size_t kLargestFile = 2ull << 30;
constexpr std::int64_t kMostRows = 100'000'000;

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

class MatrixReader {
 public:
  explicit MatrixReader(const std::filesystem::path& path)
      : text_(files::without_byte_order_mark(files::read_text_file(path, "matrix", kLargestFile))),
        lines_(text_) {
    out_.file = path.string();
  }

  MatrixFile run() {
    std::string_view line;
    if (text_.find('\0') != std::string::npos) {
      fail(1, "this is not text; write the matrix as Matrix Market or by *MATRIX OUTPUT of Abaqus");
    }
    if (!lines_.next(line)) fail(0, "the file is empty");
    if (line.starts_with("%%MatrixMarket")) {
      read_market(line);
    } else {
      read_abaqus(line);
    }
    if (out_.entries.empty()) fail(0, "the matrix has no entries");
    return std::move(out_);
  }

 private:
  [[noreturn]] void fail(int line, const std::string& what) const {
    throw InputError({out_.file, line, 1}, what);
  }

  double number(std::string_view word) const {
    if (const auto value = files::deck_number(word)) return *value;
    fail(lines_.number(),
         fmt::format("\"{}\" is not a finite number", std::string(word.substr(0, 40))));
  }

  std::int64_t count(std::string_view word, std::int64_t largest, const char* what) const {
    const auto value = files::deck_integer(word);
    if (value && *value >= 1 && *value <= largest) return *value;
    fail(lines_.number(), fmt::format("{}: \"{}\" is not a number from 1 to {}", what,
                                      std::string(word.substr(0, 40)), largest));
  }

  /// The next line that is neither empty nor a comment.
  bool next(std::string_view& line, char comment) {
    while (lines_.next(line)) {
      if (!line.empty() && line[0] != comment) return true;
    }
    return false;
  }

  void read_market(std::string_view header) {
    files::split_words(header, words_);
    std::vector<std::string> kind;
    for (const auto word : words_) kind.push_back(lower(word));
    if (kind.size() != 5 || kind[1] != "matrix") {
      fail(1, "expected a line such as %%MatrixMarket matrix coordinate real symmetric");
    }
    if (kind[3] != "real" && kind[3] != "integer" && kind[3] != "double") {
      fail(1, fmt::format("the entries are {}; real numbers are needed", kind[3]));
    }
    if (kind[4] != "general" && kind[4] != "symmetric") {
      fail(1, fmt::format("the matrix is {}; mass and stiffness are symmetric", kind[4]));
    }
    out_.is_triangle = kind[4] == "symmetric";
    std::string_view line;
    if (!next(line, '%')) fail(lines_.number(), "the numbers of rows and columns are missing");
    files::split_words(line, words_);
    const bool is_array = kind[2] == "array";
    if (!is_array && kind[2] != "coordinate") {
      fail(1, fmt::format("must be coordinate or array, not \"{}\"", kind[2]));
    }
    if (words_.size() != (is_array ? 2u : 3u)) {
      fail(lines_.number(), is_array ? "expected the numbers of rows and columns"
                                     : "expected the numbers of rows, columns and entries");
    }
    out_.size = count(words_[0], kMostRows, "number of rows");
    if (count(words_[1], kMostRows, "number of columns") != out_.size) {
      fail(lines_.number(), "the matrix is not square");
    }
    if (is_array) {
      read_array();
    } else {
      read_coordinates(
          count(words_[2], std::numeric_limits<std::int64_t>::max(), "number of entries"));
    }
  }

  void read_coordinates(std::int64_t announced) {
    std::string_view line;
    while (next(line, '%')) {
      files::split_words(line, words_);
      if (words_.size() != 3) {
        fail(lines_.number(), "expected row, column and value");
      }
      add_plain();
    }
    const auto found = static_cast<std::int64_t>(out_.entries.size());
    if (found != announced) {
      fail(lines_.number(),
           fmt::format("{} entries are announced but {} found; the file seems to be truncated",
                       announced, found));
    }
    check_triangle();
  }

  /// A symmetric matrix has one triangle in the file; of two each entry would count twice.
  void check_triangle() const {
    if (!out_.is_triangle) return;
    const MatrixEntry* above = nullptr;
    const MatrixEntry* below = nullptr;
    for (const MatrixEntry& entry : out_.entries) {
      if (entry.row < entry.column && above == nullptr) above = &entry;
      if (entry.row > entry.column && below == nullptr) below = &entry;
    }
    if (above == nullptr || below == nullptr) return;
    fail(std::max(above->line, below->line),
         "the matrix is declared symmetric, so only one triangle may be written, but there are "
         "entries on both sides of the diagonal; write \"general\" in the first line");
  }

  /// Column by column; of symmetric matrices from the diagonal downwards.
  void read_array() {
    std::int64_t row = 1;
    std::int64_t column = 1;
    std::string_view line;
    while (next(line, '%')) {
      files::split_words(line, words_);
      for (const auto word : words_) {
        if (column > out_.size) fail(lines_.number(), "there are more values than entries");
        const double value = number(word);
        if (value != 0.0) out_.entries.push_back({row, column, -1, -1, value, lines_.number()});
        if (++row <= out_.size) continue;
        ++column;
        row = out_.is_triangle ? column : 1;
      }
    }
    if (column <= out_.size) {
      fail(lines_.number(),
           fmt::format("the values end in column {} of {}; the file seems to be truncated", column,
                       out_.size));
    }
  }

  /// Row, column and value in words_.
  void add_plain() {
    MatrixEntry entry;
    const std::int64_t most = out_.size > 0 ? out_.size : kMostRows;
    entry.row = count(words_[0], most, "row");
    entry.column = count(words_[1], most, "column");
    entry.value = number(words_[2]);
    entry.line = lines_.number();
    out_.entries.push_back(entry);
  }

  void read_abaqus(std::string_view first) {
    std::string_view line = first;
    bool has_line = !line.empty() && line[0] != '*';
    if (!has_line) has_line = next(line, '*');
    if (!has_line) return;
    files::split_words(line, words_);
    out_.is_labelled = words_.size() == 5;
    if (!out_.is_labelled && words_.size() != 3) {
      fail(lines_.number(),
           fmt::format(
               "found {} values; expected row, column, value (Matrix Market begins with "
               "%%MatrixMarket; of Abaqus FORMAT=COORDINATE), or row node, row degree of freedom, "
               "column node, column degree of freedom, value (of Abaqus FORMAT=MATRIX INPUT)",
               words_.size()));
    }
    const std::size_t width = words_.size();
    do {
      files::split_words(line, words_);
      if (words_.size() != width) {
        fail(lines_.number(),
             fmt::format("found {} values, but {} in the lines above", words_.size(), width));
      }
      if (out_.is_labelled) {
        add_labelled();
      } else {
        add_plain();
      }
    } while (next(line, '*'));
    finish_abaqus();
  }

  void add_labelled() {
    MatrixEntry entry;
    constexpr std::int64_t kLargestNode = 999'999'999;
    entry.row = count(words_[0], kLargestNode, "row node (internal nodes have no place)");
    entry.row_variable = static_cast<signed char>(count(words_[1], 6, "degree of freedom") - 1);
    entry.column = count(words_[2], kLargestNode, "column node (internal nodes have no place)");
    entry.column_variable = static_cast<signed char>(count(words_[3], 6, "degree of freedom") - 1);
    entry.value = number(words_[4]);
    entry.line = lines_.number();
    out_.entries.push_back(entry);
  }

  /// These files do not say whether they hold a triangle.
  void finish_abaqus() {
    bool has_upper = false;
    bool has_lower = false;
    for (const MatrixEntry& entry : out_.entries) {
      has_upper = has_upper || row_of(entry) < column_of(entry);
      has_lower = has_lower || row_of(entry) > column_of(entry);
      if (!out_.is_labelled) out_.size = std::max({out_.size, entry.row, entry.column});
    }
    out_.is_triangle = !(has_upper && has_lower && has_mirrored());
  }

  using Variable = std::pair<std::int64_t, signed char>;
  static Variable row_of(const MatrixEntry& entry) { return {entry.row, entry.row_variable}; }
  static Variable column_of(const MatrixEntry& entry) {
    return {entry.column, entry.column_variable};
  }

  /// Whether any entry stands on both sides of the diagonal. One triangle in the program's own
  /// order of nodes lies on both sides by their numbers.
  bool has_mirrored() const {
    struct Pair {
      Variable least, most;
      bool is_upper;
    };
    std::vector<Pair> pairs;
    pairs.reserve(out_.entries.size());
    for (const MatrixEntry& entry : out_.entries) {
      const auto [least, most] = std::minmax({row_of(entry), column_of(entry)});
      if (least != most) pairs.push_back({least, most, row_of(entry) == least});
    }
    const auto place = [](const Pair& pair) { return std::tie(pair.least, pair.most); };
    std::sort(pairs.begin(), pairs.end(),
              [&](const Pair& a, const Pair& b) { return place(a) < place(b); });
    return std::adjacent_find(pairs.begin(), pairs.end(), [&](const Pair& a, const Pair& b) {
             return place(a) == place(b) && a.is_upper != b.is_upper;
           }) != pairs.end();
  }

  std::string text_;
  files::TextLines lines_;
  MatrixFile out_;
  std::vector<std::string_view> words_;
};

}  // namespace

MatrixFile read_matrix_file(const std::filesystem::path& path) { return MatrixReader(path).run(); }

}  // namespace buckens::mesh_io
