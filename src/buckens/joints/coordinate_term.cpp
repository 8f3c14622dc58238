// SPDX-License-Identifier: Apache-2.0
#include "buckens/joints/coordinate_term.h"

#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::joints {

CoordinateFunction CoordinateFunction::polynomial(std::vector<double> coefficients) {
  CoordinateFunction out;
  out.coefficients_ = std::move(coefficients);
  return out;
}

CoordinateFunction CoordinateFunction::table(const std::vector<std::array<double, 2>>& points,
                                             std::string owner) {
  CoordinateFunction out;
  std::vector<double> x, y;
  for (const auto& point : points) {
    x.push_back(point[0]);
    y.push_back(point[1]);
  }
  out.owner_ = std::move(owner);
  out.first_ = x.front();
  out.last_ = x.back();
  // Its ends are looked after here: a coordinate is no time.
  out.table_ = base::TimeLaw::table(std::move(x), std::move(y), base::Interpolation::spline,
                                    base::Extrapolation::hold);
  return out;
}

void CoordinateFunction::require(double x) const {
  if (x >= first_ && x <= last_) return;
  throw NumericalError(fmt::format(
      "{}: its table covers {:.9g} to {:.9g}, but its value at {:.9g} is needed; add points",
      owner_, first_, last_, x));
}

double CoordinateFunction::value(double x) const {
  if (table_) {
    require(x);
    return table_->value(x);
  }
  double out = 0.0;
  for (std::size_t k = coefficients_.size(); k-- > 0;) out = out * x + coefficients_[k];
  return out;
}

double CoordinateFunction::slope(double x) const {
  if (table_) {
    require(x);
    return table_->rate(x);
  }
  double out = 0.0;
  for (std::size_t k = coefficients_.size(); k-- > 1;) {
    out = out * x + static_cast<double>(k) * coefficients_[k];
  }
  return out;
}

double CoordinateFunction::curvature(double x) const {
  if (table_) {
    require(x);
    return table_->acceleration(x);
  }
  double out = 0.0;
  for (std::size_t k = coefficients_.size(); k-- > 2;) {
    out = out * x + static_cast<double>(k * (k - 1)) * coefficients_[k];
  }
  return out;
}

}  // namespace buckens::joints
