// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/error/estimate.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

namespace buckens::analysis {

using results::ErrorStatement;
using results::SensorErrors;
using results::UncertainValue;

namespace {

constexpr double kSafetyOfTwo = 3.0;
constexpr double kSafetyOfExact = 1.25;
// Error of iterations and rounding, as a fraction of the largest value of a sensor: the Newton
// iteration ends at 1e-10, times the steps over which it adds up.
constexpr double kIterations = 1e-9;
// Two runs that differ by this share of the range of a curve say nothing about it.
constexpr double kUnresolved = 0.5;
// Differences below this share of the sensor do not matter, whatever the component.
constexpr double kRelevant = 1e-3;
constexpr double kSameInstant = 1e-9;

/// The value of largest magnitude: a maximum, or a minimum.
struct Extremum {
  double value = 0, at = 0;
};

/// Whether a curve bends the same way at a record and at its neighbours. At a jump or a kink it
/// does not, and a parabola would overshoot.
bool is_smooth(const std::vector<double>& x, std::size_t k, std::size_t stride) {
  const auto bend = [&](std::size_t i) { return x[i + stride] - 2.0 * x[i] + x[i - stride]; };
  if (k < 2 * stride || k + 2 * stride >= x.size()) return true;  // nothing to compare with
  return bend(k) * bend(k - stride) > 0.0 && bend(k) * bend(k + stride) > 0.0;
}

/// Vertex of the parabola through a record and those `stride` before and after it; the record
/// itself if there are none, or they are not evenly spaced (ends of runs).
Extremum vertex(const std::vector<double>& t, const std::vector<double>& x, std::size_t k,
                std::size_t stride = 1) {
  Extremum out{x[k], t[k]};
  if (k < stride || k + stride >= x.size()) return out;
  const double h = t[k] - t[k - stride];
  if (std::abs(t[k + stride] - t[k] - h) > 1e-6 * h) return out;
  const double slope = 0.5 * (x[k + stride] - x[k - stride]);
  const double curvature = x[k + stride] - 2.0 * x[k] + x[k - stride];
  if (curvature == 0.0 || !is_smooth(x, k, stride)) return out;
  const double shift = -slope / curvature;
  if (std::abs(shift) > 1.0) return out;
  return {x[k] + 0.5 * slope * shift, t[k] + shift * h};
}

/// @param sign 1: largest value, −1: smallest
std::size_t extreme_record(const std::vector<double>& x, double sign) {
  const auto less = [sign](double a, double b) { return sign * a < sign * b; };
  return static_cast<std::size_t>(std::max_element(x.begin(), x.end(), less) - x.begin());
}

Extremum extremum(const std::vector<double>& t, const std::vector<double>& x, double sign) {
  return vertex(t, x, extreme_record(x, sign));
}

/// Error of an extremum due to the distance of records, from the parabola through records twice as
/// far apart. Parabolas err by the fourth power of the distance, but the extremum is at a different
/// position between the records of each: the whole difference is used, not a fifteenth. At a kink
/// the extremum lies beyond the record by at most what the flatter side changes within a record.
double sampling_error(const std::vector<double>& t, const std::vector<double>& x, double sign) {
  const std::size_t k = extreme_record(x, sign);
  if (!is_smooth(x, k, 1)) {
    return std::min(std::abs(x[k] - x[k - 1]), std::abs(x[k + 1] - x[k]));
  }
  return std::abs(vertex(t, x, k).value - vertex(t, x, k, 2).value);
}

double largest_magnitude(const std::vector<double>& x) {
  double out = 0;
  for (const double value : x) out = std::max(out, std::abs(value));
  return out;
}

/// "tip" of "tip.x".
std::string sensor_of(const std::string& curve) { return curve.substr(0, curve.rfind('.')); }

double sign_of_peak(const std::vector<double>& x) {
  const auto [least, most] = std::minmax_element(x.begin(), x.end());
  return std::abs(*most) >= std::abs(*least) ? 1.0 : -1.0;
}

/// A curve at an instant, linear between records.
double value_at(const std::vector<double>& t, const std::vector<double>& x, double when) {
  const double near = kSameInstant * std::max(std::abs(t.back()), std::abs(when));
  const auto next =
      static_cast<std::size_t>(std::lower_bound(t.begin(), t.end(), when - near) - t.begin());
  if (next >= t.size()) return x.back();
  if (next == 0 || std::abs(t[next] - when) <= near) return x[next];
  const double share = (when - t[next - 1]) / (t[next] - t[next - 1]);
  return x[next - 1] + share * (x[next] - x[next - 1]);
}

UncertainValue total(UncertainValue value, double scale) {
  value.uncertainty = std::accumulate(value.parts.begin(), value.parts.end(), kIterations * scale);
  return value;
}

}  // namespace

double two_grid_factor(double refinement) {
  const double square = refinement * refinement;
  return kSafetyOfTwo * square / (square - 1.0);
}

double exact_factor() { return kSafetyOfExact; }

ErrorEstimate::ErrorEstimate(const SensorCurves& run) : run_(run) {
  for (const SensorCurve& curve : run.curves()) {
    SensorErrors errors;
    errors.name = curve.name;
    errors.unit = curve.unit;
    if (!curve.values.empty()) {
      const Extremum peak = extremum(run.times(), curve.values, sign_of_peak(curve.values));
      const auto [least, most] = std::minmax_element(curve.values.begin(), curve.values.end());
      errors.peak.value = peak.value;
      errors.peak.at = peak.at;
      errors.sampling = sampling_error(run.times(), curve.values, sign_of_peak(curve.values));
      errors.last.value = curve.values.back();
      errors.last.at = run.times().back();
      errors.range = *most - *least;
    }
    for (const SensorCurve& other : run.curves()) {
      if (sensor_of(other.name) != sensor_of(curve.name)) continue;
      errors.scale = std::max(errors.scale, largest_magnitude(other.values));
    }
    out_.sensors.push_back(std::move(errors));
  }
}

void ErrorEstimate::add(results::ErrorSource source, const SensorCurves& further) {
  for (SensorErrors& errors : out_.sensors) {
    const SensorCurve* own = run_.find(errors.name);
    const SensorCurve* other = further.find(errors.name);
    const bool is_there = other != nullptr && !other->values.empty() && !own->values.empty();
    double peak = 0, last = 0, curve = 0, at = errors.curve.at;
    if (is_there) {
      const std::vector<double>& t = run_.times();
      const Extremum extreme = extremum(further.times(), other->values, sign_of_peak(own->values));
      peak = std::abs(extreme.value - errors.peak.value);
      last = std::abs(other->values.back() - errors.last.value);
      for (std::size_t k = 0; k < t.size(); ++k) {
        const double off =
            std::abs(value_at(further.times(), other->values, t[k]) - own->values[k]);
        if (off <= curve) continue;
        curve = off;
        at = t[k];
      }
    }
    const double before = errors.curve.parts.empty() ? 0.0
                                                     : *std::max_element(errors.curve.parts.begin(),
                                                                         errors.curve.parts.end());
    if (source.factor * curve > before) {
      errors.curve.at = at;
      errors.curve.value = value_at(run_.times(), own->values, at);
    }
    // A curve that does not vary has no phase to lose.
    const bool varies = errors.range > kIterations * errors.scale;
    if (source.name == results::kTimeStepSource && varies && curve > kUnresolved * errors.range &&
        curve > kRelevant * errors.scale) {
      errors.is_resolved = false;
    }
    errors.peak.parts.push_back(source.factor * peak);
    errors.last.parts.push_back(source.factor * last);
    errors.curve.parts.push_back(source.factor * curve);
  }
  out_.sources.push_back(std::move(source));
}

ErrorStatement ErrorEstimate::statement() const {
  ErrorStatement out = out_;
  for (SensorErrors& errors : out.sensors) {
    errors.peak = total(errors.peak, errors.scale);
    errors.peak.uncertainty += errors.sampling;
    errors.last = total(errors.last, errors.scale);
    errors.curve = total(errors.curve, errors.scale);
  }
  return out;
}

}  // namespace buckens::analysis
