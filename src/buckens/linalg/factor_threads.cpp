// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/factor_threads.h"

#include <algorithm>
#include <utility>

namespace buckens::linalg {

namespace {
thread_local int threads_of_factors = 1;
}  // namespace

FactorThreads::FactorThreads(int threads)
    : before_(std::exchange(threads_of_factors, std::max(1, threads))) {}

FactorThreads::~FactorThreads() { threads_of_factors = before_; }

int FactorThreads::allowed() { return threads_of_factors; }

}  // namespace buckens::linalg
