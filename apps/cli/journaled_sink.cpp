// SPDX-License-Identifier: Apache-2.0
#include "cli/journaled_sink.h"

#include <fmt/format.h>

#include "cli/summary_text.h"

namespace buckens::cli {

void JournaledSink::begin(const results::RecordLayout& layout, const results::Geometry& geometry) {
  directory_.begin(layout, geometry);
  journal_.record(fmt::format("recording {} values in {} channels", layout.num_values(),
                              layout.channels().size()));
}

void JournaledSink::begin_fields(const results::FieldLayout& layout) {
  directory_.begin_fields(layout);
  journal_.record(fmt::format("recording {} values in {} fields over meshes",
                              layout.fields.num_values(), layout.fields.channels().size()));
}

void JournaledSink::write(const results::Record& record) {
  directory_.write(record);
  ++num_records_;
  last_time_ = record.t;
}

void JournaledSink::finish(const results::RunSummary& summary) {
  finished_ = true;
  for (const std::string& text : summary.warnings) journal_.warn_once(text);
  journal_.record(summary_text(summary));
  journal_.close();
  directory_.finish(summary);
}

void JournaledSink::abandon(const std::string& reason) noexcept {
  if (finished_) return;
  try {
    journal_.record("error: " + reason);
    results::RunSummary summary;
    summary.interrupted = reason;
    summary.end_time = last_time_;
    finish(summary);
  } catch (...) {  // the reason itself is thrown on by the caller
  }
}

}  // namespace buckens::cli
