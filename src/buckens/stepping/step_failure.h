// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/base/errors.h"

namespace buckens::stepping {

/// A step did not settle or left the numbers. A shorter one may do; anything else that is thrown
/// while stepping (a law without a value, say) would be met again.
class StepFailure : public NumericalError {
  using NumericalError::NumericalError;
};

}  // namespace buckens::stepping
