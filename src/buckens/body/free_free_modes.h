// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include "buckens/body/body.h"
#include "buckens/body/free_modes.h"

namespace buckens::body {

/// How the elastic vibrations of a free body are computed; all methods give the same result.
enum class FreeModeMethod {
  /// `subspace` for large bodies, `slepc` if several processes share them, dense for small ones.
  automatic,
  /// Sieved simultaneous inverse iteration with subspace projection on K + μM, FM (30), (31).
  subspace,
  /// Bordered matrix [K −P; −Pᵀ 0], FM (28): the same iteration, rigid motion excluded by Λ.
  augmented,
  /// K + c PPᵀ, FM (29): the same iteration, rigid motion at ω² = c, far above.
  penalty,
  /// Lanczos of the Spectra library on Y (K + μM)⁻¹M.
  spectra,
  /// Krylov–Schur of SLEPc on the same, by the processes of a run that share a large body.
  slepc,
  /// Dense eigenproblem on {d : Pᵀd = 0}.
  dense
};

constexpr std::array<const char*, 7> choice_names(FreeModeMethod) {
  return {"automatic", "subspace", "augmented", "penalty", "spectra", "slepc", "dense"};
}
std::string to_string(FreeModeMethod method);

struct FreeModesSettings {
  int count = 10;  ///< modes wanted; fewer are returned if the body has fewer
  FreeModeMethod method = FreeModeMethod::automatic;
  /// Relative error of a shape in the sense of `FreeFreeModes::error`; that of ω is its square.
  double tolerance = 1e-9;
  bool judge = true;       ///< whether residuals and errors are computed, one solve per mode
  bool condition = false;  ///< whether the condition number is estimated, about 40 more solves
};

/// Elastic vibrations of a free body and their accuracy.
struct FreeFreeModes : FreeModes {
  FreeModeMethod method = FreeModeMethod::dense;  ///< the one that was used
  /// ‖Kφ − ω²Mφ‖ / ‖ω²Mφ‖ per mode, DOF scaled by 1/√M_ii. Rounding of K alone causes about
  /// ε(ω_max/ω)².
  linalg::Vector residual;
  /// ‖φ − (ω² + μ) Y(K + μM)⁻¹Mφ‖_M per mode: bound of the relative error of ω² + μ for any
  /// mesh.
  linalg::Vector error;
  double shift = 0;           ///< μ [1/s²], 0 if unused
  double penalty = 0;         ///< c [1/s²], 0 if unused
  int sweeps = 0;             ///< block iterations, or Lanczos restarts
  long solves = 0;            ///< large solves, including those for estimates
  int factorisations = 0;     ///< sparse or dense, including abandoned ones
  double factor_entries = 0;  ///< of the last factor: L, L + U, or half a dense matrix
  double condition = 0;       ///< of the factored matrix, scaled to unit diagonal; 0: not computed
};

/// The lowest elastic vibrations of a flexible body, M-orthonormal and sieved: ΨᵀMΨ = 1, PᵀΨ = 0.
///
/// Suitable for thousands of DOF and more: usually one sparse Cholesky factor, about seven to ten
/// solves per mode, no mode of a multiple frequency is missed. Theory:
/// docs/theory/04-free-vibration.md.
/// @throws ModelError if a method with full matrices is requested for
/// too large a body, or so many modes of one that only such a method
/// would do
/// @throws NumericalError if the iteration does not converge or M is not positive definite on
///         {d : Pᵀd = 0} where the method needs that
FreeFreeModes free_free_modes(const FlexiblePart& part, const FreeModesSettings& settings);

/// The same with defaults.
FreeFreeModes free_free_modes(const FlexiblePart& part, int count);

}  // namespace buckens::body
