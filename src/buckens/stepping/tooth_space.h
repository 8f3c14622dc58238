// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include <fmt/format.h>

#include "buckens/model/gear_flank.h"
#include "buckens/model/model.h"
#include "buckens/stepping/step_failure.h"

namespace buckens::stepping {

/// Refuses steps in which flanks of teeth with play pass half a pitch, because at the end they may
/// be in any space between teeth. Other loads pass. @param rate of the gap [m/s], @param h step [s]
/// @throws StepFailure naming the joint
inline void require_same_space(const model::Load& load, double rate, double h) {
  const auto* flank = dynamic_cast<const model::GearFlank*>(load.element.get());
  const double way = std::abs(rate) * h;
  if (flank == nullptr || way < 0.5 * flank->data().period) return;
  throw StepFailure(fmt::format(
      "joint \"{}\": its teeth pass {:.3g} m of each other within a step, more than half of their "
      "pitch of {:.3g} m, so that blows would be missed; use a smaller `step`",
      load.name, way, flank->data().period));
}

}  // namespace buckens::stepping
