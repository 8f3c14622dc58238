// SPDX-License-Identifier: Apache-2.0
#include "buckens/sweep/shards.h"

#include <algorithm>
#include <charconv>
#include <numeric>
#include <string_view>

#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::sweep {

namespace {

constexpr int kMostShards = 100000;

bool read_count(std::string_view text, int& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

/// Where the ordered variants are cut nearest to an even division, if small groups stay whole.
/// @param begins of the groups in the ordered list, and its length
std::size_t cut_near(std::size_t even, const std::vector<std::size_t>& begins, double shard) {
  const auto after = std::upper_bound(begins.begin(), begins.end(), even);
  if (after == begins.end()) return even;
  const std::size_t low = *(after - 1), high = *after;
  if (static_cast<double>(high - low) > shard) return even;
  return even - low <= high - even ? low : high;
}

}  // namespace

std::string Shard::name() const { return fmt::format("{}-of-{}", index, count); }

Shard parse_shard(const std::string& text) {
  const std::size_t slash = text.find('/');
  Shard shard;
  const bool is_read = slash != std::string::npos &&
                       read_count(std::string_view(text).substr(0, slash), shard.index) &&
                       read_count(std::string_view(text).substr(slash + 1), shard.count);
  if (!is_read || shard.count < 1 || shard.count > kMostShards || shard.index < 1 ||
      shard.index > shard.count) {
    throw InputError(
        {"--shard " + text, 0, 0},
        fmt::format("a shard is I/N with whole numbers 1 <= I <= N <= {}; the third of "
                    "eight is 3/8",
                    kMostShards));
  }
  return shard;
}

std::vector<std::vector<std::size_t>> divide_into_shards(const std::vector<int>& groups,
                                                         int count) {
  std::vector<std::size_t> order(groups.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return groups[a] < groups[b]; });
  std::vector<std::size_t> begins;
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (k == 0 || groups[order[k]] != groups[order[k - 1]]) begins.push_back(k);
  }
  begins.push_back(order.size());
  const auto shards = static_cast<std::size_t>(count);
  const double shard = static_cast<double>(order.size()) / count;
  std::vector<std::vector<std::size_t>> out(shards);
  std::size_t begin = 0;
  for (std::size_t s = 0; s < shards; ++s) {
    const std::size_t even = (s + 1) * order.size() / shards;
    const std::size_t end =
        s + 1 == shards ? order.size() : std::max(begin, cut_near(even, begins, shard));
    out[s].assign(order.begin() + static_cast<std::ptrdiff_t>(begin),
                  order.begin() + static_cast<std::ptrdiff_t>(end));
    begin = end;
  }
  return out;
}

SweepTable selected(const SweepTable& table, const std::vector<std::size_t>& variants) {
  SweepTable out{table.paths, {}};
  for (const std::size_t v : variants) out.variants.push_back(table.variants[v]);
  return out;
}

}  // namespace buckens::sweep
