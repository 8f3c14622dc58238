// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "buckens/body/body.h"

namespace buckens::body {

/// Vectors in which a body may deform, d = Z η, and what they omit.
struct ReducedBasis {
  linalg::Matrix Z;         ///< n×r, M-orthonormal, K-orthogonal, free of rigid motion
  linalg::Vector omega;     ///< √(zᵀKz) of each [rad/s], ascending
  int num_modes = 0;        ///< vibrations in it
  int num_residuals = 0;    ///< deformations by static loads
  double highest_mode = 0;  ///< highest frequency of its vibrations [rad/s]
  double static_share = 0;  ///< see ReductionFigures
};

/// The lowest free vibrations of a body, optionally with the deformations by unit interface loads
/// beyond them (inertia-relief residuals).
///
/// Modes and residuals carry no rigid motion, so a body reduced to them needs no sieve. With
/// residuals, the response to slow interface loads is that of the full mesh for any number of
/// modes.
/// @param modes wanted; fewer are returned if the body has fewer, more if the last one has
/// neighbours of the same frequency (to 1e-3), of which a basis needs all or none
/// @param length scale that makes rotations and translations comparable [m]
/// @throws ModelError naming the body if its mesh is a mechanism
ReducedBasis free_free_basis(const std::string& body, const FlexiblePart& part, int modes,
                             bool static_correction, double length);

/// Which vibrations with held interfaces a Craig–Bampton basis takes: the lowest ones, as many as
/// `modes` says or all up to `cutoff`, and those that have the frequency of the last one (to 1e-3).
struct CraigBamptonChoice {
  std::optional<int> modes;
  double cutoff = 0;  ///< [rad/s], used if `modes` is empty
  bool static_correction = true;
};

/// Vibrations with held interface and the deformations by displaced interfaces [Craig and Bampton,
/// 1968]. Rigid motion is sieved out and the rest normalised to ZᵀMZ = 1: with interface rows that
/// fix the body, rows + modes − 6 coordinates remain. The static correction adds the responses to
/// the patterns of distributed loads and to the six centrifugal ones.
ReducedBasis craig_bampton_basis(const std::string& body, const FlexiblePart& part,
                                 const CraigBamptonChoice& choice, double length);

/// Deformations of a body without elastic inertia: the responses K⁺ to unit interface loads and to
/// the six centrifugal load patterns, optionally with the lowest free vibrations as further shapes.
/// Exact for all loads that do not depend on the deformation.
/// @param modes 0: none
ReducedBasis quasi_static_basis(const std::string& body, const FlexiblePart& part, int modes,
                                double length);

}  // namespace buckens::body
