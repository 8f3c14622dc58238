// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/run_comparison.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/results/motion_tables.h"

namespace buckens::run_store {

namespace {

// Record times of runs with other steps differ by rounding.
constexpr double kSameTime = 1e-9;

/// Indices of the records that two runs have at the same time.
struct CommonRecords {
  std::vector<std::size_t> first, second;
};

CommonRecords common_records(const std::vector<double>& a, const std::vector<double>& b) {
  CommonRecords out;
  const double span = std::max(a.empty() ? 0.0 : a.back(), b.empty() ? 0.0 : b.back());
  const double near = kSameTime * std::max(span, 1e-300);
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    if (std::abs(a[i] - b[j]) <= near) {
      out.first.push_back(i++);
      out.second.push_back(j++);
    } else if (a[i] < b[j]) {
      ++i;
    } else {
      ++j;
    }
  }
  return out;
}

/// Components that are compared together: lengths and angles, forces and torques apart.
std::map<std::string, std::vector<std::size_t>> groups_of(const results::Channel& channel) {
  std::map<std::string, std::vector<std::size_t>> out;
  const std::size_t width = std::max<std::size_t>(1, channel.components.size());
  const bool is_of_motions = channel.path == results::kMotionsPath;
  for (std::size_t k = 0; k < channel.size(); ++k) {
    const std::string name = channel.components.empty() ? "" : channel.components[k % width];
    std::string kind;
    if (name.starts_with('r') || name.starts_with('q')) kind = "rotation";
    if (name.starts_with('M')) kind = "moment";
    if (is_of_motions && name.starts_with('v')) kind = "velocity";
    if (is_of_motions && name.starts_with('w')) kind = "angular velocity";
    out[kind].push_back(k);
  }
  if (out.size() == 1) out = {{"", out.begin()->second}};
  return out;
}

/// Numbers per body where a channel begins with its position and quaternion, otherwise 0; sensors
/// may have any name.
std::size_t pose_width(const results::Channel& channel) {
  if (channel.path == results::kMotionsPath) {
    return static_cast<std::size_t>(channel.shape.back());
  }
  const bool is_pose =
      channel.path.starts_with("bodies/") && channel.path.ends_with("/pose") && channel.size() == 7;
  return is_pose ? channel.size() : 0;
}

/// q and −q are the same rotation.
/// @param width numbers per body
void align_quaternions(std::size_t width, const std::vector<double>& a, std::vector<double>& b) {
  for (std::size_t row = 0; row + width <= a.size(); row += width) {
    double product = 0;
    for (std::size_t k = 3; k < 7; ++k) product += a[row + k] * b[row + k];
    for (std::size_t k = 3; k < 7 && product < 0.0; ++k) b[row + k] = -b[row + k];
  }
}

std::string unit_of(const results::Channel& channel, const std::string& kind) {
  // "m, 1, m/s, rad/s": in the order of the kinds.
  std::size_t begin = 0;
  for (int k = kind == "angular velocity" ? 3
               : kind == "velocity"       ? 2
               : kind.empty()             ? 0
                                          : 1;
       k > 0 && channel.unit.find(", ", begin) != std::string::npos; --k) {
    begin = channel.unit.find(", ", begin) + 2;
  }
  return channel.unit.substr(begin, channel.unit.find(", ", begin) - begin);
}

class Comparison {
 public:
  Comparison(const RunReader& first, const RunReader& second, std::size_t numbers_at_once)
      : first_(first),
        second_(second),
        numbers_at_once_(numbers_at_once),
        common_(common_records(first.times(), second.times())) {}

