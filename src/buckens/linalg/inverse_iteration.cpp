// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/inverse_iteration.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "buckens/linalg/symmetric_eigen.h"
#include "buckens/linalg/tall_products.h"

namespace buckens::linalg {

namespace {

// Columns shorter than this against the longest of their origin are rounding.
constexpr double kNothing = 1e-13;
// The same for a fresh block of unit length: what is left of it where the basis holds all there is.
constexpr double kNothingNew = 1e-9;
// Orthogonalised twice, columns are orthogonal unless the second time shortened them, too.
constexpr int kMostPasses = 4;
constexpr double kUnit = 0.01;

/// √ of the largest wᵀM w. @param MW M W
double longest_column(const Matrix& W, const Matrix& MW) {
  if (W.cols() == 0) return 0.0;
  return std::sqrt(std::max(0.0, W.cwiseProduct(MW).colwise().sum().maxCoeff()));
}
// A fresh block tells nothing about missing pairs before this many sweeps.
constexpr int kSearchSweeps = 3;
constexpr int kSmoothing = 2;
// Where A⁻¹M has many pairs of almost one size, θ grows for long: two sweeps may tell little of it.
constexpr int kFirstJudged = 2, kLastJudged = 32;

/// The growing basis V with M-orthonormal columns and T = VᵀM A⁻¹M V.
class Subspace {
 public:
  Subspace(MassProduct mass_times, const InverseOperator& inverse, const Matrix& deflated,
           const InverseIterationSettings& settings)
      : mass_times_(std::move(mass_times)),
        inverse_(inverse),
        settings_(settings),
        deflated_(deflated),
        MD_(mass_times_(deflated)),
        V_(deflated.rows(), std::min<Eigen::Index>(deflated.rows(), basis_limit())) {}

  InversePairs run();

 private:
  void start(unsigned seed, int smoothing);
  void sweep();
  void solve_projected();
  void restart(Eigen::Index keep);
  void orthonormalise(Matrix W, Matrix MW, double nothing, const Matrix* shares,
                      Matrix* coefficients);
  void remove_known(Matrix& W, const Matrix& MW, const Matrix* shares_of_basis) const;
  auto basis() const { return V_.leftCols(size_); }
  Eigen::Index wanted() const { return std::min<Eigen::Index>(settings_.count, theta_.size()); }
  bool is_judged() const;
  Eigen::Index converged() const;
  bool is_nothing_missed() const;
  bool is_changed(const Vector& before) const;
  bool search(bool is_exhausted);
  InversePairs result(bool is_complete) const;

  Eigen::Index basis_limit() const {
    return std::max<Eigen::Index>(2 * settings_.count + 2 * settings_.block,
                                  settings_.count + 10 * settings_.block);
  }

