// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <Eigen/Core>

#include "buckens/base/errors.h"
#include "buckens/base/stopwatch.h"
#include "buckens/base/work.h"

namespace buckens::linalg {

/// "3.4 GB".
std::string gigabytes(double bytes);

/// That there is not enough memory, and what to do. @param bytes needed, 0 if that is not known
NumericalError too_little_memory(const char* task, Eigen::Index size, double bytes);

/// Tells those who wait (base::report_work) how far the factor of a large matrix is, and what
/// memory it takes, before it is computed; that it is over when the object ends. Matrices of less
/// than 20 000 equations are not worth a word.
class FactorWork {
 public:
  explicit FactorWork(Eigen::Index size);
  ~FactorWork();
  FactorWork(const FactorWork&) = delete;
  FactorWork& operator=(const FactorWork&) = delete;

  /// The order of the equations is chosen. @param bytes of the factor
  void begin(double bytes);

 private:
  void report(const std::string& stage);

  bool is_told_;
  base::Work work_;
  base::Stopwatch watch_;
};

}  // namespace buckens::linalg
