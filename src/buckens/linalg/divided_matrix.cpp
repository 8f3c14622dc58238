// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/divided_matrix.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/linalg/grid_library.h"
#include "buckens/linalg/put_off_work.h"
#include "buckens/linalg/ranks.h"

namespace buckens::linalg {

namespace {

std::vector<int> numbers_of(std::span<const DividedMatrix* const> terms) {
  std::vector<int> out;
  for (const DividedMatrix* term : terms) out.push_back(term->number());
  return out;
}

/// What is asked of the plug-in, and what helps where that fails.
struct Wish {
  const char *verb, *remedy;
};
constexpr const char* kMoreMemory = "use more memory, or fewer processes on a machine";

/// Asks the plug-in for a matrix, and for its diagonal.
/// @param ask (plug-in, facts, error, its size) → number
template <class Ask>
int ask_for_matrix(Eigen::Index size, const Wish& wish, Vector& diagonal, BuckensGridFacts& facts,
                   Ask&& ask) {
  std::array<char, 400> error{};
  const BuckensGridPlugin& plugin = grid_solver();
  const std::scoped_lock lock(turn_of_grid_solver());
  const int number = ask(plugin, &facts, error.data(), static_cast<int>(error.size()));
  if (number < 0) {
    throw NumericalError(
        fmt::format("a matrix of {} equations on {} processes could not be {}: {}; {}", size,
                    Ranks::count(), wish.verb, error.data(), wish.remedy));
  }
  diagonal.resize(size);
  plugin.diagonal(number, diagonal.data());
  return number;
}

}  // namespace

DividedMatrix::DividedMatrix(const SparseMatrix& A) {
  const BuckensGridColumns columns{A.outerIndexPtr(), A.innerIndexPtr(), A.valuePtr()};
  number_ = ask_for_matrix(A.cols(), {"divided", kMoreMemory}, diagonal_, facts_,
                           [&](const auto& plugin, auto* facts, char* error, int size) {
                             return plugin.divide(static_cast<int>(A.cols()), &columns, facts,
                                                  error, size);
                           });
}

DividedMatrix::DividedMatrix(Eigen::Index size, const DescribeColumns& describe) {
  ColumnDescriptions own(describe);
  const BuckensGridDescription of = own.for_plugin();
  number_ = ask_for_matrix(size, {"made", "check the mesh, or use more memory"}, diagonal_, facts_,
                           [&](const auto& plugin, auto* facts, char* error, int error_size) {
                             return plugin.make_columns(static_cast<int>(size), &of, facts, error,
                                                        error_size);
                           });
}

DividedMatrix::DividedMatrix(std::span<const DividedMatrix* const> terms,
                             std::span<const double> weights) {
  const std::vector<int> numbers = numbers_of(terms);
  number_ = ask_for_matrix(terms.front()->size(), {"added up", kMoreMemory}, diagonal_, facts_,
                           [&](const auto& plugin, auto* facts, char* error, int size) {
                             return plugin.add_up(static_cast<int>(numbers.size()), numbers.data(),
                                                  weights.data(), facts, error, size);
                           });
}

DividedMatrix::~DividedMatrix() {
  const std::scoped_lock lock(turn_of_grid_solver());
  PutOffWork::finish_at_end();
  grid_solver().forget(number_);
}

void DividedMatrix::multiply(std::span<const Product> products) {
  while (!products.empty()) {
    const auto some = products.first(std::min<std::size_t>(kBuckensMostProducts, products.size()));
    std::array<int, kBuckensMostProducts> numbers{};
    std::array<const double*, kBuckensMostProducts> x{};
    std::array<double*, kBuckensMostProducts> y{};
    for (std::size_t k = 0; k < some.size(); ++k) {
      numbers[k] = some[k].A->number_;
      x[k] = some[k].x;
      y[k] = some[k].y;
    }
    {
      const std::scoped_lock lock(turn_of_grid_solver());
      grid_solver().multiply(static_cast<int>(some.size()), numbers.data(), x.data(), y.data());
    }
    products = products.subspan(some.size());
  }
}

double DividedMatrix::inner_product(std::span<const DividedMatrix* const> terms,
                                    std::span<const double> a, std::span<const double> b) {
  const std::vector<int> numbers = numbers_of(terms);
  const std::scoped_lock lock(turn_of_grid_solver());
  return grid_solver().inner_product(static_cast<int>(numbers.size()), numbers.data(), a.data(),
                                     b.data());
}

SparseMatrix DividedMatrix::gathered() const {
  SparseMatrix out(size(), size());
  out.resizeNonZeros(entries());
  const std::scoped_lock lock(turn_of_grid_solver());
  grid_solver().gather(number_, out.outerIndexPtr(), out.innerIndexPtr(), out.valuePtr());
  return out;
}

Vector DividedMatrix::near_diagonal(std::span<const int> lengths) const {
  Vector out(std::accumulate(lengths.begin(), lengths.end(), Eigen::Index{0}));
  const std::scoped_lock lock(turn_of_grid_solver());
  grid_solver().near_diagonal(number_, lengths.data(), out.data());
  return out;
}

double DividedMatrix::norm() const { return std::sqrt(facts_.square_norm); }

}  // namespace buckens::linalg
