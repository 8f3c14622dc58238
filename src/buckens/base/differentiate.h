// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

namespace buckens::base {

/// Derivative of order 1 or 2 of f at t by central differences, extrapolated in the square of their
/// distance (Ridders, Adv. Eng. Software 4, 1982).
///
/// Distances grow from a tenth of a microsecond up to minutes. A wider difference is accepted only
/// if it agrees with the narrower ones within their own error estimate, so kinks, pulses and
/// short periods away from t do no harm; on smooth functions the error is a few
/// rounding errors of f over its own time scale. Values of f that are not finite end the widening.
/// Cost at most about 90 evaluations of f.
/// @return empty if f is not finite in the nearest neighbourhood of t
std::optional<double> derivative(const std::function<double(double)>& f, double t, int order);

/// Derivative of order 1 or 2 where a motion starts: of f to the right of t alone if f is not
/// defined to the left, or its slope differs there (a kink at t); otherwise derivative().
/// @return empty if f is not finite to the right of t
std::optional<double> starting_derivative(const std::function<double(double)>& f, double t,
                                          int order);

}  // namespace buckens::base
