// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <Eigen/Dense>

namespace buckens::stepping {

/// Time integration methods. The names are those of the model file.
enum class Method { generalized_alpha, newmark };

std::string to_string(Method method);

/// What one coordinate x with rate ẋ knows about the coming step. With Δ the unknown increment:
///
///     x⁺ = x + Δ,   ẋ⁺ = s₁ Δ + velocity,   ẍ_e = s₂ Δ + acceleration,   ẋ_e = s_e Δ +
///     mean_velocity
///
/// Index e marks the instant at which the equations of motion are satisfied.
template <class V>
struct History {
  V velocity;
  V acceleration;
  V mean_velocity;
  V predicted;  ///< Δ that the last accelerations suggest
};

/// Coefficients of one step of length h.
///
/// `newmark` is FM (37): average acceleration (β = 1/4, γ = 1/2) with all forces taken as means
/// over the step; equations hold at t + h/2. `generalized_alpha` is the method of Chung and Hulbert
/// in the form of Arnold and Brüls (2007), with algorithmic accelerations; equations hold at t + h.
/// Both lead to the constant matrix  K̂ = mass·M + damping·C + stiffness·K.
class Scheme {
 public:
  /// @param h step [s] > 0
  /// @param rho_inf spectral radius at infinite frequency in [0, 1], generalised-α only
  Scheme(Method method, double h, double rho_inf);

  Method method;
  double h;
  double mass, damping, stiffness;  ///< K̂ = mass M + damping C + stiffness K
  double force;                     ///< c: x⁺ answers a load f with c K̂⁻¹ f
  double end_rate;                  ///< s₁ [1/s]
  double acceleration_rate;         ///< s₂ [1/s²]
  double mean_rate;                 ///< s_e [1/s]
  double weight;                    ///< θ: x_e = x + θ Δ; 1 or 1/2

  double evaluation_time(double t) const { return t + weight * h; }

  template <class V>
  History<V> history(const V& rate, const V& acceleration, const V& algorithmic) const {
    if (method == Method::newmark) {
      return {-rate, (-2.0 / h) * rate, 0.0 * rate, h * rate + (0.5 * h * h) * acceleration};
    }
    const V predicted = h * rate + (h * h * (0.5 - beta_)) * algorithmic;
    const V velocity = rate + (h * (1.0 - gamma_)) * algorithmic - end_rate * predicted;
    const V mixed = (alpha_m_ * algorithmic - alpha_f_ * acceleration) / (1.0 - alpha_f_);
    const V start = mixed - acceleration_rate * predicted;
    return {velocity, start, velocity, predicted + (beta_ * h * h) * algorithmic};
  }

  /// Algorithmic acceleration at the end of the step from the true one there.
  template <class V>
  V algorithmic(const V& acceleration_before, const V& algorithmic_before,
                const V& acceleration) const {
    if (method == Method::newmark) return acceleration;
    return ((1.0 - alpha_f_) * acceleration + alpha_f_ * acceleration_before -
            alpha_m_ * algorithmic_before) /
           (1.0 - alpha_m_);
  }

  /// Offset of the algorithmic acceleration: it approximates ẍ(t + offset·h).
  double algorithmic_offset() const { return alpha_m_ - alpha_f_; }

 private:
  double alpha_m_ = 0, alpha_f_ = 0, beta_ = 0.25, gamma_ = 0.5;
};

}  // namespace buckens::stepping
