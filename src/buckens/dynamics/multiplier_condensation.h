// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "buckens/dynamics/row_blocks.h"
#include "buckens/dynamics/system_kinematics.h"
#include "buckens/linalg/block_lu.h"
#include "buckens/linalg/small_lu.h"
#include "buckens/linalg/sparse_lu.h"

namespace buckens::dynamics {

/// Response of one body to unit generalised forces, condensed to what joints can act on.
struct BodyCompliance {
  /// Frame coordinates per frame load, 6×6: a rotation block and a translation block.
  Eigen::Matrix<double, 6, 6> frame = Eigen::Matrix<double, 6, 6>::Zero();
  /// Interface values per interface load, N K̂⁻¹Nᵀ (sieved); empty for rigid bodies. Not owned.
  const linalg::Matrix* interface = nullptr;
};

/// Growth of the force of a soft row with a multiplier, which may be the force of a soft row, too.
struct MultiplierSlope {
  int soft_row = 0, row = 0;  ///< of the condensed system
  double value = 0;
};

/// The condensed system of all joint equations, FM (42), (43):
///
///     S = Σ_bodies a ᵀ W⁻¹ a + Aᵀ (Y K̂⁻¹) A  (+ 1/k on the diagonal of soft rows)
///
/// Rows are constraints in use, followed by the soft rows of force elements. Bodies enter only by
/// small dense blocks, so the matrix is sparse across joints; its pattern is found once. The blocks
/// are eliminated without pivoting (linalg::BlockLu); if that gives poor pivots, rows are exchanged
/// (linalg::SparseLu). Most places of a rigid contact do not touch: their rows are empty, and cost
/// nothing. Of what is left then, rows are exchanged in a dense matrix (linalg::SmallLu) while it
/// is small.
///
/// Contacts of many bodies change from step to step and would fill the factor. Their rows, the last
/// ones, are left out of it: with them the system is solved by iteration, which their own give
/// (1/k) makes short, preconditioned by the factor and by what each contact gives alone.
///
/// Forces of soft rows that grow with multipliers, friction above all, make a second matrix
///
///     S′ = S − Σ b_s w_sj e_s e_jᵀ,   b_s the soft row's entry on the diagonal, w_sj its slope
///
/// whose unknown of the soft row is the whole of its force. Multipliers are found with S′,
/// corrections of positions with S: they are no forces that could rub. S′ may be formed again for
/// other soft rows while S stays.
class MultiplierCondensation {
 public:
  /// @param rows one entry per row, with body numbers and marker rows set; values are not read
  /// @param num_loose rows at the end that are not factorised
  MultiplierCondensation(int num_bodies, const std::vector<SystemRow>& rows, int num_loose = 0);

  /// Sets a row that is closed along the direction in which its multiplier acts.
  void set_row(int row, const SystemRow& values);
  /// Sets a row. @param test direction to close (left), @param force direction of the multiplier
  void set_row(int row, const SystemRow& test, const SystemRow& force);
  /// Sets a row that closes nothing, but along which a force acts.
  void set_acting_row(int row, const SystemRow& force);
  /// Sets a row to nothing.
  void clear_row(int row);

  /// Assembles and factorises S of the rows set.
  /// @param soft_compliance one entry per trailing soft row, 1/k [m/N, rad/(N m)]
  /// @return false if S is singular to working precision
  bool factorise(const std::vector<BodyCompliance>& compliance,
                 const std::vector<double>& soft_compliance);
  /// Sets all rows and factorises.
  bool factorise(const std::vector<SystemRow>& test, const std::vector<SystemRow>& force,
                 const std::vector<BodyCompliance>& compliance,
                 const std::vector<double>& soft_compliance);

  /// Assembles and factorises the matrix of multipliers, S′, of rows and slopes as set now. That of
  /// corrections stays as it is.
  /// @return false where only factorise() helps: poor pivots, or rows left out of the factor
  bool factorise_multipliers(const std::vector<BodyCompliance>& compliance,
                             const std::vector<double>& soft_compliance);

  /// Slopes for the next factorisations; their rows and soft rows must act on a common body.
  void set_slopes(const std::vector<MultiplierSlope>& slopes) { slopes_ = slopes; }

  /// Forms S′ again with other slopes, all else as it is; leaves them out where pivots are poor.
  void renew_slopes(const std::vector<MultiplierSlope>& slopes,
                    const std::vector<double>& soft_compliance);

  /// x ← S⁻¹ x.
  void solve_in_place(linalg::Vector& x) const { solve(x, Slopes::left_out); }
  /// x ← S′⁻¹ x; with S where pivots of S′ are poor, as near the jamming of a joint by friction.
  void solve_with_slopes(linalg::Vector& x) const { solve(x, Slopes::counted); }

