// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

#include "buckens/base/field.h"
#include "buckens/loads/load_axes.h"

namespace buckens::loads {

// Fields common to several kinds of load.

/// Part of a body on which the load acts.
template <class Part>
base::Field part_field(Part& on, const char* doc, const char* example) {
  return base::field("on", on, doc).required().like(example);
}

/// Three laws of time, or an optional triple of them.
template <class Laws>
base::Field components_field(const char* name, Laws& laws, base::Dimension dimension,
                             const char* example) {
  return base::field(name, laws, "three components, each a number or a law of time")
      .in(dimension)
      .like(example);
}

/// @param owner of the axes that the load may follow: "body" or "marker"
inline base::Field axes_field(LoadAxes& axes, const std::string& owner) {
  return base::field(
      "axes", axes,
      base::lasting_text("world axes (`fixed`) or those of the " + owner + " (`following`)"));
}

/// Signal that multiplies a load of laws of time.
inline base::Field factor_field(std::string& factor) {
  return base::field("signal", factor, "name of a signal that multiplies the value")
      .like("u")
      .otherwise("none");
}

}  // namespace buckens::loads
