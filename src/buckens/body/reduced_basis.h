// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "buckens/body/body.h"

namespace buckens::body {

/// Basis vectors of the deformation of a body, d = Z η, and what they omit.
struct ReducedBasis {
  linalg::Matrix Z;         ///< n×r, M-orthonormal, K-orthogonal, free of rigid motion
  linalg::Vector omega;     ///< √(zᵀKz) of each [rad/s], ascending
  int num_modes = 0;        ///< vibrations in it
  int num_residuals = 0;    ///< deformations by static loads
  double highest_mode = 0;  ///< highest frequency of its vibrations [rad/s]
  double static_share = 0;  ///< see ReductionFigures
};

/// The lowest free modes of a body, optionally with the remaining deformations by unit interface
/// loads (inertia-relief residuals).
///
/// Modes and residuals carry no rigid motion, so a body reduced to them needs no sieve. With
/// residuals, the response to slow interface loads is that of the full mesh for any number of
/// modes.
/// @param modes requested number; fewer if the body has fewer, more if the last one has neighbours
/// of the same frequency (to 1e-3), of which a basis needs all or none
/// @param length scale that makes rotations and translations comparable [m]
/// @throws ModelError naming the body if its mesh is a mechanism
ReducedBasis free_free_basis(const std::string& body, const FlexiblePart& part, int modes,
                             bool static_correction, double length);

/// Fixed-interface modes of a Craig–Bampton basis: the lowest ones, `modes` of them or all up to
/// `cutoff`, and those with the frequency of the last one (to 1e-3).
struct CraigBamptonChoice {
  std::optional<int> modes;
  double cutoff = 0;  ///< [rad/s], used if `modes` is empty
  bool static_correction = true;
};

/// Fixed-interface modes and constraint modes [Craig and Bampton, 1968]. Rigid motion is sieved out
/// and the rest normalised to ZᵀMZ = 1: if the interface rows fix the body, rows + modes − 6
/// coordinates remain. The static correction adds the responses to the patterns of distributed
/// loads and to the six centrifugal ones.
ReducedBasis craig_bampton_basis(const std::string& body, const FlexiblePart& part,
                                 const CraigBamptonChoice& choice, double length);

/// Deformations of a body without elastic inertia: the responses K⁺ to unit interface loads and to
/// the six centrifugal load patterns, optionally with the lowest free modes as additional shapes.
/// Exact for all loads that do not depend on the deformation.
/// @param modes 0: none
ReducedBasis quasi_static_basis(const std::string& body, const FlexiblePart& part, int modes,
                                double length);

}  // namespace buckens::body
