// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "buckens/analysis/vibration/rest_tangent.h"
#include "buckens/linalg/sparse_cholesky.h"
#include "buckens/linalg/sparse_lu.h"

namespace buckens::analysis {

/// Small motions of the assembled system about a state of rest:
///
///     (K − ω²M) x = Gᵀλ + PΛ,   G x = 0,   Pᵀd = 0
///
/// x holds, body by body, the frame coordinates and the nodal variables. K is block-diagonal (zero
/// for frames) plus Γ on the coordinates s = E x that joints and loads see; M holds the frames, the
/// meshes and, for deformed bodies, their coupling L between the two.
///
/// (K + μM)⁻¹ on the admissible motions needs one Cholesky factor of K_b + μM_b per flexible body,
/// the sieve, and one small LU in s and λ:
///
///     (1 + FΓ) s + FGᵀλ = s₀,   G s = 0,   F = E A₀⁻¹Eᵀ,   A₀ = blocks of K + μM
class SystemPencil {
 public:
  SystemPencil(const model::Model& model, const model::State& state, const RestTangent& tangent);

  /// Factorises K + μM. @throws NumericalError if a body's block is not positive definite
  void factorise(double mu);
  /// F ← the admissible motion (K + μM)⁻¹F.
  void apply(linalg::Matrix& F) const;

  /// M X.
  linalg::Matrix times_mass(const linalg::Matrix& X) const;
  int size() const { return size_; }
  /// First unknown of a body: its frame coordinates, then its nodal variables.
  int first(std::size_t body) const { return first_[body]; }
  /// Motions of the frames that satisfy all joints without resistance, M-orthonormal.
  linalg::Matrix zero_modes() const;

  /// xᵀKx of each body's mesh, then of joints and loads.
  std::vector<double> energies(const linalg::Vector& x) const;
  /// Entries of all factors.
  double factor_entries() const;
  /// Frame coordinates of a body, the rotation in body axes and the translation in world axes.
  Eigen::Matrix<double, 6, 1> frame_part(std::size_t body, const linalg::Vector& x) const;
  linalg::Vector nodal_part(std::size_t body, const linalg::Vector& x) const;

  /// Largest stiffness per mass of joints and loads on a frame coordinate [1/s²].
  double stiffest_frame() const;

 private:
  struct Block {
    Eigen::MatrixXd W;           // of the frame coordinates
    linalg::Matrix loads;        // [Nᵀ L], n×(rows + momenta)
    linalg::Matrix response;     // Y (K + μM)⁻¹ of them
    Eigen::MatrixXd mobility;    // W⁻¹
    Eigen::MatrixXd compliance;  // F of this body
    std::shared_ptr<const linalg::Factor> factor;
    const linalg::SymmetricMatrix* divided_mass = nullptr;  // of a mesh of which M_ has none
  };

  void add_masses();
  void factorise_small();
  linalg::Matrix seen(const linalg::Matrix& X) const;

  const model::Model& model_;
  const RestTangent& tangent_;
  std::vector<Block> blocks_;
  std::vector<int> first_;
  int size_ = 0;
  double mu_ = 0;
  linalg::SparseMatrix M_;         // without the meshes that other processes have
  linalg::SparseMatrix gyration_;  // of s: frame rotation against relative momentum
  linalg::SparseMatrix gamma_;     // Γ + μ gyration
  linalg::SparseMatrix rows_;      // scaled
  linalg::Vector scale_;           // of s
  std::unique_ptr<linalg::SparseLu> small_;
};

}  // namespace buckens::analysis
