// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/kept_pairs.h"

#include <array>
#include <cmath>

#include "buckens/linalg/divided_pairs.h"
#include "buckens/linalg/ranks.h"

namespace buckens::linalg {

using Eigen::Index;
using Eigen::VectorXf;

namespace {

/// Pairs of this process.
class OwnPairs final : public KeptPairs {
 public:
  OwnPairs(Index rows, int most)
      : parts_(rows), most_(most), sums_(static_cast<std::size_t>(parts_.count())) {
    // Pages of memory come into being as they are written to.
    loads_.resize(rows * most);
    answers_.resize(rows * most);
    for (PartSums& sums : sums_) {
      sums.products.resize(most);
      sums.along.resize(most);
    }
  }

  double project(int pairs, VectorXf& r, VectorXf& along, TaskPool* pool) override {
    for (PartSums& sums : sums_) {
      sums.along.setZero();
      sums.square = 0;
    }
    parts_.for_pieces(pool, [&](int part, Index first, Index size) {
      PartSums& sums = sums_[static_cast<std::size_t>(part)];
      sums.products.head(pairs).noalias() =
          block(loads_, pairs, first, size).transpose() * r.segment(first, size);
      sums.along.head(pairs) += sums.products.head(pairs).cast<double>();
    });
    for (Index i = 0; i < pairs; ++i) {
      double sum = 0;
      for (const PartSums& sums : sums_) sum += sums.along[i];
      along[i] = static_cast<float>(sum);
    }
    parts_.for_pieces(pool, [&](int part, Index first, Index size) {
      auto piece = r.segment(first, size);
      piece.noalias() -= block(loads_, pairs, first, size) * along.head(pairs);
      // Squares of small loads underflow in single precision: they vanish, or cost a hundred times
      // as much.
      sums_[static_cast<std::size_t>(part)].square += piece.cast<double>().squaredNorm();
    });
    return std::sqrt(sum_of_squares());
  }

  void combine(int pairs, const VectorXf& weights, const VectorXf& scale, bool adds, Vector& x,
               TaskPool* pool) const override {
    parts_.for_pieces(pool, [&](int /*part*/, Index first, Index size) {
      // A piece of x in single precision, where the cache holds it.
      std::array<float, RowParts::kPiece> room;
      Eigen::Map<VectorXf> sum(room.data(), size);
      sum.noalias() = block(answers_, pairs, first, size) * weights.head(pairs);
      auto to = x.segment(first, size);
      const auto scaled = sum.cwiseProduct(scale.segment(first, size)).cast<double>();
      if (adds) {
        to += scaled;
      } else {
        to = scaled;
      }
    });
  }

  void separate(int pair, VectorXf& load, VectorXf& answer, TaskPool* pool) override {
    for (PartSums& sums : sums_) sums.square = 0;
    parts_.for_pieces(pool, [&](int part, Index first, Index size) {
      const float product =
          loads_.segment(place(pair, first, size), size).dot(load.segment(first, size));
      sums_[static_cast<std::size_t>(part)].square += static_cast<double>(product);
    });
    const auto along = static_cast<float>(sum_of_squares());
    parts_.for_pieces(pool, [&](int /*part*/, Index first, Index size) {
      const Index at = place(pair, first, size);
      load.segment(first, size) -= along * loads_.segment(at, size);
      answer.segment(first, size) -= along * answers_.segment(at, size);
    });
  }

  void put(int pair, float scale, const VectorXf& load, const VectorXf& answer,
           TaskPool* pool) override {
    parts_.for_pieces(pool, [&](int /*part*/, Index first, Index size) {
      const Index at = place(pair, first, size);
      loads_.segment(at, size) = scale * load.segment(first, size);
      answers_.segment(at, size) = scale * answer.segment(first, size);
    });
  }

  void take(int pair, VectorXf& load, VectorXf& answer) const override {
    load.resize(parts_.rows());
    answer.resize(parts_.rows());
    parts_.for_pieces(nullptr, [&](int /*part*/, Index first, Index size) {
      const Index at = place(pair, first, size);
      load.segment(first, size) = loads_.segment(at, size);
      answer.segment(first, size) = answers_.segment(at, size);
    });
  }

 private:
  using ConstBlock = Eigen::Map<const Eigen::MatrixXf>;
  /// Of one part of the rows.
  struct PartSums {
    VectorXf products;  // of one piece
    Vector along;
    double square = 0;
  };

  double sum_of_squares() const {
    double sum = 0;
    for (const PartSums& sums : sums_) sum += sums.square;
    return sum;
  }
  /// Rows `first` … `first + size` of the first pairs.
  ConstBlock block(const VectorXf& all, int pairs, Index first, Index size) const {
    return {all.data() + first * most_, size, pairs};
  }
  /// Where a piece of a pair lies in a vector of pairs.
  Index place(Index pair, Index first, Index size) const { return first * most_ + pair * size; }

  RowParts parts_;
  Index most_;
  VectorXf loads_, answers_;    // piece by piece of rows
  std::vector<PartSums> sums_;  // per part
};

}  // namespace

std::unique_ptr<KeptPairs> make_kept_pairs(Index rows, int most, SharedRowOrder order) {
  if (most > 0 && is_shared_work(rows)) {
    return std::make_unique<DividedPairs>(rows, most, std::move(order));
  }
  return std::make_unique<OwnPairs>(rows, most);
}

}  // namespace buckens::linalg
