// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <Eigen/Dense>

namespace buckens::stepping {

/// Time integration methods. The names are those of the model file.
enum class Method { generalized_alpha, newmark, hht, wilson };

std::string to_string(Method method);

/// Prediction for one coordinate x with rate ẋ over the next step. With Δ the unknown increment:
///
///     x⁺ = x + Δ,            ẋ⁺ = s₁ Δ + velocity,   ẍ_e = s₂ Δ + acceleration,
///     x_e = x + θ Δ + offset,   ẋ_e = s_e Δ + mean_velocity
///
/// Index e marks the instant at which the equations of motion are satisfied.
template <class V>
struct History {
  V velocity;
  V acceleration;
  V mean_velocity;
  V predicted;  ///< Δ predicted from the last accelerations
  V offset;     ///< zero unless Scheme::has_offset()
};

/// Coefficients of one step of length h.
///
/// `newmark` is FM (37): average acceleration (β = 1/4, γ = 1/2) with all forces taken as means
/// over the step; equations hold at t + h/2. `generalized_alpha` is the method of Chung and Hulbert
/// in the form of Arnold and Brüls (2007), with algorithmic accelerations; equations hold at t + h.
/// `hht` is that of Hilber, Hughes and Taylor (1977), the same with α_m = 0 and α_f = −α. `wilson`
/// takes accelerations as linear in time and satisfies the equations at t + θh.
/// All lead to the constant matrix  K̂ = mass·M + damping·C + stiffness·K.
class Scheme {
 public:
  /// Smallest θ for which Wilson's method is stable for every step.
  static constexpr double kLeastTheta = 1.366;

  /// @param h step [s] > 0
  /// @param parameter of the method: spectral radius at infinite frequency in [0, 1] for
  ///        generalised-α, α in [−1/3, 0] for HHT, θ ≥ 1.366 for Wilson; unused by Newmark
  /// @throws InputError saying what is out of range and why
  Scheme(Method method, double h, double parameter);

  Method method;
  double h;
  double mass, damping, stiffness;  ///< K̂ = mass M + damping C + stiffness K
  double force;                     ///< c: response of x⁺ to a load f is c K̂⁻¹ f
  double end_rate;                  ///< s₁ [1/s]
  double acceleration_rate;         ///< s₂ [1/s²]
  double mean_rate;                 ///< s_e [1/s]
  double weight;                    ///< θ: x_e = x + θ Δ + offset; 1, 1/2 or Wilson's θ³
  double instant;                   ///< equations hold at t + instant·h; 1, 1/2 or Wilson's θ

  /// Of a force that has acted until the start of a step: with minus this share of it at the end it
  /// has done nothing to the velocity there (1 without numerical damping).
  double undone_at_end() const { return h * acceleration_rate / end_rate - 1.0; }
  double evaluation_time(double t) const { return t + instant * h; }
  /// Whether x_e depends on rate and acceleration at the start beyond Δ.
  bool has_offset() const { return method == Method::wilson; }

  template <class V>
  History<V> history(const V& rate, const V& acceleration, const V& algorithmic) const {
    History<V> out;
    history(rate, acceleration, algorithmic, out);
    return out;
  }
  /// The same into `out`, whose buffers are reused.
  template <class V>
  void history(const V& rate, const V& acceleration, const V& algorithmic, History<V>& out) const {
    if (method == Method::wilson) {
      linear_acceleration(rate, acceleration, out);
    } else if (method == Method::newmark) {
      out.velocity = -rate;
      out.acceleration = (-2.0 / h) * rate;
      out.mean_velocity = 0.0 * rate;
      out.predicted = h * rate + (0.5 * h * h) * acceleration;
      out.offset = 0.0 * rate;
    } else {
      const double ahead = h * h * (0.5 - beta_);
      out.velocity =
          (1.0 - end_rate * h) * rate + (h * (1.0 - gamma_) - end_rate * ahead) * algorithmic;
      out.acceleration = (alpha_m_ / (1.0 - alpha_f_) - acceleration_rate * ahead) * algorithmic -
                         (alpha_f_ / (1.0 - alpha_f_)) * acceleration -
                         (acceleration_rate * h) * rate;
      out.mean_velocity = out.velocity;
      out.predicted = h * rate + (ahead + beta_ * h * h) * algorithmic;
      out.offset = 0.0 * rate;
    }
  }

  /// Acceleration to carry forward: at t + h, for Newmark the mean of the step.
  /// @param evaluated ẍ_e
  template <class V>
  V carried_acceleration(const V& acceleration_before, const V& evaluated) const {
    V out;
    carried_acceleration(acceleration_before, evaluated, out);
    return out;
  }
  /// The same into `out`, which must be neither of the others.
  template <class V>
  void carried_acceleration(const V& acceleration_before, const V& evaluated, V& out) const {
    if (method != Method::wilson) {
      out = evaluated;
    } else {
      out = acceleration_before + (evaluated - acceleration_before) / instant;
    }
  }

  /// Algorithmic acceleration at the end of the step from the acceleration carried there.
  template <class V>
  V algorithmic(const V& acceleration_before, const V& algorithmic_before,
                const V& acceleration) const {
    V out;
    algorithmic(acceleration_before, algorithmic_before, acceleration, out);
    return out;
  }
  /// The same into `out`, which must be none of the others.
  template <class V>
  void algorithmic(const V& acceleration_before, const V& algorithmic_before, const V& acceleration,
                   V& out) const {
    if (!has_algorithmic()) {
      out = acceleration;
    } else {
      out = ((1.0 - alpha_f_) * acceleration + alpha_f_ * acceleration_before -
             alpha_m_ * algorithmic_before) /
            (1.0 - alpha_m_);
    }
  }

  /// s of the change of a velocity over the step, h ((1 − s) a + s a⁺), a the algorithmic
  /// acceleration.
  double share_of_end() const {
    return has_algorithmic() ? gamma_ : method == Method::wilson ? 0.5 : 1.0;
  }
  /// Whether separate algorithmic accelerations are carried along with the true ones.
  bool has_algorithmic() const {
    return method == Method::generalized_alpha || method == Method::hht;
  }
  /// Whether vibrations that the step does not resolve are damped.
  bool damps() const { return has_algorithmic() && gamma_ > 0.5; }
  /// Offset of the algorithmic acceleration: it approximates ẍ(t + offset·h). It has to be rescaled
  /// when h changes; see rescale_algorithmic().
  double algorithmic_offset() const { return alpha_m_ - alpha_f_; }

  /// κ: the error of one step is κ h³ x‴, for a vibration in displacement or in velocity over
  /// frequency, whichever is larger.
  double error_constant() const;

 private:
  template <class V>
  void linear_acceleration(const V& rate, const V& acceleration, History<V>& out) const {
    const double th = instant;
    out.velocity = -2.0 * rate - (0.5 * h) * acceleration;
    out.acceleration = (1.0 - 3.0 * th) * acceleration - (6.0 * th / h) * rate;
    out.mean_velocity = (1.0 - 3.0 * th * th) * rate + (h * th * (1.0 - 1.5 * th)) * acceleration;
    out.predicted = h * rate + (0.5 * h * h) * acceleration;
    out.offset =
        (h * th * (1.0 - th * th)) * rate + (0.5 * h * h * th * th * (1.0 - th)) * acceleration;
  }
  void set_average_acceleration();
  void set_alpha_method();
  void set_linear_acceleration(double theta);

  double alpha_m_ = 0, alpha_f_ = 0, beta_ = 0.25, gamma_ = 0.5;
};

}  // namespace buckens::stepping
