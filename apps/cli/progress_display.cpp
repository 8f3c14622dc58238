// SPDX-License-Identifier: Apache-2.0
#include "cli/progress_display.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "cli/output.h"

namespace buckens::cli {

namespace {

constexpr double kBarInterval = 0.1;  // [s]
constexpr double kLineInterval = 5;   // [s]
constexpr int kWidestBar = 30;

double fraction(const analysis::Progress& progress) {
  // Where the number of steps is open, time measures the way.
  if (progress.steps <= 0) {
    return progress.duration > 0 ? std::clamp(progress.t / progress.duration, 0.0, 1.0) : 0;
  }
  return std::clamp(static_cast<double>(progress.step) / static_cast<double>(progress.steps), 0.0,
                    1.0);
}

struct Pace {
  double steps_per_second = 0;
  double remaining = -1;  // [s], negative: not known
};

Pace pace(const analysis::Progress& progress, double seconds) {
  Pace out;
  if (progress.step <= 0 || seconds <= 0) return out;
  out.steps_per_second = static_cast<double>(progress.step) / seconds;
  const double done = fraction(progress);
  if (done > 0) out.remaining = seconds * (1 - done) / done;
  return out;
}

}  // namespace

int columns_of(std::FILE* stream) {
  struct winsize size = {};
  if (::ioctl(::fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  return 80;
}

std::string clock_text(double seconds) {
  if (!(seconds >= 0) || seconds > 3.6e9) return "?";
  const long whole = std::lround(seconds);
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string progress_line(const analysis::Progress& progress, double seconds) {
  const Pace now = pace(progress, seconds);
  const std::string of = progress.steps > 0 ? fmt::format(" of {}", progress.steps) : "";
  return fmt::format("t = {:.4g} of {:.4g} s ({:.0f} %), step {}{}, {:.4g} steps/s, ETA {}",
                     progress.t, progress.duration, 100 * fraction(progress), progress.step, of,
                     now.steps_per_second, clock_text(now.remaining));
}

std::string progress_bar(const analysis::Progress& progress, double seconds, int columns) {
  const Pace now = pace(progress, seconds);
  const std::string text = fmt::format("{:3.0f} %  t = {:.4g} of {:.4g} s  {:.4g} steps/s  ETA {}",
                                       100 * fraction(progress), progress.t, progress.duration,
                                       now.steps_per_second, clock_text(now.remaining));
  // "[bar] text" and one free column, so that no terminal breaks the line.
  const int width = std::min(kWidestBar, columns - static_cast<int>(text.size()) - 4);
  if (width < 4) return text.substr(0, static_cast<std::size_t>(std::max(columns - 1, 0)));
  const auto filled = static_cast<std::size_t>(std::lround(fraction(progress) * width));
  return fmt::format("[{}{}] {}", std::string(filled, '#'),
                     std::string(static_cast<std::size_t>(width) - filled, '.'), text);
}

void ProgressDisplay::show(const analysis::Progress& progress, double seconds) {
  if (style_ == Style::none || seconds < next_) return;
  const std::lock_guard lock(mutex_);
  if (style_ == Style::bar) {
    wipe();
    tell(stream_, progress_bar(progress, seconds, columns_of(stream_)));
    bar_stands_ = true;
    next_ = seconds + kBarInterval;
  } else {
    // Nothing at the very beginning: short runs stay silent.
    if (next_ > 0) tell(stream_, progress_line(progress, seconds) + '\n');
    next_ = seconds + kLineInterval;
  }
}

void ProgressDisplay::message(const std::string& line) {
  const std::lock_guard lock(mutex_);
  wipe();
  tell(stream_, line + '\n');
}

void ProgressDisplay::clear() {
  const std::lock_guard lock(mutex_);
  wipe();
}

void ProgressDisplay::wipe() {
  if (bar_stands_) tell(stream_, "\r\033[K");
  bar_stands_ = false;
}

ProgressDisplay::Style style_for(std::FILE* stream) {
  const char* terminal = std::getenv("TERM");
  const bool can_redraw = terminal != nullptr && std::string_view(terminal) != "dumb";
  return ::isatty(::fileno(stream)) != 0 && can_redraw ? ProgressDisplay::Style::bar
                                                       : ProgressDisplay::Style::lines;
}

}  // namespace buckens::cli
