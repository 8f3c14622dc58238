// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/matrix/node_table.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "buckens/base/errors.h"
#include "buckens/base/nearest.h"
#include "buckens/files/text_file.h"
#include "buckens/files/text_lines.h"
#include "buckens/mesh_io/label_index.h"

namespace buckens::mesh_io {

namespace {

const std::vector<std::string> kColumns = {"node", "x",  "y",  "z",  "ux",
                                           "uy",   "uz", "rx", "ry", "rz"};
constexpr std::int64_t kMostNodeRows = 100'000'000;
constexpr std::int64_t kLargestNode = 999'999'999;

std::vector<std::string_view> cells_of(std::string_view line) {
  const char separator = line.find(';') != std::string_view::npos ? ';' : ',';
  std::vector<std::string_view> out;
  std::size_t begin = 0;
  while (begin <= line.size()) {
    const std::size_t end = std::min(line.find(separator, begin), line.size());
    out.push_back(files::stripped(line.substr(begin, end - begin)));
    begin = end + 1;
  }
  return out;
}

class TableReader {
 public:
  explicit TableReader(const std::filesystem::path& path)
      : text_(files::without_byte_order_mark(files::read_text_file(path, "table of nodes"))),
        lines_(text_) {
    out_.file = path.string();
  }

  MatrixNodeTable run() {
    std::string_view line;
    if (!next(line)) fail("the table is empty; it begins with the heading node,x,y,z");
    read_heading(line);
    while (next(line)) read_row(line);
    if (out_.nodes.empty()) fail("the table has no nodes");
    return std::move(out_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError({out_.file, lines_.number(), 1}, what);
  }

  bool next(std::string_view& line) {
    while (lines_.next(line)) {
      if (!line.empty() && line[0] != '#') return true;
    }
    return false;
  }

  void read_heading(std::string_view line) {
    for (const auto cell : cells_of(line)) {
      const std::string name(cell);
      const auto at = std::find(kColumns.begin(), kColumns.end(), name);
      if (at == kColumns.end()) {
        fail(
            fmt::format("\"{}\" is not a column of a table of nodes.{} The heading is node,x,y,z, "
                        "perhaps followed by ux,uy,uz,rx,ry,rz",
                        name.substr(0, 40), base::suggestion(name.substr(0, 40), kColumns)));
      }
      columns_.push_back(static_cast<int>(at - kColumns.begin()));
    }
    for (int needed = 0; needed < 4; ++needed) {
      if (std::count(columns_.begin(), columns_.end(), needed) == 1) continue;
      fail(fmt::format("the column \"{}\" must appear exactly once",
                       kColumns[static_cast<std::size_t>(needed)]));
    }
    out_.has_rows = columns_.size() > 4;
  }

  void read_row(std::string_view line) {
    const auto cells = cells_of(line);
    if (cells.size() != columns_.size()) {
      fail(fmt::format("the row has {} cells, the heading {}", cells.size(), columns_.size()));
    }
    TableNode node;
    node.line = lines_.number();
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const int column = columns_[i];
      if (column == 0) {
        node.number = whole(cells[i], kLargestNode);
      } else if (column < 4) {
        const auto value = files::deck_number(cells[i]);
        if (!value) fail(fmt::format("\"{}\" is not a finite number", short_text(cells[i])));
        node.position[column - 1] = *value;
      } else if (!cells[i].empty() && cells[i] != "0") {
        node.rows[static_cast<std::size_t>(column - 4)] = whole(cells[i], kMostNodeRows);
      }
    }
    if (seen_.add(node.number, 1) >= 0) {
      fail(fmt::format("node {} appears in the table twice", node.number));
    }
    out_.nodes.push_back(node);
  }

  static std::string short_text(std::string_view cell) { return std::string(cell.substr(0, 40)); }

  std::int64_t whole(std::string_view cell, std::int64_t largest) const {
    const auto value = files::deck_integer(cell);
    if (value && *value >= 1 && *value <= largest) return *value;
    fail(fmt::format("\"{}\" is not a whole number from 1 to {}", short_text(cell), largest));
  }

  std::string text_;
  files::TextLines lines_;
  MatrixNodeTable out_;
  std::vector<int> columns_;
  LabelIndex seen_;
};

}  // namespace

MatrixNodeTable read_matrix_node_table(const std::filesystem::path& path) {
  return TableReader(path).run();
}

}  // namespace buckens::mesh_io
