// SPDX-License-Identifier: Apache-2.0
#include "buckens/sweep/status.h"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "buckens/base/errors.h"
#include "buckens/files/output_file.h"
#include "buckens/files/text_file.h"
#include "buckens/run_store/run_files.h"
#include "buckens/sweep/parts.h"
#include "buckens/sweep/summary.h"

namespace buckens::sweep {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

constexpr char kBegun[] = ".begun";

double seconds_since_written(const fs::path& file) {
  std::error_code error;
  const fs::file_time_type time = fs::last_write_time(file, error);
  if (error) return 0.0;
  return std::chrono::duration<double>(fs::file_time_type::clock::now() - time).count();
}

/// Of a variant's summary.json; empty: not begun. The file is replaced as a whole.
std::string run_status(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) return {};
  const auto json = ordered_json::parse(files::read_text_file(file, "summary"), nullptr, false);
  return json.is_object() ? json.value("status", std::string()) : std::string();
}

/// What a shard noted when it began.
struct Beginning {
  fs::path file;
  Shard shard;
  std::vector<std::string> variants;
};

std::vector<Beginning> read_beginnings(const fs::path& out) {
  std::vector<Beginning> all;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(out / kPartsName, error)) {
    if (entry.path().extension() != kBegun) continue;
    try {
      const auto json = ordered_json::parse(files::read_text_file(entry.path(), "part of a sweep"));
      all.push_back({entry.path(), {json.at("shard"), json.at("shards")}, json.at("variants")});
    } catch (const nlohmann::json::exception&) {
      throw IoError(fmt::format("{}: this file is damaged; remove it and start its shard again",
                                entry.path().string()));
    }
  }
  if (all.empty()) {
    throw InputError({out.string(), 0, 0},
                     "no sweep has begun here; give the directory OUT of a `buckens sweep` (for "
                     "buckens.sweep in Python there is buckens.study.status)");
  }
  std::ranges::sort(all, {}, [](const Beginning& one) { return one.shard.index; });
  for (const Beginning& one : all) {
    if (one.shard.count == all.front().shard.count) continue;
    throw InputError({one.file.string(), 0, 0},
                     fmt::format("this shard is one of {}, {} is one of {}; remove the files of "
                                 "the division that is not wanted",
                                 one.shard.count, all.front().file.filename().string(),
                                 all.front().shard.count));
  }
  return all;
}

void look_at_variants(const fs::path& out, const Beginning& beginning, ShardStatus& shard,
                      SweepStatus& status) {
  for (const std::string& name : beginning.variants) {
    const fs::path summary = out / name / run_store::kSummaryName;
    const std::string found = run_status(summary);
    if (found == "finished") {
      ++shard.finished;
    } else if (found == "interrupted") {
      ++shard.failed;
    } else if (!found.empty()) {
      ++shard.running;
      const double seconds = seconds_since_written(summary);
      if (seconds <= status.slowest_seconds) continue;
      status.slowest_seconds = seconds;
      status.slowest = name;
    }
  }
}

}  // namespace

std::optional<double> SweepStatus::to_go() const {
  const int ended = sum.finished + sum.failed;
  if (ended == 0 || seconds <= 0.0) return std::nullopt;
  return seconds / ended * (sum.variants - ended);
}

void note_beginning(const fs::path& out, const Shard& shard, const SweepTable& table) {
  std::vector<std::string> names;
  for (const Variant& variant : table.variants) names.push_back(variant.name);
  const ordered_json json = {{"shard", shard.index}, {"shards", shard.count}, {"variants", names}};
  std::error_code error;
  fs::create_directories(out / kPartsName, error);
  files::replace_text_file(out / kPartsName / (shard.name() + kBegun), json.dump() + '\n');
}

SweepStatus read_status(const fs::path& out) {
  const std::vector<Beginning> beginnings = read_beginnings(out);
  SweepStatus status;
  const int count = beginnings.front().shard.count;
  for (int index = 1; index <= count; ++index) status.shards.push_back({.shard = {index, count}});
  for (const Beginning& beginning : beginnings) {
    ShardStatus& shard = status.shards[static_cast<std::size_t>(beginning.shard.index) - 1];
    shard.has_begun = true;
    shard.variants = static_cast<int>(beginning.variants.size());
    std::error_code error;
    shard.has_ended = fs::exists(out / kPartsName / (shard.shard.name() + ".json"), error) ||
                      (count == 1 && fs::exists(out / kSweepName, error));
    look_at_variants(out, beginning, shard, status);
    status.seconds = std::max(status.seconds, seconds_since_written(beginning.file));
    status.sum.variants += shard.variants;
    status.sum.finished += shard.finished;
    status.sum.failed += shard.failed;
    status.sum.running += shard.running;
  }
  return status;
}

}  // namespace buckens::sweep
