// SPDX-License-Identifier: Apache-2.0
#include "buckens/sweep/table.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "buckens/base/errors.h"
#include "buckens/files/csv_row.h"
#include "buckens/files/text_file.h"
#include "buckens/sweep/summary.h"

namespace buckens::sweep {

namespace {

constexpr char kNameColumn[] = "name";
constexpr std::size_t kMostVariants = 100000;

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") + 1 - begin);
}

std::string numbered(std::size_t index, std::size_t count) {
  const auto width = std::max<std::size_t>(3, fmt::formatted_size("{}", count));
  return fmt::format("{:0{}}", index + 1, width);
}

/// Names become directories: nothing that could lead out of the one of the sweep.
void check_name(const std::string& name, const SourceLocation& where) {
  const bool is_plain =
      !name.empty() && name.front() != '.' && name.size() <= 100 &&
      std::all_of(name.begin(), name.end(), [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.' || c == '+' || c == '=';
      });
  if (name == kSweepName || name == kSweepHdf5Name) {
    throw InputError(where, fmt::format("\"{}\" is the name of the table that the sweep writes; "
                                        "choose another for the run directory",
                                        name));
  }
  if (is_plain) return;
  throw InputError(where, fmt::format("\"{}\" cannot name a run directory; use letters, digits and "
                                      "- _ + = . (not as the first character)",
                                      name.substr(0, 60)));
}

void check_paths(const std::vector<std::string>& paths, const SourceLocation& where) {
  std::set<std::string> seen;
  for (const std::string& path : paths) {
    if (path.empty() || path.find('=') != std::string::npos) {
      throw InputError(
          where,
          fmt::format(
              "\"{}\" is not a path of the model file; write for instance bodies.rod.beam.elements",
              path));
    }
    if (!seen.insert(path).second) {
      throw InputError(where, fmt::format("the path \"{}\" appears twice; remove one", path));
    }
  }
}

/// The lines of a table that are neither blank nor comments, with their numbers.
struct TableLine {
  SourceLocation where;
  std::vector<std::string> cells;
};

std::vector<TableLine> table_lines(const std::filesystem::path& file) {
  std::vector<TableLine> out;
  const std::string text = files::read_text_file(file, "table of variants");
  std::size_t begin = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  for (int number = 1; begin < text.size(); ++number) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string line = text.substr(begin, end - begin);
    begin = end + 1;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    const std::string bare = trimmed(line);
    if (bare.empty() || bare.front() == '#') continue;
    const SourceLocation where{file.string(), number, 1};
    const auto cells = files::split_csv_row(line);
    if (!cells) {
      throw InputError(
          where, "a double quote is not closed on this line; write a quote within quotes twice");
    }
    out.push_back({where, *cells});
    for (std::string& cell : out.back().cells) cell = trimmed(cell);
  }
  return out;
}

}  // namespace

std::vector<std::string> SweepTable::overrides(const Variant& variant) const {
  std::vector<std::string> out;
  for (std::size_t k = 0; k < paths.size(); ++k) out.push_back(paths[k] + "=" + variant.values[k]);
  return out;
}

SweepTable read_sweep_table(const std::filesystem::path& file) {
  const std::vector<TableLine> lines = table_lines(file);
  if (lines.size() < 2) {
    throw InputError({file.string(), 0, 0},
                     "the table has no variants; it needs a line of paths (for instance "
                     "parameters.speed) and a line of values per variant");
  }
  SweepTable out;
  out.paths = lines.front().cells;
  const auto found = std::find(out.paths.begin(), out.paths.end(), kNameColumn);
  const bool has_names = found != out.paths.end();
  const auto name_column = found - out.paths.begin();
  if (has_names) out.paths.erase(found);
  check_paths(out.paths, lines.front().where);
  std::set<std::string> names;
  for (std::size_t k = 1; k < lines.size(); ++k) {
    const TableLine& line = lines[k];
    if (line.cells.size() != lines.front().cells.size()) {
      throw InputError(line.where, fmt::format("the row has {} cells, the first line has {}; put "
                                               "values with commas in double quotes",
                                               line.cells.size(), lines.front().cells.size()));
    }
    Variant variant{numbered(k - 1, lines.size() - 1), line.cells};
    if (has_names) {
      variant.name = line.cells[static_cast<std::size_t>(name_column)];
      variant.values.erase(variant.values.begin() + name_column);
    }
    check_name(variant.name, line.where);
    if (!names.insert(variant.name).second) {
      throw InputError(
          line.where,
          fmt::format("the name \"{}\" appears twice; every variant needs its own directory",
                      variant.name));
    }
    out.variants.push_back(std::move(variant));
  }
  return out;
}

namespace {

/// "PATH=[VALUE, ...]" taken apart.
std::pair<std::string, std::vector<std::string>> parse_range(const std::string& text) {
  const SourceLocation where{"--vary " + text, 0, 0};
  const std::size_t equals = text.find('=');
  const char* remedy = "write PATH=[VALUE, VALUE, ...], for instance parameters.speed=[100, 150]";
  if (equals == std::string::npos || equals == 0) throw InputError(where, remedy);
  std::vector<std::string> values;
  try {
    const YAML::Node list = YAML::Load(text.substr(equals + 1));
    if (!list.IsSequence() || list.size() == 0) throw InputError(where, remedy);
    for (const YAML::Node& item : list) {
      YAML::Emitter out;
      out.SetSeqFormat(YAML::Flow);
      out.SetMapFormat(YAML::Flow);
      out << item;
      values.emplace_back(out.c_str());
    }
  } catch (const YAML::Exception&) {
    throw InputError(where, remedy);
  }
  return {text.substr(0, equals), values};
}

}  // namespace

SweepTable combinations(const std::vector<std::string>& ranges) {
  SweepTable out;
  std::vector<std::vector<std::string>> rows = {{}};
  for (const std::string& range : ranges) {
    const auto [path, values] = parse_range(range);
    out.paths.push_back(path);
    if (rows.size() * values.size() > kMostVariants) {
      throw InputError({"--vary " + range, 0, 0},
                       fmt::format("more than {} variants; vary less at once", kMostVariants));
    }
    std::vector<std::vector<std::string>> longer;
    for (const auto& row : rows) {
      for (const std::string& value : values) {
        longer.push_back(row);
        longer.back().push_back(value);
      }
    }
    rows = std::move(longer);
  }
  check_paths(out.paths, {"--vary", 0, 0});
  for (std::size_t k = 0; k < rows.size(); ++k) {
    out.variants.push_back({numbered(k, rows.size()), std::move(rows[k])});
  }
  return out;
}

}  // namespace buckens::sweep
