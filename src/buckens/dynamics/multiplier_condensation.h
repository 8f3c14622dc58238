// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "buckens/dynamics/system_kinematics.h"
#include "buckens/linalg/sparse_lu.h"

namespace buckens::dynamics {

/// Response of one body to unit generalised forces, everything condensed to what joints can touch.
struct BodyCompliance {
  /// Frame coordinates per frame load, 6×6 (rotation block, translation block).
  Eigen::Matrix<double, 6, 6> frame = Eigen::Matrix<double, 6, 6>::Zero();
  /// Interface values per interface load, N K̂⁻¹Nᵀ (sieved); empty for rigid bodies. Not owned.
  const linalg::Matrix* interface = nullptr;
};

/// Response of one body to a set of row forces.
struct BodyResponse {
  Eigen::Matrix<double, 6, 1> frame_load = Eigen::Matrix<double, 6, 1>::Zero();
  Eigen::VectorXd interface_load;
};

/// The condensed system of all joint equations, FM (42), (43):
///
///     S = Σ_bodies a ᵀ W⁻¹ a + Aᵀ (Y K̂⁻¹) A  (+ 1/k on the diagonal of soft rows)
///
/// Rows are constraints in use, followed by the soft rows of force elements. Bodies enter only by
/// small dense blocks, so the matrix is sparse across joints; its pattern is found once.
class MultiplierCondensation {
 public:
  /// @param rows one entry per row, with body numbers and marker rows set; values are not read
  MultiplierCondensation(int num_bodies, const std::vector<SystemRow>& rows);

  /// Assembles and factorises S.
  /// @param test rows that are closed (left), @param force rows along which multipliers act (right)
  /// @param soft_compliance one entry per trailing soft row, 1/k [m/N, rad/(N m)]
  /// @return false if S is singular to working precision
  bool factorise(const std::vector<SystemRow>& test, const std::vector<SystemRow>& force,
                 const std::vector<BodyCompliance>& compliance,
                 const std::vector<double>& soft_compliance);

  /// x ← S⁻¹ x.
  void solve_in_place(linalg::Vector& x) const { lu_->solve_in_place(x); }

  /// Sums the row forces x along `force` on each body.
  void gather(const std::vector<SystemRow>& force, const linalg::Vector& x,
              std::vector<BodyResponse>& responses) const;

  int size() const { return size_; }
  double pivot_ratio() const { return lu_ ? lu_->pivot_ratio() : 1.0; }

 private:
  struct RowOnBody {
    int row;
    bool is_first;
  };
  void add_body(std::size_t b, const std::vector<SystemRow>& test,
                const std::vector<SystemRow>& force, const BodyCompliance& compliance);

  int size_ = 0;
  std::vector<std::vector<RowOnBody>> rows_on_body_;
  std::vector<std::vector<int>> positions_;  // into the values of S_, k×k per body
  std::vector<int> diagonal_;
  linalg::SparseMatrix S_;
  std::optional<linalg::SparseLu> lu_;
  Eigen::VectorXd image_;  // scratch of add_body()
};

}  // namespace buckens::dynamics
