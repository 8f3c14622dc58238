// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/loads/force_element.h"

namespace buckens::loads {

/// The signal that multiplies a load of laws of time, if there is one.
class SignalFactor {
 public:
  /// @param signal index among the signals of the model; −1: none
  explicit SignalFactor(int signal = -1) : signal_(signal) {}

  bool exists() const { return signal_ >= 0; }
  /// @return 1 without a signal
  double value(const Sight& sight) const {
    // The first of them is t.
    return exists() ? sight.signals[static_cast<std::size_t>(signal_) + 1] : 1.0;
  }

 private:
  int signal_;
};

}  // namespace buckens::loads
