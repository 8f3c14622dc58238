// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/base/errors.h"

namespace buckens::stepping {

/// A step did not converge or produced non-finite numbers. A shorter one may work; any other
/// exception while stepping (such as a law without a value) would occur again.
class StepFailure : public NumericalError {
  using NumericalError::NumericalError;
};

}  // namespace buckens::stepping