  const MassProduct mass_times_;
  const InverseOperator& inverse_;
  const InverseIterationSettings settings_;
  const Matrix& deflated_;
  Matrix MD_;
  Matrix V_;                   // basis, n×(room for all)
  Eigen::Index size_ = 0;      // m: columns of the basis
  Matrix T_;                   // m×m
  Matrix block_, mass_block_;  // next block, M-orthonormal to V, and its product with M
  Matrix coupling_;     // A⁻¹M V's share along the next block, b×(width of the last block)
  Vector theta_;        // Ritz values, largest magnitude first
  Matrix Z_;            // their coordinates in V
  Vector residual_;     // ‖A⁻¹M x − θ x‖_M
  double longest_ = 0;  // ‖A⁻¹M v‖_M of all columns so far
  double rounding_ = 0;
  int sweeps_ = 0;
  int searches_ = 0;
  int search_from_ = -1;  // sweep after which the fresh block is on its way
  Vector found_;          // wanted θ at that sweep
  long solves_ = 0;
};

/// @param shares_of_basis VᵀM W if it is known
void Subspace::remove_known(Matrix& W, const Matrix& MW, const Matrix* shares_of_basis) const {
  TaskPool* pool = settings_.pool;
  if (size_ > 0) {
    const Matrix shares =
        shares_of_basis != nullptr ? *shares_of_basis : inner_products(basis(), MW, pool);
    subtract_combinations(basis(), shares, W, pool);
  }
  // The basis has no share in what is deflated, so one does not disturb the other.
  if (deflated_.cols() > 0) {
    subtract_combinations(deflated_, inner_products(MD_, W, pool), W, pool);
  }
}

/// Makes block_ the M-orthonormal basis of the span of W without what V holds, directions shorter
/// than `nothing` left out; W = block_ · coefficients.
/// @param MW M W
/// @param shares VᵀM W if it is known
void Subspace::orthonormalise(Matrix W, Matrix MW, double nothing, const Matrix* shares,
                              Matrix* coefficients) {
  if (coefficients != nullptr) *coefficients = Matrix::Identity(W.cols(), W.cols());
  for (int pass = 0; pass < kMostPasses && W.cols() > 0; ++pass) {
    remove_known(W, MW, pass == 0 ? shares : nullptr);
    MW = mass_times_(W);
    const Matrix G = inner_products(W, MW, settings_.pool);
    const SymmetricEigen eigen = symmetric_eigen(0.5 * (G + G.transpose()));
    const double least = pass == 0 ? nothing : 0.1;
    Eigen::Index dropped = 0;
    while (dropped < W.cols() && !(eigen.values[dropped] > std::max(least * least, 1e-290))) {
      ++dropped;
    }
    const Eigen::Index kept = W.cols() - dropped;
    const Matrix U = eigen.vectors.rightCols(kept);
    const Vector size = eigen.values.tail(kept).cwiseSqrt();
    const Matrix to_unit = U * size.cwiseInverse().asDiagonal();
    W = combinations(W, to_unit, settings_.pool);
    MW = combinations(MW, to_unit, settings_.pool);
    if (coefficients != nullptr) {
      *coefficients = (size.asDiagonal() * U.transpose() * *coefficients).eval();
    }
    const bool was_unit = dropped == 0 && (size.array() - 1.0).abs().maxCoeff() < kUnit;
    if (pass > 0 && was_unit) break;
  }
  block_ = std::move(W);
  mass_block_ = std::move(MW);
}

/// @param smoothing products with A⁻¹M: the first brings the block into the range of A⁻¹M, a second
/// one next to the largest pairs, where the share of the smallest may be rounding
void Subspace::start(unsigned seed, int smoothing) {
  const auto columns = std::min<Eigen::Index>(settings_.block, V_.rows());
  Matrix X = scattered_block(V_.rows(), columns, seed);
  for (int k = 0; k < smoothing; ++k) {
    X = mass_times_(X);
    inverse_(X);
    solves_ += X.cols();
    const Matrix MX = mass_times_(X);
    for (Eigen::Index j = 0; j < X.cols(); ++j) {
      const double size = std::sqrt(std::max(0.0, X.col(j).dot(MX.col(j))));
      if (size > 0.0) X.col(j) /= size;
    }
  }
  Matrix MX = mass_times_(X);
  orthonormalise(std::move(X), std::move(MX), kNothingNew, nullptr, nullptr);
}

void Subspace::sweep() {
  const Eigen::Index before = size_;
  const Eigen::Index width = block_.cols();
  size_ += width;
  if (size_ > V_.cols()) {  // the search for missed pairs may go beyond the limit
    V_.conservativeResize(V_.rows(), size_);
  }
  V_.middleCols(before, width) = block_;
  Matrix W = std::move(mass_block_);
  inverse_(W);
  solves_ += width;
  ++sweeps_;
  Matrix MW = mass_times_(W);
  longest_ = std::max(longest_, longest_column(W, MW));
  const Matrix H = inner_products(basis(), MW, settings_.pool);
  const Matrix square = H.bottomRows(width);
  if (longest_ > 0.0) {
    rounding_ = std::max(rounding_, (square - square.transpose()).norm() / longest_);
  }
  T_.conservativeResize(size_, size_);
  T_.rightCols(width) = H;
  T_.bottomRows(width) = H.transpose();
  orthonormalise(std::move(W), std::move(MW), kNothing * longest_, &H, &coupling_);
}

void Subspace::solve_projected() {
  const SymmetricEigen eigen = symmetric_eigen(0.5 * (T_ + T_.transpose()));
  std::vector<Eigen::Index> order(static_cast<std::size_t>(T_.rows()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
    return std::abs(eigen.values[a]) > std::abs(eigen.values[b]);
  });
  theta_.resize(T_.rows());
  Z_.resize(T_.rows(), T_.rows());
  for (Eigen::Index k = 0; k < T_.rows(); ++k) {
    theta_[k] = eigen.values[order[static_cast<std::size_t>(k)]];
    Z_.col(k) = eigen.vectors.col(order[static_cast<std::size_t>(k)]);
  }
  residual_ = Vector::Zero(theta_.size());
  if (block_.cols() > 0) {
    residual_ = (coupling_ * Z_.bottomRows(coupling_.cols())).colwise().norm().transpose();
  }
}

void Subspace::restart(Eigen::Index keep) {
  const Matrix Z = Z_.leftCols(keep);
  V_.leftCols(keep) = combinations(basis(), Z, settings_.pool);
  size_ = keep;
  T_ = theta_.head(keep).asDiagonal();
}

/// After the sweeps 2, 4, 8 …, unless the wanted pairs are found.
bool Subspace::is_judged() const {
  const bool is_power_of_two = (sweeps_ & (sweeps_ - 1)) == 0;
  return settings_.is_worthwhile && search_from_ < 0 && is_power_of_two &&
         sweeps_ >= kFirstJudged && sweeps_ <= kLastJudged;
}

/// Pairs up to the first that has not converged.
Eigen::Index Subspace::converged() const {
  const double floor = 10.0 * rounding_ * std::abs(theta_[0]);
  Eigen::Index count = 0;
  while (count < theta_.size() &&
         residual_[count] <= std::max(settings_.tolerance * std::abs(theta_[count]), floor)) {
    ++count;
  }
  return count;
}

bool Subspace::is_nothing_missed() const {
  // The fresh block's best candidate is among the converged pairs or comes right after them: then
  // it must be smaller than the wanted ones for certain.
  const Eigen::Index next = converged();
  if (next >= theta_.size()) return true;
  return std::abs(theta_[next]) + residual_[next] < std::abs(theta_[wanted() - 1]);
}

InversePairs Subspace::result(bool is_complete) const {
  InversePairs out;
  Eigen::Index count = wanted();
  while (count > 0 && std::abs(theta_[count - 1]) <= kNothing * std::abs(theta_[0])) --count;
  out.theta = theta_.head(count);
  out.shapes =
      count > 0 ? combinations(basis(), Z_.leftCols(count), settings_.pool) : Matrix(V_.rows(), 0);
  out.residual = residual_.head(count).cwiseQuotient(out.theta.cwiseAbs());
  out.sweeps = sweeps_;
  out.solves = solves_;
  out.rounding = rounding_;
  out.is_complete = is_complete;
  return out;
}

/// Whether the fresh block has changed what is wanted: more of its kind may be missing then.
bool Subspace::is_changed(const Vector& before) const {
  if (before.size() != wanted()) return true;
  const double floor = 10.0 * rounding_ * std::abs(theta_[0]);
  for (Eigen::Index k = 0; k < before.size(); ++k) {
    const double tolerance = std::max(settings_.tolerance * std::abs(before[k]), floor);
    if (std::abs(theta_[k] - before[k]) > tolerance) return true;
  }
  return false;
}

/// Keeps the basis and continues with a fresh block. @return false if there is nothing else
bool Subspace::search(bool is_exhausted) {
  ++searches_;
  // Other pairs have residuals along the block that is left.
  restart(is_exhausted ? theta_.size() : converged());
  found_ = theta_.head(wanted());
  search_from_ = sweeps_;
  // Of a basis that is closed under A⁻¹M the smallest pairs may be missing, not the largest.
  start(1U + static_cast<unsigned>(searches_), is_exhausted ? 1 : kSmoothing);
  if (block_.cols() > 0) return true;
  coupling_.resize(0, 0);
  solve_projected();
  return false;
}

InversePairs Subspace::run() {
  start(1, kSmoothing);
  if (block_.cols() == 0) return result(true);
  while (true) {
    sweep();
    solve_projected();
    if (is_judged() && !settings_.is_worthwhile(theta_[0])) return result(false);
    const bool is_exhausted = block_.cols() == 0;
    if (is_exhausted || converged() >= settings_.count) {
      if (search_from_ < 0) {
        if (!search(is_exhausted)) return result(true);
        continue;
      }
      if (is_exhausted || (sweeps_ >= search_from_ + kSearchSweeps && is_nothing_missed())) {
        if (!is_changed(found_) || !search(is_exhausted)) return result(true);
        continue;
      }
    }
    if (sweeps_ >= settings_.max_sweeps) return result(false);
    if (size_ + block_.cols() > basis_limit()) {
      restart(std::min(theta_.size(), std::max<Eigen::Index>(settings_.count + settings_.block,
                                                             basis_limit() / 2 - settings_.block)));
    }
  }
}

}  // namespace

Matrix scattered_block(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  std::mt19937_64 engine(seed);
  Matrix out(rows, columns);
  for (Eigen::Index j = 0; j < columns; ++j) {
    for (Eigen::Index i = 0; i < rows; ++i) {
      out(i, j) = 2.0 * (static_cast<double>(engine() >> 11U) * 0x1p-53) - 1.0;
    }
  }
  return out;
}

namespace {

template <class Symmetric>
InversePairs pairs_with(const Symmetric& M, const InverseOperator& inverse, const Matrix& deflated,
                        const InverseIterationSettings& settings) {
  const MassProduct mass_times = [&](const Matrix& X) {
    return symmetric_product(M, X, settings.pool);
  };
  return largest_inverse_pairs(mass_times, inverse, deflated, settings);
}

}  // namespace

InversePairs largest_inverse_pairs(const SparseMatrix& M, const InverseOperator& inverse,
                                   const Matrix& deflated,
                                   const InverseIterationSettings& settings) {
  return pairs_with(M, inverse, deflated, settings);
}

InversePairs largest_inverse_pairs(const SymmetricMatrix& M, const InverseOperator& inverse,
                                   const Matrix& deflated,
                                   const InverseIterationSettings& settings) {
  return pairs_with(M, inverse, deflated, settings);
}

InversePairs largest_inverse_pairs(const MassProduct& mass_times, const InverseOperator& inverse,
                                   const Matrix& deflated,
                                   const InverseIterationSettings& settings) {
  const Eigen::Index size = deflated.rows();
  if (settings.count <= 0 || size == 0) return {Vector(0), Matrix(size, 0), Vector(0)};
  return Subspace(mass_times, inverse, deflated, settings).run();
}

}  // namespace buckens::linalg
