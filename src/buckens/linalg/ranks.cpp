// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/ranks.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/free_memory.h"
#include "buckens/base/timed_phase.h"
#include "buckens/linalg/cholmod_factor.h"
#include "buckens/linalg/column_maker.h"
#include "buckens/linalg/divided_graph.h"
#include "buckens/linalg/divided_matrix.h"
#include "buckens/linalg/divided_vectors.h"
#include "buckens/linalg/factor_work.h"
#include "buckens/linalg/grid_library.h"
#include "buckens/linalg/nodal_vector.h"
#include "buckens/linalg/row_order.h"
#include "buckens/linalg/row_service.h"
#include "buckens/linalg/shared_modes.h"
#include "buckens/linalg/single_thread.h"
#include "buckens/linalg/sparse_cholesky.h"

namespace buckens::linalg {

namespace {

static_assert(kFewestShared >= NodalVector::kShared);

int count_of_ranks = 1;
Eigen::Index worth_sharing = kWorthSharing;

std::optional<int> number_in_environment(const char* name) {
  const char* text = std::getenv(name);
  if (text == nullptr || *text == '\0') return std::nullopt;
  return std::atoi(text);
}

/// The variable at each place of the order of the factor of one process.
std::vector<int> places_in_factor(const ColumnGraph& graph) {
  std::vector<int> out;
  out.reserve(graph.columns.size());
  for (const int vertex : elimination_order(graph)) {
    const auto v = static_cast<std::size_t>(vertex);
    out.insert(out.end(), graph.columns.begin() + graph.first_column[v],
               graph.columns.begin() + graph.first_column[v + 1]);
  }
  return out;
}

[[noreturn]] void refuse_factor(Eigen::Index size, const std::string& reason, bool is_indefinite) {
  const std::string text = fmt::format(
      "the factor of {} equations on {} processes failed: {}; check the mesh, or use "
      "more memory",
      size, count_of_ranks, reason);
  if (is_indefinite) throw IndefiniteMatrix(text);
  throw NumericalError(text);
}

class SharedFactor final : public Factor {
 public:
  explicit SharedFactor(const MatrixSum& A) : size_(A.size()), plugin_(grid_solver()) {
    const base::TimedPhase phase("factor");
    A.require_finite();
    FactorWork work(size_);
    ColumnSource columns(A, Triangles::lower);
    std::vector<int> terms;
    std::vector<double> weights;
    BuckensGridMatrix matrix{};
    matrix.size = static_cast<int>(size_);
    std::vector<int> order;
    if (A.is_divisible()) {
      const std::vector<const DividedMatrix*> divided = A.divide();
      row_order_ = divided.front()->row_order();
      for (std::size_t k = 0; k < divided.size(); ++k) {
        terms.push_back(divided[k]->number());
        weights.push_back(A.terms()[k].weight);
      }
      order = places_in_factor(column_graph(divided));
      base::return_free_memory();
      matrix.terms = terms.data();
      matrix.weights = weights.data();
      matrix.num_terms = static_cast<int>(terms.size());
    } else {
      A.form_terms();
      order = places_in_factor(column_graph(A));
      matrix.give = ColumnSource::give;
      matrix.source = &columns;
    }
    matrix.block = 1;
    matrix.order = order.data();
    int is_indefinite = 0;
    matrix.is_indefinite = &is_indefinite;
    std::array<char, 400> error{};
    {
      const std::scoped_lock lock(turn_of_grid_solver());
      const SingleThread single;
      handle_ = plugin_.make(&matrix, error.data(), static_cast<int>(error.size()));
    }
    if (handle_ == nullptr) refuse_factor(size_, error.data(), is_indefinite != 0);
    const std::scoped_lock lock(turn_of_grid_solver());
    bytes_ = plugin_.bytes(handle_);
  }
  ~SharedFactor() override {
    const std::scoped_lock lock(turn_of_grid_solver());
    plugin_.release(handle_);
  }
  SharedFactor(const SharedFactor&) = delete;
  SharedFactor& operator=(const SharedFactor&) = delete;

  Eigen::Index size() const override { return size_; }
  double num_factor_entries() const override { return bytes_ / sizeof(double); }
  double bytes() const override { return bytes_; }

