// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include "buckens/body/body.h"
#include "buckens/body/free_modes.h"

namespace buckens::body {

/// How the elastic vibrations of a free body are computed; all give the same.
enum class FreeModeMethod {
  /// `subspace` for large bodies, dense for small ones.
  automatic,
  /// Sieved simultaneous inverse iteration with subspace projection on K + μM, FM (30), (31).
  subspace,
  /// Bordered matrix [K −P; −Pᵀ 0], FM (28): the same iteration, rigid motion excluded by Λ.
  augmented,
  /// K + c PPᵀ, FM (29): the same iteration, rigid motion at ω² = c, far above.
  penalty,
  /// Lanczos of the Spectra library on Y (K + μM)⁻¹M.
  spectra,
  /// Dense eigenproblem on {d : Pᵀd = 0}.
  dense
};

constexpr std::array<const char*, 6> choice_names(FreeModeMethod) {
  return {"automatic", "subspace", "augmented", "penalty", "spectra", "dense"};
}
std::string to_string(FreeModeMethod method);

struct FreeModesSettings {
  int count = 10;  ///< modes wanted; fewer come back where the body has fewer
  FreeModeMethod method = FreeModeMethod::automatic;
  /// Relative error of a shape in the sense of `FreeFreeModes::error`; that of ω is its square.
  double tolerance = 1e-9;
  bool judge = true;       ///< whether residuals and errors are computed, one solve per mode
  bool condition = false;  ///< whether the condition number is estimated, about 40 more solves
};

/// Elastic vibrations of a free body with what is known about them.
struct FreeFreeModes : FreeModes {
  FreeModeMethod method = FreeModeMethod::dense;  ///< the one that was used
  /// ‖Kφ − ω²Mφ‖ / ‖ω²Mφ‖ per mode, DOF scaled by 1/√M_ii. Rounding of K alone leaves about
  /// ε(ω_max/ω)².
  linalg::Vector residual;
  /// ‖φ − (ω² + μ) Y(K + μM)⁻¹Mφ‖_M per mode: bound of the relative error of ω² + μ, whatever the
  /// mesh.
  linalg::Vector error;
  double shift = 0;           ///< μ [1/s²], 0 without
  double penalty = 0;         ///< c [1/s²], 0 without
  int sweeps = 0;             ///< block iterations, or Lanczos restarts
  long solves = 0;            ///< large solves, those of estimates included
  int factorisations = 0;     ///< sparse or dense, those given up included
  double factor_entries = 0;  ///< of the last factor: L, L + U, or half a dense matrix
  double condition = 0;       ///< of the factored matrix, DOF scaled to unit diagonal; 0: not asked
};

/// The lowest elastic vibrations of a flexible body, M-orthonormal and sieved: ΨᵀMΨ = 1, PᵀΨ = 0.
///
/// Good for thousands of DOF and more: one sparse Cholesky factor as a rule, about seven to ten
/// solves per mode, no mode missing from a multiple frequency. Theory:
/// docs/theory/04-free-vibration.md.
/// @throws ModelError if a method that works with full matrices is asked for a body too large, or
/// so
///         many modes of one that there is no other
/// @throws NumericalError if the iteration does not converge or M is not positive definite on
///         {d : Pᵀd = 0} where the method needs that
FreeFreeModes free_free_modes(const FlexiblePart& part, const FreeModesSettings& settings);

/// The same with everything at its default.
FreeFreeModes free_free_modes(const FlexiblePart& part, int count);

}  // namespace buckens::body
