// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/initial/stop_check.h"

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/dynamics/travel.h"
#include "buckens/loads/rigid_law.h"

namespace buckens::analysis {

namespace {
// Beyond the end by this share of the model's length, or by this angle, is rounding.
constexpr double kOnTheStop = 1e-9;
}  // namespace

void refuse_beyond_stops(const model::Model& model, const model::State& state) {
  if (model.num_rigid_rows() == 0) return;
  const auto motions = dynamics::motions_of(model, state);
  for (const model::Load& load : model.loads) {
    if (load.rigid_row < 0) continue;
    const auto coordinate = static_cast<std::size_t>(load.coordinate);
    const double value =
        dynamics::coordinate_motion(model, coordinate, state.t, nullptr, motions).value;
    const auto* law = static_cast<const loads::RigidLaw*>(load.element.get());
    const bool is_angle = model.coordinates[coordinate].law.is_angle();
    const auto contact = law->contact(value);
    if (contact.regime == 0 || contact.gap >= -kOnTheStop * (is_angle ? 1.0 : model.length)) {
      continue;
    }
    if (load.is_among_joints) {
      throw ModelError(
          fmt::format("joint \"{}\": its teeth start {:.3g} m beyond the backlash, and their "
                      "flanks are rigid; place the bodies so that each tooth lies in a tooth "
                      "space, start from equilibrium (`start: static`), or use an `elastic-gear`",
                      load.name, -contact.gap));
    }
    throw ModelError(
        fmt::format("load \"{}\": {} at {:.6g} {}, {:.3g} beyond the end of its free travel; a "
                    "rigid stop blocks further travel but does not push back; start within the "
                    "stops or from equilibrium (`start: static`), or give this stop a `stiffness`",
                    load.name, load.joint >= 0 ? "its joint stands" : "its markers stand", value,
                    is_angle ? "rad" : "m", -contact.gap));
  }
}

}  // namespace buckens::analysis
