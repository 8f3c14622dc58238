// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/linalg/kept_pairs.h"

namespace buckens::linalg {

/// Pairs whose rows the other processes have (ranks.h), each a run of them.
class DividedPairs final : public KeptPairs {
 public:
  /// @throws NumericalError if memory is too small
  DividedPairs(Eigen::Index rows, int most, SharedRowOrder order);
  ~DividedPairs() override;
  DividedPairs(const DividedPairs&) = delete;
  DividedPairs& operator=(const DividedPairs&) = delete;

  double project(int pairs, Vector& r, Vector& along, TaskPool* pool) override;
  void combine(int pairs, const Vector& weights, const Eigen::VectorXf& scale, bool adds, Vector& x,
               TaskPool* pool) const override;
  void separate(int pair, Vector& load, Vector& answer, TaskPool* pool) override;
  void put(int pair, double scale, const Vector& load, const Vector& answer,
           TaskPool* pool) override;
  void take(int pair, Eigen::VectorXf& load, Eigen::VectorXf& answer) const override;
  void restore(int pair, const Eigen::VectorXf& load, const Eigen::VectorXf& answer) override;
  int number() const override { return number_; }

 private:
  Eigen::Index rows_;
  SharedRowOrder order_;
  int number_ = -1;
};

}  // namespace buckens::linalg
