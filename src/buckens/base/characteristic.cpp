// SPDX-License-Identifier: Apache-2.0
#include "buckens/base/characteristic.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/running_integral.h"

namespace buckens::base {

namespace {

// Of differences, as a share of the displacement or rate and beside it [m], [rad] and per s: far
// above rounding, far below what a law changes within.
constexpr double kShare = 1e-6;
constexpr double kLeast = 1e-8;
// Share of its length by which a displacement may lie outside of a table: rounding.
constexpr double kTableRounding = 1e-9;

/// Ascending distances from zero of the corners on one side of it.
std::vector<double> breaks_beyond(const std::vector<double>& corners, double sign) {
  std::vector<double> out;
  for (const double at : corners) {
    if (sign * at > 0.0) out.push_back(sign * at);
  }
  if (sign < 0.0) return {out.rbegin(), out.rend()};
  return out;
}

double value_at(const std::optional<Expression>& expression, const TimeLaw& table, double scale,
                double x, double v) {
  return expression ? scale * (*expression)({x, v}) : table.value(x);
}

}  // namespace

struct Characteristic::Parts {
  Parts(std::optional<Expression> e, double s, TimeLaw t)
      : expression(std::move(e)),
        scale(s),
        table(std::move(t)),
        offset(size_near_zero()),
        above([this](double x) { return offset + value_at(expression, table, scale, x, 0.0); },
              breaks_beyond(table.corners(), 1.0)),
        below([this](double x) { return offset + value_at(expression, table, scale, -x, 0.0); },
              breaks_beyond(table.corners(), -1.0)) {}

  double size_near_zero() const {
    double out = 0.0;
    for (const double x : {0.0, 1e-3, -1e-3, 0.01, -0.01, 0.1, -0.1, 1.0, -1.0}) {
      try {
        out = std::max(out, std::abs(value_at(expression, table, scale, x, 0.0)));
      } catch (const NumericalError&) {
        // Outside of a table, or of what the formula is made for.
      }
    }
    return out;
  }

  std::optional<Expression> expression;
  double scale;
  TimeLaw table;
  /// Added to what is integrated: near a zero of the force rounding would be all there is to see.
  double offset;
  RunningIntegral above, below;
};

Characteristic Characteristic::formula(Expression expression, double scale) {
  Characteristic out;
  out.parts_ = std::make_shared<const Parts>(std::move(expression), scale, TimeLaw());
  return out;
}

Characteristic Characteristic::table(TimeLaw table) {
  Characteristic out;
  out.parts_ = std::make_shared<const Parts>(std::nullopt, 1.0, std::move(table));
  return out;
}

double Characteristic::force(double x, double v) const {
  if (!parts_) return 0.0;
  if (const auto range = parts_->table.range()) {
    const double rounding = kTableRounding * (range->last - range->first);
    if (x < range->first - rounding || x > range->last + rounding) {
      throw NumericalError(
          range->where,
          fmt::format("the table of the characteristic covers {:.6g} to {:.6g}, but its value at "
                      "{:.6g} is needed; add points, or write `extrapolation: hold`",
                      range->first, range->last, x));
    }
  }
  return value_at(parts_->expression, parts_->table, parts_->scale, x, v);
}

double Characteristic::energy(double x) const {
  if (!parts_) return 0.0;
  force(x, 0.0);  // says what is wrong outside of a table
  const double size = std::abs(x);
  return x >= 0.0 ? parts_->above.to(size) - parts_->offset * size
                  : parts_->offset * size - parts_->below.to(size);
}

Characteristic::Slopes Characteristic::slopes(double x, double v) const {
  if (!parts_) return {};
  const auto difference = [](auto&& f, double at) {
    const double d = kShare * std::abs(at) + kLeast;
    return (f(at + d) - f(at - d)) / (2.0 * d);
  };
  Slopes out;
  if (!parts_->expression) {
    // Whoever asks for the force outside hears of it with the name of the load.
    const auto range = parts_->table.range();
    const bool is_inside = !range || (x >= range->first && x <= range->last);
    if (is_inside) out.stiffness = parts_->table.rate(x);
    return out;
  }
  const Expression& f = *parts_->expression;
  out.stiffness = parts_->scale * difference([&](double s) { return f.unchecked({s, v}); }, x);
  out.damping = parts_->scale * difference([&](double s) { return f.unchecked({x, s}); }, v);
  if (!std::isfinite(out.stiffness)) out.stiffness = 0.0;
  if (!std::isfinite(out.damping)) out.damping = 0.0;
  return out;
}

std::string Characteristic::text() const {
  if (!parts_) return "0";
  return parts_->expression ? '"' + parts_->expression->text() + '"' : parts_->table.text();
}

}  // namespace buckens::base
