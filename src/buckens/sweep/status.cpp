// SPDX-License-Identifier: Apache-2.0
#include "buckens/sweep/status.h"

#include <algorithm>
#include <chrono>
#include <set>
#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "buckens/base/errors.h"
#include "buckens/files/output_file.h"
#include "buckens/files/text_file.h"
#include "buckens/run_store/run_files.h"
#include "buckens/sweep/parts.h"

namespace buckens::sweep {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

constexpr char kBegun[] = ".begun";
constexpr char kFailed[] = ".failed";
constexpr char kEnded[] = ".ended";
constexpr char kLock[] = ".lock";

/// On the clock of the disk, which the machines of a cluster share.
std::optional<fs::file_time_type> time_of(const fs::path& file) {
  std::error_code error;
  const fs::file_time_type time = fs::last_write_time(file, error);
  return error ? std::nullopt : std::optional(time);
}

double seconds_since(fs::file_time_type time) {
  return std::chrono::duration<double>(fs::file_time_type::clock::now() - time).count();
}

/// Of a variant's summary.json, which is replaced as a whole; empty: not begun.
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
  fs::file_time_type time;
};

Beginning read_beginning(const fs::path& file) {
  try {
    const auto json = ordered_json::parse(files::read_text_file(file, "note of a shard"));
    Beginning out{file,
                  {json.at("shard"), json.at("shards")},
                  json.at("variants"),
                  time_of(file).value_or(fs::file_time_type::clock::now())};
    if (file.filename() == out.shard.name() + kBegun && out.shard.index >= 1 &&
        out.shard.index <= out.shard.count) {
      return out;
    }
  } catch (const nlohmann::json::exception&) {  // said below
  }
  throw IoError(
      fmt::format("{}: this file is damaged; remove it and start its shard again", file.string()));
}

std::vector<Beginning> read_beginnings(const fs::path& out) {
  std::vector<Beginning> all;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(out / kPartsName, error)) {
    if (entry.path().extension() == kBegun) all.push_back(read_beginning(entry.path()));
  }
  if (all.empty()) {
    throw InputError({out.string(), 0, 0},
                     "no sweep has begun here; give the directory OUT of a `buckens sweep` (for "
                     "buckens.sweep in Python there is buckens.study.status)");
  }
  std::ranges::sort(
      all, {}, [](const Beginning& one) { return std::pair(one.shard.index, one.shard.count); });
  for (const Beginning& one : all) {
    if (one.shard.count == all.front().shard.count) continue;
    throw InputError(
        {one.file.string(), 0, 0},
        fmt::format(
            "this shard is one of {}, {} is one of {}; remove the files of the unwanted division",
            one.shard.count, all.front().file.filename().string(), all.front().shard.count));
  }
  return all;
}

/// Names of variants, one a line; a variant that fails again stands there once.
std::set<std::string> read_failures(const fs::path& file) {
  std::set<std::string> out;
  std::error_code error;
  if (!fs::exists(file, error)) return out;
  std::istringstream lines(files::read_text_file(file, "note of a shard"));
  for (std::string line; std::getline(lines, line);) out.insert(line);
  return out;
}

void look_at_variants(const fs::path& out, const Beginning& beginning, ShardStatus& shard,
                      SweepStatus& status) {
  for (const std::string& name : beginning.variants) {
    const fs::path summary = out / name / run_store::kSummaryName;
    const std::string found = run_status(summary);
    const auto time = time_of(summary);
    if (found.empty() || !time) continue;
    const bool is_new = *time >= beginning.time;
    if (found == "finished") {
      ++shard.finished;
      if (!is_new) ++shard.kept;
    } else if (found != "interrupted" && is_new && !shard.has_ended) {
      ++shard.running;
      const double seconds = seconds_since(*time);  // the file is written when a run begins
      if (seconds <= status.slowest_seconds) continue;
      status.slowest_seconds = seconds;
      status.slowest = name;
    }
  }
}

void add_shard(ShardStatus& sum, const ShardStatus& shard) {
  sum.variants += shard.variants;
  sum.finished += shard.finished;
  sum.failed += shard.failed;
  sum.running += shard.running;
  sum.kept += shard.kept;
  sum.seconds = std::max(sum.seconds, shard.seconds);
}

}  // namespace

ShardNotes::ShardNotes(const fs::path& out, const Shard& shard, const SweepTable& variants)
    : folder_(out / kPartsName), shard_(shard) {
  for (const Variant& variant : variants.variants) variants_.push_back(variant.name);
}

fs::path ShardNotes::file(const char* suffix) const { return folder_ / (shard_.name() + suffix); }

void ShardNotes::lock() {
  lock_ = files::OutputFile(file(kLock), files::OutputFile::Start::as_it_is);
  if (lock_.try_lock()) return;
  const std::string what =
      shard_.count == 1 ? "this sweep" : fmt::format("shard {}/{}", shard_.index, shard_.count);
  throw IoError(
      fmt::format("{}: another process is running {}. Wait for its end, or choose another "
                  "directory (-o) or shard (--shard I/N).",
                  folder_.parent_path().string(), what));
}

void ShardNotes::begin() {
  const ordered_json json = {
      {"shard", shard_.index}, {"shards", shard_.count}, {"variants", variants_}};
  std::error_code error;
  fs::create_directories(folder_, error);
  lock();
  fs::remove(file(kEnded), error);
  fs::remove(file(kFailed), error);
  files::replace_text_file(file(kBegun), json.dump() + '\n');
}

void ShardNotes::add_failure(const std::string& variant) const {
  try {
    files::OutputFile out(file(kFailed), files::OutputFile::Start::as_it_is);
    out.write(variant + '\n');
    out.close();
  } catch (const IoError&) {  // a full disk, say: the table tells it in the end
  }
}

void ShardNotes::end() const { files::replace_text_file(file(kEnded), "ended\n"); }

std::optional<double> ShardStatus::to_go() const {
  if (has_ended || is_complete()) return 0.0;
  const int ended = finished - kept + failed;
  if (ended == 0 || seconds <= 0.0) return std::nullopt;
  return seconds / ended * (variants - finished - failed);
}

std::optional<double> SweepStatus::to_go() const {
  double most = 0.0;
  for (const ShardStatus& shard : shards) {
    if (!shard.has_begun) continue;
    const std::optional<double> one = shard.to_go();
    if (!one) return std::nullopt;
    most = std::max(most, *one);
  }
  return most;
}

SweepStatus read_status(const fs::path& out) {
  const std::vector<Beginning> beginnings = read_beginnings(out);
  SweepStatus status;
  const int count = beginnings.front().shard.count;
  for (int index = 1; index <= count; ++index) status.shards.push_back({.shard = {index, count}});
  for (const Beginning& beginning : beginnings) {
    ShardStatus& shard = status.shards[static_cast<std::size_t>(beginning.shard.index) - 1];
    const fs::path notes = out / kPartsName / shard.shard.name();
    shard.has_begun = true;
    shard.has_ended = time_of(notes.string() + kEnded).has_value();
    shard.variants = static_cast<int>(beginning.variants.size());
    shard.failed = static_cast<int>(read_failures(notes.string() + kFailed).size());
    shard.seconds = seconds_since(beginning.time);
    look_at_variants(out, beginning, shard, status);
    add_shard(status.sum, shard);
  }
  return status;
}

}  // namespace buckens::sweep
