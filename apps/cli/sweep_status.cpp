// SPDX-License-Identifier: Apache-2.0
#include "cli/sweep_status.h"

#include <vector>

#include <fmt/format.h>

#include "cli/output.h"
#include "cli/progress_display.h"
#include "cli/text_table.h"

namespace buckens::cli {

namespace {

// A shard or variant that runs this much longer than others is worth a word, shorter ones are not.
constexpr double kWorthAWord = 10.0;  // [s]

const char* state_of(const sweep::ShardStatus& shard) {
  if (!shard.has_begun) return "not begun";
  if (!shard.has_ended) return "begun";
  return shard.is_complete() ? "ended" : "interrupted";
}

}  // namespace

std::string status_text(const sweep::SweepStatus& status) {
  const sweep::ShardStatus& sum = status.sum;
  std::string out = fmt::format("{} of {} variants finished, {} failed, {} running", sum.finished,
                                sum.variants, sum.failed, sum.running);
  if (const auto to_go = status.to_go(); to_go && *to_go > 0.0) {
    out += fmt::format(", ETA {}", clock_text(*to_go));
  }
  out += '\n';
  if (!status.slowest.empty() && status.slowest_seconds > kWorthAWord) {
    out += fmt::format("longest: {}, running for {}\n", status.slowest,
                       clock_text(status.slowest_seconds));
  }
  if (status.shards.size() == 1) return out;
  std::vector<std::vector<std::string>> rows = {
      {"shard", "state", "variants", "finished", "failed", "running"}};
  for (const sweep::ShardStatus& shard : status.shards) {
    rows.push_back({fmt::format("{}/{}", shard.shard.index, shard.shard.count), state_of(shard),
                    shard.has_begun ? fmt::to_string(shard.variants) : "?",
                    fmt::to_string(shard.finished), fmt::to_string(shard.failed),
                    fmt::to_string(shard.running)});
  }
  return out + text_table(rows);
}

std::string status_json(const sweep::SweepStatus& status) {
  nlohmann::ordered_json shards = nlohmann::ordered_json::array();
  for (const sweep::ShardStatus& shard : status.shards) {
    shards.push_back({{"shard", shard.shard.index},
                      {"state", state_of(shard)},
                      {"variants", shard.variants},
                      {"finished", shard.finished},
                      {"failed", shard.failed},
                      {"running", shard.running}});
  }
  const auto to_go = status.to_go();
  return to_text({{"variants", status.sum.variants},
                  {"finished", status.sum.finished},
                  {"failed", status.sum.failed},
                  {"running", status.sum.running},
                  {"seconds", status.sum.seconds},
                  {"to_go", to_go ? nlohmann::ordered_json(*to_go) : nlohmann::ordered_json()},
                  {"slowest", status.slowest},
                  {"shards", std::move(shards)}});
}

}  // namespace buckens::cli
