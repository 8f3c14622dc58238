// SPDX-License-Identifier: Apache-2.0
#include "buckens/sweep/parts.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "buckens/base/errors.h"
#include "buckens/base/version.h"
#include "buckens/files/output_file.h"
#include "buckens/files/text_file.h"
#include "buckens/linalg/content_hash.h"
#include "buckens/model_file/model_file.h"

namespace buckens::sweep {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

void add_text(linalg::ContentHash& hash, const std::string& text) {
  hash.add(text.size());
  hash.add(text.data(), text.size());
}

struct Part {
  fs::path file;
  Shard shard;
  std::string version, study;
  std::map<std::string, std::string> files;  // of variants: contents by path
  std::vector<std::pair<std::size_t, SummaryCells>> rows;
};

Part read_part(const fs::path& file) {
  const auto json = ordered_json::parse(files::read_text_file(file, "part of a sweep"));
  Part out{file,
           {json.at("shard"), json.at("shards")},
           json.at("version"),
           json.at("study"),
           json.at("files"),
           {}};
  for (const auto& row : json.at("rows")) {
    SummaryCells cells;
    for (const auto& cell : row.at("cells")) cells.emplace_back(cell.at(0), cell.at(1));
    out.rows.emplace_back(row.at("index").get<std::size_t>(), std::move(cells));
  }
  return out;
}

std::vector<Part> read_parts(const fs::path& out) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(out / kPartsName, error)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  if (files.empty()) {
    throw InputError({out.string(), 0, 0},
                     "there are no parts of a sweep to merge here; run `buckens sweep MODEL TABLE "
                     "-o OUT --shard I/N` for every I from 1 to N first");
  }
  std::sort(files.begin(), files.end());
  std::vector<Part> parts;
  for (const fs::path& file : files) {
    try {
      parts.push_back(read_part(file));
    } catch (const nlohmann::json::exception&) {
      throw IoError(
          fmt::format("{}: this is not a part of a sweep, or it is damaged; remove it and "
                      "run its shard again, which keeps what is finished",
                      file.string()));
    }
  }
  return parts;
}

/// The study hashes what the model without variants reads, but not what only variants do.
void check_files(const std::vector<Part>& parts) {
  std::map<std::string, std::pair<std::string, const Part*>> known;
  for (const Part& part : parts) {
    for (const auto& [path, content] : part.files) {
      const auto [at, is_new] = known.emplace(path, std::pair(content, &part));
      if (is_new || at->second.first == content) continue;
      throw InputError(
          {part.file.string(), 0, 0},
          fmt::format("the variants of this part have read another content of {} than those of {}; "
                      "run both shards again, which keeps what is up to date",
                      path, at->second.second->file.filename().string()));
    }
  }
}

void check_parts(const fs::path& out, const std::vector<Part>& parts) {
  const Part& first = parts.front();
  std::map<int, std::string> there;
  for (const Part& part : parts) {
    const SourceLocation where{part.file.string(), 0, 0};
    const std::string other = first.file.filename().string();
    if (part.shard.count != first.shard.count) {
      throw InputError(where, fmt::format("this part is one of {} shards, {} is one of {}; remove "
                                          "the files of the unwanted division",
                                          part.shard.count, other, first.shard.count));
    }
    if (part.study != first.study) {
      throw InputError(where, fmt::format("this part was made with another model or table than {}; "
                                          "run the shards of one of them again",
                                          other));
    }
    if (part.version != first.version) {
      throw InputError(where, fmt::format("this part was made by Buckens {}, {} by Buckens {}; run "
                                          "all shards with one version",
                                          part.version, other, first.version));
    }
    there[part.shard.index] = other;
  }
  std::string missing;
  int num_missing = 0;
  for (int index = 1; index <= first.shard.count; ++index) {
    if (there.contains(index) || ++num_missing > 10) continue;
    missing += fmt::format("{}{}/{}", missing.empty() ? "" : ", ", index, first.shard.count);
  }
  if (num_missing == 0) return check_files(parts);
  throw InputError(
      {out.string(), 0, 0},
      fmt::format(
          "{} of {} shards have not ended yet: {}{}; run them (again) with `--shard`, which "
          "keeps what is finished",
          num_missing, first.shard.count, missing, num_missing > 10 ? ", ..." : ""));
}

VariantOutcome outcome_of(const SummaryCells& cells) {
  VariantOutcome out;
  for (const auto& [column, cell] : cells) {
    if (column == "name") out.name = cell;
    if (column == "message") out.message = cell;
    if (column != "status") continue;
    for (const auto status : {VariantStatus::done, VariantStatus::kept, VariantStatus::failed}) {
      if (cell == to_string(status)) out.status = status;
    }
  }
  return out;
}

}  // namespace

std::string study_of(const fs::path& model, const std::vector<std::string>& overrides,
                     const SweepTable& table) {
  linalg::ContentHash hash;
  add_text(hash, model_file::read_model_file(model, overrides).source);
  for (const std::string& path : table.paths) add_text(hash, path);
  for (const Variant& variant : table.variants) {
    add_text(hash, variant.name);
    for (const std::string& value : variant.values) add_text(hash, value);
  }
  return hash.text();
}

void write_part(const fs::path& out, const Shard& shard, const std::string& study,
                const std::vector<std::size_t>& variants, const SummaryTable& summary,
                const std::vector<VariantOutcome>& outcomes) {
  ordered_json files = ordered_json::object();
  for (const VariantOutcome& outcome : outcomes) {
    for (const auto& [path, content] : outcome.files) {
      files[path.string()] = fmt::format("{:016x}", content);
    }
  }
  ordered_json rows = ordered_json::array();
  for (std::size_t row = 0; row < summary.num_rows(); ++row) {
    ordered_json cells = ordered_json::array();
    for (const auto& [column, cell] : summary.cells(row)) {
      cells.push_back(ordered_json::array({column, cell}));
    }
    rows.push_back({{"index", variants[row]}, {"cells", std::move(cells)}});
  }
  const ordered_json json = {{"version", kVersion},       {"shard", shard.index},
                             {"shards", shard.count},     {"study", study},
                             {"files", std::move(files)}, {"rows", std::move(rows)}};
  std::error_code error;
  fs::create_directories(out / kPartsName, error);
  files::replace_text_file(out / kPartsName / (shard.name() + ".json"),
                           json.dump(1, ' ', false, ordered_json::error_handler_t::replace) + '\n');
}

MergedSweep merge_parts(const fs::path& out) {
  const std::vector<Part> parts = read_parts(out);
  check_parts(out, parts);
  std::map<std::size_t, const SummaryCells*> rows;
  for (const Part& part : parts) {
    for (const auto& [index, cells] : part.rows) rows[index] = &cells;
  }
  MergedSweep merged;
  merged.shards = parts.front().shard.count;
  for (const auto& [index, cells] : rows) {
    merged.summary.add_row(*cells);
    merged.variants.push_back(outcome_of(*cells));
  }
  return merged;
}

}  // namespace buckens::sweep
