// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/scheme.h"

#include <cmath>

#include "buckens/base/errors.h"

namespace buckens::stepping {

std::string to_string(Method method) {
  return method == Method::newmark ? "newmark" : "generalized-alpha";
}

Scheme::Scheme(Method method_in, double h_in, double rho_inf) : method(method_in), h(h_in) {
  if (!(h > 0.0) || !std::isfinite(h)) {
    throw InputError("the step must be a positive time, not " + std::to_string(h) + " s");
  }
  if (method == Method::newmark) {
    weight = 0.5;
    force = 0.5 * h * h;
    end_rate = 2.0 / h;
    acceleration_rate = 2.0 / (h * h);
    mean_rate = 1.0 / h;
  } else {
    if (!(rho_inf >= 0.0 && rho_inf <= 1.0)) {
      throw InputError("rho-inf must lie between 0 and 1, not " + std::to_string(rho_inf));
    }
    alpha_m_ = (2.0 * rho_inf - 1.0) / (rho_inf + 1.0);
    alpha_f_ = rho_inf / (rho_inf + 1.0);
    gamma_ = 0.5 + alpha_f_ - alpha_m_;
    beta_ = 0.25 * (gamma_ + 0.5) * (gamma_ + 0.5);
    weight = 1.0;
    force = beta_ * h * h;
    end_rate = gamma_ / (beta_ * h);
    acceleration_rate = (1.0 - alpha_m_) / (1.0 - alpha_f_) / force;
    mean_rate = end_rate;
  }
  mass = force * acceleration_rate;
  damping = force * mean_rate;
  stiffness = force * weight;
}

}  // namespace buckens::stepping
