// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/run_store/run_reader.h"

namespace buckens::run_store {

/// Difference of two runs in one quantity.
struct QuantityDifference {
  std::string
      quantity;  ///< path of the channel, with "translation" or "rotation" if it contains both
  std::string unit;
  double largest = 0;     ///< magnitude in the first run
  double difference = 0;  ///< largest of a component
  double at = 0;          ///< time of that [s], or number of the vibration
  /// difference/largest; energies relative to the largest energy of the run. Infinite if only the
  /// second run has non-zero values.
  double relative = 0;
};

struct RunComparison {
  std::size_t common_times = 0;
  double first_time = 0, last_time = 0;  ///< of the common ones [s]
  bool is_of_modes = false;              ///< of `buckens modes`: frequencies, not motions
  std::vector<QuantityDifference> quantities;
  std::vector<std::string> only_in_first, only_in_second;  ///< channels
  std::vector<std::string> of_other_shape;                 ///< channels of other meshes or sections

  /// Largest relative difference of all quantities.
  double largest() const;
};

/// Compares what two runs recorded at common times, without interpolation.
/// @param numbers_at_once of a channel that are in memory at the same time
/// @throws InputError if they have no record time in
/// common, or one contains vibrations and the other a
/// motion
RunComparison compare_runs(const RunReader& first, const RunReader& second,
                           std::size_t numbers_at_once = std::size_t{1} << 22U);

}  // namespace buckens::run_store