  /// Sums the row forces x along the directions of the multipliers for each body.
  void gather(const linalg::Vector& x, std::vector<BodyResponse>& responses) const {
    force_.gather(x, responses);
  }
  /// The rows that are closed.
  const RowBlocks& test_rows() const { return test_ ? *test_ : force_; }

  /// Values of S, in its compressed order, for which rows were last exchanged; empty if they never
  /// were. Later factorisations keep these exchanges while they are good.
  std::vector<double> pivoted_values() const;
  /// Exchanges rows as for these values, so that later factorisations are bitwise the same.
  /// @param values of pivoted_values() of another object for the same rows
  void pivot_as(const std::vector<double>& values);

  int size() const { return force_.num_rows(); }
  /// Smallest pivot without row exchanges, relative to the original diagonal: the smallest fraction
  /// of a row's compliance left by the rows before it, the squared sine of an angle between them. 0
  /// … 1 for any units and masses; 0 if a pivot is not positive.
  double pivot_ratio() const { return block_lu_.pivot_ratio(); }

 private:
  // If a pivot keeps less of its diagonal entry, about eight digits are lost without exchanges.
  static constexpr double kPoorPivot = 1e-8;
  enum class Slopes { left_out, counted };
  struct BlockOnBody {
    int block;
    int side;
  };
  void assemble(const std::vector<BodyCompliance>& compliance,
                const std::vector<double>& soft_compliance, linalg::BlockLu& into);
  void add_body(std::size_t b, const BodyCompliance& compliance, linalg::BlockLu& into) const;
  void subtract_slopes(const std::vector<double>& soft_compliance, linalg::BlockLu& from) const;
  /// Calls take(row, column, value) for every entry of S.
  /// @param may_leave_out entries that blocks without rows have with others, all zero
  template <class Take>
  void for_entries(bool may_leave_out, Take&& take);
  /// Finds the blocks that have only empty rows and no slopes.
  void find_idle_blocks();
  bool is_empty(int row) const { return force_.is_empty(row) && (!test_ || test_->is_empty(row)); }
  void make_general();
  bool factorise_with_exchanges();
  /// Takes the rows that are not empty, if they are few and others are. @return whether it did
  bool take_small();
  void solve_with_exchanges(linalg::Vector& x) const;
  bool factorise_direct(const std::vector<BodyCompliance>& compliance,
                        const std::vector<double>& soft_compliance);
  void factorise_with_slopes(const std::vector<double>& soft_compliance);
  void keep_before_slopes(const linalg::BlockLu& S);
  void leave_slopes_out();
  void solve(linalg::Vector& x, Slopes slopes) const;
  void solve_direct(linalg::Vector& x, Slopes slopes) const;
  void set_loose_blocks();
  /// y ← S x, all rows.
  void multiply(const linalg::Vector& x, linalg::Vector& y, Slopes slopes) const;
  void precondition(const linalg::Vector& x, linalg::Vector& y, Slopes slopes) const;
  void iterate(linalg::Vector& x, Slopes slopes) const;

  int num_loose_ = 0;
  RowBlocks force_;
  std::size_t num_direct_blocks_ = 0;
  std::optional<RowBlocks> test_;  // if closed directions differ from those of the multipliers
  std::vector<std::vector<BlockOnBody>> blocks_on_body_;
  std::vector<std::vector<int>> places_;      // in blocks_lu_, one per pair of blocks on a body
  std::vector<std::pair<int, int>> couples_;  // blocks (i, j) of S, every one once
  linalg::BlockLu block_lu_;
  bool exchanges_rows_ = false;  // the last factorisation is that of general_
  linalg::SparseMatrix S_;       // for general_, empty until it is needed
  std::optional<linalg::SparseLu> general_;
  std::vector<char> is_idle_;        // per block that is factorised
  bool is_small_ = false;            // rows are exchanged in small_, not in general_
  std::vector<int> rows_of_small_;   // all but empty ones
  std::vector<int> place_in_small_;  // of each row, −1: empty
  linalg::Matrix small_matrix_;
  linalg::Vector diagonal_of_empty_;
  linalg::SmallLu small_;
  mutable linalg::Vector small_x_;
  std::vector<MultiplierSlope> slopes_;
  std::optional<linalg::BlockLu> sloped_;         // S′, empty until it is needed
  std::optional<linalg::BlockLu> before_slopes_;  // as entered, without slopes
  bool has_sloped_ = false;                       // multipliers are found with it

  // Of loose rows only: what the bodies give, and the inverse of what each block gives alone.
  std::vector<BodyCompliance> compliance_;
  std::vector<double> soft_compliance_;
  std::vector<Eigen::MatrixXd> loose_inverse_;
  mutable std::vector<BodyResponse> responses_;
  mutable std::vector<Eigen::Matrix<double, 6, 1>> moved_;
  mutable std::vector<Eigen::VectorXd> moved_interface_;
  mutable linalg::Vector direct_;
};

}  // namespace buckens::dynamics
