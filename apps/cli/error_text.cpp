// SPDX-License-Identifier: Apache-2.0
#include "cli/error_text.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "cli/text_table.h"

#include "buckens/results/unassessed.h"

namespace buckens::cli {

namespace {

// Components below this share of their sensor are rounding, and not listed.
constexpr double kRounding = 1e-9;

/// As many digits as stand: "0.01877 ± 0.00012" is 0.01877 and 0.00012.
std::string number_with(double value, double uncertainty) {
  if (!(uncertainty > 0.0) || value == 0.0) return fmt::format("{:.6g}", value);
  const double digits = std::ceil(std::log10(std::abs(value) / uncertainty)) + 1.0;
  return fmt::format("{:.{}g}", value, static_cast<int>(std::clamp(digits, 2.0, 12.0)));
}

std::string share(double part) { return part > 0.0 ? fmt::format("{:.2g}", part) : "0"; }

}  // namespace

std::string error_text(const results::ErrorStatement& errors) {
  std::vector<std::string> head = {"sensor", "unit", "peak", "+-"};
  for (const results::ErrorSource& source : errors.sources) head.push_back(source.name);
  head.insert(head.end(), {"end", "+-", "curve +-"});
  // Uncertainties that lack a source are lower bounds.
  const char* const sign = results::unassessed(errors).empty() ? "" : ">= ";
  std::vector<std::vector<std::string>> rows = {head};
  for (const results::SensorErrors& sensor : errors.sensors) {
    const double size = std::max(std::abs(sensor.peak.value), sensor.range);
    if (size <= kRounding * sensor.scale && sensor.scale > 0.0) continue;
    rows.push_back({sensor.name, sensor.unit,
                    number_with(sensor.peak.value, sensor.peak.uncertainty),
                    sign + share(sensor.peak.uncertainty)});
    for (const double part : sensor.peak.parts) rows.back().push_back(share(part));
    rows.back().push_back(number_with(sensor.last.value, sensor.last.uncertainty));
    rows.back().push_back(sign + share(sensor.last.uncertainty));
    rows.back().push_back(sensor.is_resolved ? sign + share(sensor.curve.uncertainty)
                                             : "not resolved");
  }
  std::string out = "error statement\n" + text_table(rows);
  for (const results::ErrorSource& source : errors.sources) {
    out += fmt::format("  {}: {}, {} steps, {:.3g} s\n", source.name, source.what, source.steps,
                       source.seconds);
  }
  if (!errors.is_complete) out += "  INCOMPLETE: interrupted before all runs were finished\n";
  for (const std::string& text : errors.notes) out += "  not in it: " + text + '\n';
  return out;
}

}  // namespace buckens::cli
