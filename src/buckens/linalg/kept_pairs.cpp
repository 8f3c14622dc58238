// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/kept_pairs.h"

#include <array>
#include <cmath>

#include "buckens/linalg/divided_pairs.h"
#include "buckens/linalg/float_columns.h"
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

  double project(int pairs, Vector& r, Vector& along, TaskPool* pool) override {
    for (PartSums& sums : sums_) {
      sums.along.setZero();
      sums.square = 0;
    }
    parts_.for_pieces(pool, [&](int part, Index first, Index size) {
      PartSums& sums = sums_[static_cast<std::size_t>(part)];
      columns(loads_, pairs, first, size).products(r.data() + first, sums.products.data());
      sums.along.head(pairs) += sums.products.head(pairs);
    });
    for (Index i = 0; i < pairs; ++i) {
      double sum = 0;
      for (const PartSums& sums : sums_) sum += sums.along[i];
      along[i] = sum;
    }
    parts_.for_pieces(pool, [&](int part, Index first, Index size) {
      columns(loads_, pairs, first, size).add_to(-1.0, along.data(), r.data() + first);
      round(first, size, r);
      sums_[static_cast<std::size_t>(part)].square += r.segment(first, size).squaredNorm();
    });
    return std::sqrt(sum_of_squares());
  }

  void combine(int pairs, const Vector& weights, const VectorXf& scale, bool adds, Vector& x,
               TaskPool* pool) const override {
    parts_.for_pieces(pool, [&](int /*part*/, Index first, Index size) {
      // A piece of the sum, where the cache holds it.
      std::array<double, RowParts::kPiece> room;
      Eigen::Map<Vector> sum(room.data(), size);
      sum.setZero();
      columns(answers_, pairs, first, size).add_to(1.0, weights.data(), room.data());
      auto to = x.segment(first, size);
      const auto scaled = sum.cwiseProduct(scale.segment(first, size).cast<double>());
      if (adds) {
        to += scaled;
      } else {
        to = scaled;
      }
    });
  }

  void separate(int pair, Vector& load, Vector& answer, TaskPool* pool) override {
    for (PartSums& sums : sums_) sums.square = 0;
    parts_.for_pieces(pool, [&](int part, Index first, Index size) {
      double product = 0;
      column(loads_, pair, first, size).products(load.data() + first, &product);
      sums_[static_cast<std::size_t>(part)].square += product;
    });
    const double along = sum_of_squares();
    parts_.for_pieces(pool, [&](int /*part*/, Index first, Index size) {
      column(loads_, pair, first, size).add_to(-1.0, &along, load.data() + first);
      column(answers_, pair, first, size).add_to(-1.0, &along, answer.data() + first);
      round(first, size, load);
    });
  }

  void put(int pair, double scale, const Vector& load, const Vector& answer,
           TaskPool* pool) override {
    parts_.for_pieces(pool, [&](int /*part*/, Index first, Index size) {
      const Index at = place(pair, first, size);
      loads_.segment(at, size) = (scale * load.segment(first, size)).cast<float>();
      answers_.segment(at, size) = (scale * answer.segment(first, size)).cast<float>();
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

  void restore(int pair, const VectorXf& load, const VectorXf& answer) override {
    parts_.for_pieces(nullptr, [&](int /*part*/, Index first, Index size) {
      const Index at = place(pair, first, size);
      loads_.segment(at, size) = load.segment(first, size);
      answers_.segment(at, size) = answer.segment(first, size);
    });
  }

 private:
  /// Of one part of the rows.
  struct PartSums {
    Vector products;  // of one piece
    Vector along;
    double square = 0;
  };

  static void round(Index first, Index size, Vector& load) {
    auto piece = load.segment(first, size);
    piece = piece.cast<float>().cast<double>();
  }
  double sum_of_squares() const {
    double sum = 0;
    for (const PartSums& sums : sums_) sum += sums.square;
    return sum;
  }
  /// Rows `first` … `first + size` of the first pairs, or of one.
  FloatColumns columns(const VectorXf& all, int pairs, Index first, Index size) const {
    return {all.data() + first * most_, size, size, pairs};
  }
  FloatColumns column(const VectorXf& all, int pair, Index first, Index size) const {
    return {all.data() + place(pair, first, size), size, size, 1};
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
