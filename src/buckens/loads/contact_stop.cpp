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
  RigidRow out;
  out.has_gone = has_gone(sight);
  if (!out.has_gone) out = RigidStop::row(sight);
  out.may_go = true;
  return out;
}

}  // namespace buckens::loads