  using Factor::solve;
  using Factor::solve_in_place;
  void solve(const double* B, double* X, Eigen::Index columns, TaskPool* /*pool*/) const override {
    for (Eigen::Index k = 0; k < columns; ++k) solve_one(B + k * size_, X + k * size_);
  }
  void solve_in_place(std::span<double* const> vectors, TaskPool* /*pool*/) const override {
    for (double* x : vectors) solve_one(x, x);
  }
  bool solves_divided() const override { return true; }
  SharedRowOrder row_order() const override { return row_order_; }
  DividedVector solve_divided(DividedVectors& vectors, const DividedVector& b) const override {
    return vectors.solve(handle_, b);
  }
  bool find_pairs(const DividedPencil& of, InversePairs& pairs) const override {
    pairs = shared_pairs(handle_, of);
    return true;
  }

 private:
  void solve_one(const double* b, double* x) const {
    const BuckensGridLimits limits{0, 0, 0, 1};
    BuckensGridOutcome outcome{};
    std::array<char, 400> error{};
    const std::scoped_lock lock(turn_of_grid_solver());
    const SingleThread single;
    int failure = 0;
    std::vector<double> of_rows;
    if (row_order_) of_rows = row_order_->by_rows(b);
    fill_by_rows(row_order_, x, [&](double* answer) {
      failure = plugin_.solve(handle_, row_order_ ? of_rows.data() : b, answer, &limits, &outcome,
                              error.data(), static_cast<int>(error.size()));
    });
    if (failure == 0 && outcome.has_converged != 0) return;
    throw NumericalError(
        fmt::format("a solve of {} equations on {} processes failed: {}; run it in "
                    "one process",
                    size_, count_of_ranks, error.data()));
  }

  Eigen::Index size_;
  const BuckensGridPlugin& plugin_;
  SharedRowOrder row_order_;
  void* handle_ = nullptr;
  double bytes_ = 0;
};

}  // namespace

StartedProcesses started_processes() {
  struct Names {
    const char *rank, *count, *on_machine;
  };
  for (const Names& names :
       {Names{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_LOCAL_RANK"},
        Names{"PMI_RANK", "PMI_SIZE", "MPI_LOCALRANKID"}}) {
    const std::optional<int> rank = number_in_environment(names.rank);
    const std::optional<int> count = number_in_environment(names.count);
    if (!rank || !count || *count < 1) continue;
    return {*rank, *count, number_in_environment(names.on_machine).value_or(*rank)};
  }
  return {};
}

Ranks::Ranks() {
  const BuckensGridPlugin& plugin = grid_solver();
  int count = 1;
  plugin.join(&rank_, &count);
  count_of_ranks = count;
}

Ranks::~Ranks() {
  if (is_first()) grid_solver().leave();
  count_of_ranks = 1;
}

void Ranks::serve(MakeColumns make) {
  const SingleThread single;
  BuckensGridMaker maker = column_maker(make);
  serve_rows(maker);
  grid_solver().serve(&maker);
}

int Ranks::count() { return count_of_ranks; }

Traffic Ranks::traffic() {
  if (count_of_ranks == 1) return {};
  BuckensGridTraffic out{};
  grid_solver().traffic(&out);
  return {out.messages, out.bytes, DividedMatrix::bytes_gathered()};
}

bool is_shared_work(Eigen::Index variables) {
  return count_of_ranks > 1 && variables >= worth_sharing;
}

void share_from(Eigen::Index variables) { worth_sharing = variables; }

std::shared_ptr<const Factor> make_large_factor(const MatrixSum& A) {
  if (is_shared_work(A.size())) return std::make_shared<const SharedFactor>(A);
  return make_cholesky(A);
}

void ColumnSource::give(void* source, int first, int end, BuckensGridColumns* columns) {
  auto& own = *static_cast<ColumnSource*>(source);
  SparseMatrix().swap(own.piece_);  // an assignment would keep the memory
  if (columns == nullptr) return;
  *columns = {};
  try {
    own.piece_ = own.A_->columns(first, end - first, own.which_);
  } catch (const std::bad_alloc&) {
    return;  // the plug-in says so to all processes
  }
  own.entries_ += static_cast<double>(own.piece_.nonZeros());
  *columns = {own.piece_.outerIndexPtr(), own.piece_.innerIndexPtr(), own.piece_.valuePtr()};
}

}  // namespace buckens::linalg
