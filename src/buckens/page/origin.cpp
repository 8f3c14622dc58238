// SPDX-License-Identifier: Apache-2.0
#include "buckens/page/origin.h"

#include <algorithm>
#include <fstream>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "buckens/run_store/run_files.h"

namespace buckens::page {

namespace {

namespace fs = std::filesystem;

/// The last `count` parts of a path.
std::string last_parts(const fs::path& path, std::ptrdiff_t count) {
  const std::vector<fs::path> parts(path.begin(), path.end());
  fs::path out;
  const auto size = static_cast<std::ptrdiff_t>(parts.size());
  for (auto at = parts.end() - std::min(count, size); at != parts.end(); ++at) out /= *at;
  return out.generic_string();
}

}  // namespace

std::vector<std::string> directory_names(const std::vector<fs::path>& directories) {
  std::vector<fs::path> whole;
  std::ptrdiff_t longest = 1;
  for (const fs::path& directory : directories) {
    std::error_code ignored;
    fs::path path = fs::absolute(directory, ignored).lexically_normal();
    // A slash at the end is an empty part.
    if (!path.has_filename()) path = path.parent_path();
    longest = std::max(longest, std::distance(path.begin(), path.end()));
    whole.push_back(std::move(path));
  }
  std::vector<std::string> names;
  for (std::ptrdiff_t count = 1; count <= longest; ++count) {
    names.clear();
    for (const fs::path& path : whole) names.push_back(last_parts(path, count));
    if (std::set<std::string>(names.begin(), names.end()).size() == names.size()) break;
  }
  return names;
}

std::vector<std::string> run_changes(const fs::path& directory) {
  constexpr std::string_view kMark = "--set ";
  std::vector<std::string> changes;
  std::ifstream file(directory / run_store::kModelName);
  // They stand in the comment at the beginning.
  for (std::string line; std::getline(file, line) && line.starts_with('#');) {
    const std::size_t at = line.find_first_not_of("# ");
    if (at == line.npos || line.compare(at, kMark.size(), kMark) != 0) continue;
    changes.push_back(line.substr(at + kMark.size()));
  }
  return changes;
}

}  // namespace buckens::page
