// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/model/model.h"

namespace buckens::dynamics {

/// Does work for a joint and puts its name, place and the time before what ends the motion there.
/// @throws NumericalError
template <class Work>
decltype(auto) citing(const model::Joint& joint, double t, Work&& work) {
  try {
    return work();
  } catch (const NumericalError& error) {
    throw NumericalError(
        joint.where, fmt::format("joint \"{}\" at t = {:.6g} s: {}", joint.name, t, error.text()));
  }
}

/// The same for the law of a load, whose name is enough.
template <class Work>
decltype(auto) citing(const model::Load& load, Work&& work) {
  try {
    return work();
  } catch (const NumericalError& error) {
    const char* what = load.is_among_joints ? "joint" : "load";
    throw NumericalError(error.where(),
                         fmt::format("{} \"{}\": {}", what, load.name, error.text()));
  }
}

}  // namespace buckens::dynamics
