// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/factor_work.h"

#include <fmt/format.h>

#include "buckens/base/log.h"

namespace buckens::linalg {

namespace {

constexpr Eigen::Index kTold = 20000;
constexpr double kMuch = 1e9;  // bytes

}  // namespace

std::string gigabytes(double bytes) { return fmt::format("{:.3g} GB", 1e-9 * bytes); }

NumericalError too_little_memory(const char* task, Eigen::Index size, double bytes) {
  const std::string needed =
      bytes > 0.0 ? fmt::format(" ({} for its factor alone)", gigabytes(bytes)) : "";
  return NumericalError(
      fmt::format("there is not enough memory to {} a matrix of size {}{}; use a coarser mesh, or "
                  "divide or reduce the body",
                  task, size, needed));
}

FactorWork::FactorWork(Eigen::Index size) : is_told_(size >= kTold) {
  work_.name = fmt::format("factorising {} equations", size);
  report("ordering");
}

FactorWork::~FactorWork() {
  if (!is_told_) return;
  base::log(base::LogLevel::debug,
            fmt::format("{} ({}): {:.2f} s", work_.name, work_.stage, watch_.seconds()));
  report({});
}

void FactorWork::begin(double bytes) {
  if (bytes >= kMuch) {
    work_.is_long = true;
    work_.outlook = fmt::format("the factor alone takes {} of memory", gigabytes(bytes));
  }
  report(fmt::format("factor of {}", gigabytes(bytes)));
}

void FactorWork::report(const std::string& stage) {
  work_.stage = stage;
  if (is_told_) base::report_work(work_);
}

}  // namespace buckens::linalg
