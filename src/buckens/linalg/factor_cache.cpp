// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/factor_cache.h"

#include <utility>

namespace buckens::linalg {

namespace {
thread_local std::filesystem::path folder_of_factors;
}  // namespace

FactorCache::FactorCache(std::filesystem::path folder)
    : before_(std::exchange(folder_of_factors, std::move(folder))) {}

FactorCache::~FactorCache() { folder_of_factors = std::move(before_); }

const std::filesystem::path& FactorCache::folder() { return folder_of_factors; }

}  // namespace buckens::linalg
