// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/contact_stop.h"

namespace buckens::loads {

bool ContactStop::has_gone(const Sight& sight) const {
  return sight.stand.regime != 0 && touch_.may_go() &&
         !touch_.look(sight.first, sight.second).touches;
}

Action ContactStop::respond(const Sight& sight) const {
  Action out = RigidStop::respond(sight);
  // The rows of the step are formed again without it.
  if (!out.row.is_closed) out.regime = 0;
  return out;
}

RigidRow ContactStop::row(const Sight& sight) const {
  if (!has_gone(sight)) return RigidStop::row(sight);
  RigidRow out;
  out.has_gone = true;
  return out;
}

}  // namespace buckens::loads
