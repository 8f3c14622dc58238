// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/channel.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::results {

namespace {

/// Paths become places in a hierarchical file, where these parts have no place.
bool is_valid_path(std::string_view path) {
  while (true) {
    const std::size_t slash = path.find('/');
    const std::string_view part = path.substr(0, slash);
    if (part.empty() || part == "." || part == ".." || part.find('\0') != part.npos) return false;
    if (slash == path.npos) return true;
    path.remove_prefix(slash + 1);
  }
}

/// Proper prefixes: "a/b/c" has "a" and "a/b".
std::vector<std::string> parents_of(const std::string& path) {
  std::vector<std::string> parents;
  for (std::size_t at = path.find('/'); at != path.npos; at = path.find('/', at + 1)) {
    parents.push_back(path.substr(0, at));
  }
  return parents;
}

}  // namespace

std::size_t Channel::size() const {
  std::size_t size = 1;
  for (const int extent : shape) size *= static_cast<std::size_t>(std::max(extent, 0));
  return size;
}

std::size_t RecordLayout::add(Channel channel) {
  const std::string& path = channel.path;
  if (!is_valid_path(path)) {
    throw ModelError(
        fmt::format("recorded quantity \"{}\": expected names joined by single '/', none of them "
                    "empty, \".\" or \"..\". Rename the body, joint or sensor.",
                    path));
  }
  const std::vector<std::string> parents = parents_of(path);
  const auto taken = [this](const std::string& name) { return index_.contains(name); };
  if (taken(path) || parents_.contains(path) ||
      std::any_of(parents.begin(), parents.end(), taken)) {
    throw ModelError(fmt::format(
        "recorded quantity \"{}\": the name is taken. Give the body, joint or sensor another one.",
        path));
  }
  if (std::any_of(channel.shape.begin(), channel.shape.end(), [](int n) { return n < 1; })) {
    throw ModelError(fmt::format(
        "recorded quantity \"{}\": every extent must be at least 1. Leave out what has no values.",
        path));
  }
  const std::size_t last =
      channel.shape.empty() ? 1 : static_cast<std::size_t>(channel.shape.back());
  if (!channel.components.empty() && channel.components.size() != last) {
    throw ModelError(fmt::format("recorded quantity \"{}\": {} component names for {} components.",
                                 path, channel.components.size(), last));
  }
  offsets_.push_back(num_values_);
  num_values_ += channel.size();
  index_.emplace(path, channels_.size());
  parents_.insert(parents.begin(), parents.end());
  channels_.push_back(std::move(channel));
  return channels_.size() - 1;
}

int RecordLayout::find(std::string_view path) const {
  const auto found = index_.find(std::string(path));
  return found == index_.end() ? -1 : static_cast<int>(found->second);
}

}  // namespace buckens::results
