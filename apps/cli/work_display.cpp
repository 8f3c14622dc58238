// SPDX-License-Identifier: Apache-2.0
#include "cli/work_display.h"

#include <fmt/format.h>

#include "cli/output.h"

namespace buckens::cli {

namespace {

constexpr double kRedrawn = 0.1;  // [s]
constexpr double kNewLine = 5;    // [s]

}  // namespace

std::string work_line(const base::Work& work, double seconds) {
  std::string out = fmt::format("{}: {}", work.name, work.stage);
  if (work.of > 0) {
    out += fmt::format(", {} of {}", work.done, work.of);
  } else if (work.done > 0) {
    out += fmt::format(", {}", work.done);
  }
  return out + fmt::format(", {}", clock_text(seconds));
}

WorkDisplay::WorkDisplay(std::FILE* stream, ProgressDisplay::Style style)
    : stream_(stream), style_(style) {
  if (style == ProgressDisplay::Style::none) return;
  base::set_work_sink([this](const base::Work& work) { show(work); });
}

WorkDisplay::~WorkDisplay() {
  if (style_ != ProgressDisplay::Style::none) base::set_work_sink({});
}

void WorkDisplay::show(const base::Work& work) {
  const bool redraws = style_ == ProgressDisplay::Style::bar;
  if (work.name != name_) {
    name_ = work.name;
    outlook_.clear();
    stage_.clear();
    begin_ = Clock::now();
    next_ = redraws ? 0 : kNewLine;  // short work stays silent where nothing can be wiped
  }
  if (work.stage.empty()) {
    wipe();
    name_.clear();
    return;
  }
  const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
  const bool says_outlook = !work.outlook.empty() && work.outlook != outlook_ &&
                            (redraws || work.is_long || seconds >= next_);
  if (says_outlook) {
    wipe();
    tell(stream_, fmt::format("buckens: {}: {}\n", work.name, work.outlook));
    outlook_ = work.outlook;
  }
  // A stage that begins is seen on a terminal, however short the one before it was.
  const std::string stage = work.stage.substr(0, work.stage.find(','));
  const bool begins = redraws && (stage != stage_ || says_outlook);
  stage_ = stage;
  if (seconds < next_ && !begins) return;
  wipe();
  const std::string line = work_line(work, seconds);
  tell(stream_, redraws ? line.substr(0, static_cast<std::size_t>(columns_of(stream_) - 1))
                        : fmt::format("buckens: {}\n", line));
  next_ = seconds + (redraws ? kRedrawn : kNewLine);
}

void WorkDisplay::wipe() {
  // Something else may stand there, such as the bar of a simulation.
  if (style_ == ProgressDisplay::Style::bar && !name_.empty()) tell(stream_, "\r\033[K");
}

}  // namespace buckens::cli
