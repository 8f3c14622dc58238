// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "buckens/body/nodal_motion.h"
#include "buckens/linalg/factor.h"
#include "buckens/stepping/scheme.h"

namespace buckens::stepping {

using InterfaceRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Columns with which a body answers loads along its rows N: n-sized and constant. Variants of a
/// model have them in common.
struct BodyResponses {
  /// What they depend on. Of two bodies with one factor and one motion, M and K̂ are the same.
  struct Source {
    const linalg::Factor* factor = nullptr;
    const body::NodalMotion* motion = nullptr;
    std::array<std::uint64_t, 2> rest{};  ///< hash of N without patterns, C and the scheme

    Source() = default;
    Source(const linalg::Factor* of, const body::NodalMotion* by, const body::FlexiblePart& part,
           const InterfaceRows& N, const Scheme& scheme);
    bool operator==(const Source&) const = default;
  };

  Source source;
  linalg::Matrix G;  ///< Y K̂⁻¹ Nᵀ
  /// Of the rows of the interface, D of a correction's effect on x⁺; empty: D = G.
  linalg::Matrix D_less_G;

  /// Adds factor × columns × weights, as many columns as there are weights, to a piece of a vector.
  /// Allocates nothing. @param first row of the piece
  static void add_columns(const linalg::Matrix& columns,
                          const Eigen::Ref<const Eigen::VectorXd>& weights, double factor,
                          Eigen::Index first, Eigen::Ref<linalg::Vector> piece);
};

}  // namespace buckens::stepping
