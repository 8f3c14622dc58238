// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "buckens/base/coordinate_choice.h"
#include "buckens/base/field.h"
#include "buckens/base/source_location.h"

namespace buckens::joints {

/// One term of a coupler, named after its joint. At most one of factor, polynomial and table is
/// given.
struct CouplerTermSpec {
  std::string name;  ///< of the joint
  SourceLocation where;
  std::optional<double> factor;
  std::vector<double> polynomial;
  std::vector<std::array<double, 2>> table;
  std::optional<base::CoordinateChoice> which;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("times", factor, "factor of the coordinate, in rad or m")
              .of_any_dimension()
              .shorthand()
              .like("-2")
              .otherwise("1"));
    visit(base::field("polynomial", polynomial,
                      "in place of the factor: coefficients of 1, x, x^2, ..., x in rad or m")
              .like("[0, 0.1, 0.02]")
              .otherwise("a factor"));
    visit(base::field("table", table,
                      "in place of the factor: points [x, value], x in rad or m, of a smooth curve")
              .like("[[0, 0], [1, 0.2], [2, 0.7]]")
              .otherwise("a factor"));
    visit(
        base::field("which", which, "of joints with several coordinates")
            .like("displacement")
            .otherwise(
                "the angle of joints that turn, the displacement of those that slide; needed where "
                "there are only others"));
  }
};

struct CouplerSpec {
  static constexpr const char* kKey = "coupler";
  static constexpr const char* kDoc =
      "keeps a sum over coordinates of other joints at zero: angles counted over turns and "
      "displacements, both from the position as placed";
  static constexpr const char* kInstead = "name one of the joints that it couples";
  std::vector<CouplerTermSpec> of;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("of", of, "terms of the sum by the name of their joint: a factor or a map")
              .required()
              .like("{drum: 0.2, slide: -1}"));
  }
};

}  // namespace buckens::joints
