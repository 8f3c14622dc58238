// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/results/channel.h"

namespace buckens::results {

/// What is recorded for fields over meshes.
///
///     fields/bodies/<body>/nodes/<quantity>      {P} or {P, c}   at the places of GeometryBody
///     fields/bodies/<body>/elements/<quantity>   {S} or {S, c}
///     extremes/bodies/<body>/nodes|elements/von_mises        largest over the run so far [Pa]
///     extremes/bodies/<body>/nodes|elements/von_mises_time   when [s]
struct FieldLayout {
  RecordLayout fields;    ///< of field records, which have their own interval
  RecordLayout extremes;  ///< values that exist once and change during the run

  bool is_empty() const { return fields.channels().empty(); }
};

}  // namespace buckens::results
