// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

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
  } catch (const StepTooLong& error) {
    throw StepTooLong(joint.where, fmt::format("joint \"{}\": {}", joint.name, error.text()));
  } catch (const NumericalError& error) {
    throw NumericalError(
        joint.where, fmt::format("joint \"{}\" at t = {:.6g} s: {}", joint.name, t, error.text()));
  }
}

inline std::string naming(const model::Load& load, const std::string& text) {
  return fmt::format("{} \"{}\": {}", load.is_among_joints ? "joint" : "load", load.name, text);
}

/// The same for the law of a load, whose name is enough.
template <class Work>
decltype(auto) citing(const model::Load& load, Work&& work) {
  try {
    return work();
  } catch (const StepTooLong& error) {
    throw StepTooLong(error.where(), naming(load, error.text()));
  } catch (const NumericalError& error) {
    throw NumericalError(error.where(), naming(load, error.text()));
  }
}

}  // namespace buckens::dynamics
