// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/scheme.h"

#include <cmath>

#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::stepping {

std::string to_string(Method method) {
  switch (method) {
    case Method::newmark:
      return "newmark";
    case Method::hht:
      return "hht";
    case Method::wilson:
      return "wilson";
    case Method::generalized_alpha:
      break;
  }
  return "generalized-alpha";
}

Scheme::Scheme(Method method_in, double h_in, double parameter) : method(method_in), h(h_in) {
  if (!(h > 0.0) || !std::isfinite(h)) {
    throw InputError("the step must be a positive time, not " + std::to_string(h) + " s");
  }
  switch (method) {
    case Method::newmark:
      set_average_acceleration();
      break;
    case Method::wilson:
      if (!(parameter >= kLeastTheta) || !std::isfinite(parameter)) {
        throw InputError(
            fmt::format("theta must be at least {}, not {}: below it Wilson's method lets "
                        "vibrations grow that the step does not resolve; 1.4 is usual",
                        kLeastTheta, parameter));
      }
      set_linear_acceleration(parameter);
      break;
    case Method::hht:
      if (!(parameter >= -1.0 / 3.0 && parameter <= 0.0)) {
        throw InputError(fmt::format(
            "alpha must lie between -1/3 and 0, not {}: outside, the method is unstable or loses "
            "its damping; -0.1 is usual",
            parameter));
      }
      alpha_f_ = -parameter;
      set_alpha_method();
      break;
    case Method::generalized_alpha:
      if (!(parameter >= 0.0 && parameter <= 1.0)) {
        throw InputError("rho-inf must lie between 0 and 1, not " + std::to_string(parameter));
      }
      alpha_m_ = (2.0 * parameter - 1.0) / (parameter + 1.0);
      alpha_f_ = parameter / (parameter + 1.0);
      set_alpha_method();
      break;
  }
  mass = force * acceleration_rate;
  damping = force * mean_rate;
  stiffness = force * weight;
}

void Scheme::set_average_acceleration() {
  weight = instant = 0.5;
  force = 0.5 * h * h;
  end_rate = 2.0 / h;
  acceleration_rate = 2.0 / (h * h);
  mean_rate = 1.0 / h;
}

void Scheme::set_alpha_method() {
  gamma_ = 0.5 + alpha_f_ - alpha_m_;
  beta_ = 0.25 * (gamma_ + 0.5) * (gamma_ + 0.5);
  weight = instant = 1.0;
  force = beta_ * h * h;
  end_rate = gamma_ / (beta_ * h);
  acceleration_rate = (1.0 - alpha_m_) / (1.0 - alpha_f_) / force;
  mean_rate = end_rate;
}

void Scheme::set_linear_acceleration(double theta) {
  // x_e, ẋ_e and ẍ_e are the values at t + θh of the motion whose acceleration is linear in time.
  instant = theta;
  weight = theta * theta * theta;
  force = h * h / (6.0 * theta);
  end_rate = 3.0 / h;
  acceleration_rate = 6.0 * theta / (h * h);
  mean_rate = 3.0 * theta * theta / h;
}

double Scheme::error_constant() const {
  // Wilson's displacement has no error of the order h³; its velocity errs by (θ/4 − 1/6) h³ x⁗.
  if (method == Method::wilson) return 0.25 * instant - 1.0 / 6.0;
  return std::abs(beta_ + 0.5 * algorithmic_offset() - 1.0 / 6.0);
}

}  // namespace buckens::stepping