  RunComparison run() {
    out_.is_of_modes = first_.layout().find("modes/frequency") >= 0;
    if (out_.is_of_modes != (second_.layout().find("modes/frequency") >= 0)) {
      throw InputError(
          "one of the runs holds vibrations (buckens modes), the other a motion; compare two of a "
          "kind");
    }
    if (common_.first.empty()) {
      throw InputError(
          "the runs have no record time in common; let both record at the same times (output: "
          "{every: 1 ms})");
    }
    out_.common_times = common_.first.size();
    out_.first_time = first_.times()[common_.first.front()];
    out_.last_time = first_.times()[common_.first.back()];
    for (const results::Channel& channel : first_.layout().channels()) add(channel);
    for (const results::Channel& channel : second_.layout().channels()) {
      if (first_.layout().find(channel.path) < 0) out_.only_in_second.push_back(channel.path);
    }
    scale_energies();
    return std::move(out_);
  }

 private:
  /// Shapes of vibrations have no sign, so that only what belongs to them is compared.
  bool is_compared(const std::string& path) const {
    if (!out_.is_of_modes) return true;
    return path == "modes/frequency" || path == "modes/generalised_mass" ||
           path == "modes/effective_mass";
  }

  void add(const results::Channel& channel) {
    if (!is_compared(channel.path)) return;
    const int other = second_.layout().find(channel.path);
    if (other < 0) {
      out_.only_in_first.push_back(channel.path);
      return;
    }
    if (second_.layout().channel(static_cast<std::size_t>(other)).shape != channel.shape) {
      out_.of_other_shape.push_back(channel.path);
      return;
    }
    const auto groups = groups_of(channel);
    std::vector<QuantityDifference> found(groups.size());
    const std::size_t rows = std::max<std::size_t>(1, numbers_at_once_ / channel.size());
    for (std::size_t begin = 0; begin < common_.first.size(); begin += rows) {
      const std::size_t count = std::min(rows, common_.first.size() - begin);
      const auto records = std::span(common_.first).subspan(begin, count);
      const std::vector<double> a = first_.read(channel.path, records);
      std::vector<double> b =
          second_.read(channel.path, std::span(common_.second).subspan(begin, count));
      if (pose_width(channel) > 0) align_quaternions(pose_width(channel), a, b);
      std::size_t group = 0;
      for (const auto& [kind, components] : groups) {
        compare(records, components, channel.size(), a, b, found[group++]);
      }
    }
    std::size_t group = 0;
    for (const auto& [kind, components] : groups) {
      QuantityDifference& one = found[group++];
      one.quantity = channel.path + (kind.empty() ? "" : " " + kind);
      one.unit = unit_of(channel, kind);
      if (one.difference > 0.0) {
        one.relative = one.largest > 0.0 ? one.difference / one.largest : HUGE_VAL;
      }
      out_.quantities.push_back(std::move(one));
    }
  }

  /// Adds some records to a difference.
  void compare(std::span<const std::size_t> records, const std::vector<std::size_t>& components,
               std::size_t width, const std::vector<double>& a, const std::vector<double>& b,
               QuantityDifference& out) const {
    for (std::size_t row = 0; row < records.size(); ++row) {
      for (const std::size_t k : components) {
        const std::size_t at = row * width + k;
        out.largest = std::max(out.largest, std::abs(a[at]));
        const double difference = std::abs(a[at] - b[at]);
        if (difference <= out.difference) continue;
        out.difference = std::isnan(difference) ? HUGE_VAL : difference;
        out.at = first_.times()[records[row]];
      }
    }
  }

  /// Energies are differences of one another, their balance is rounding at best.
  void scale_energies() {
    double largest = 0;
    for (const auto& q : out_.quantities) {
      if (q.unit == "J") largest = std::max(largest, q.largest);
    }
    for (auto& q : out_.quantities) {
      if (q.unit == "J" && largest > 0.0) q.relative = q.difference / largest;
    }
  }

  const RunReader& first_;
  const RunReader& second_;
  std::size_t numbers_at_once_;
  CommonRecords common_;
  RunComparison out_;
};

}  // namespace

double RunComparison::largest() const {
  double out = 0;
  for (const QuantityDifference& q : quantities) out = std::max(out, q.relative);
  return out;
}

RunComparison compare_runs(const RunReader& first, const RunReader& second,
                           std::size_t numbers_at_once) {
  return Comparison(first, second, numbers_at_once).run();
}

}  // namespace buckens::run_store
