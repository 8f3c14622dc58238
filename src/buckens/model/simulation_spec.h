// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "buckens/base/field.h"
#include "buckens/base/source_location.h"

namespace buckens::model {

enum class IntegrationMethod { generalized_alpha, newmark };

constexpr std::array<const char*, 2> choice_names(IntegrationMethod) {
  return {"generalized-alpha", "newmark"};
}

/// How far and how finely to simulate.
struct SimulationSpec {
  SourceLocation where;
  double duration = 0;  ///< [s]
  double step = 0;      ///< [s]; adjusted once so that duration/step is an integer
  IntegrationMethod method = IntegrationMethod::generalized_alpha;
  double rho_inf = 0.9;
  bool projection = true;
  double newton_tolerance = 1e-10;
  double outer_tolerance = 1e-6;
  int max_iterations = 40;
  int max_outer_iterations = 30;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("duration", duration, "time to simulate")
              .in(base::kTime)
              .required()
              .positive()
              .like("0.1 s"));
    visit(base::field("step", step,
                      "time step; adjusted once so that a whole number fits the duration")
              .in(base::kTime)
              .required()
              .positive()
              .like("0.1 ms"));
    visit(base::field("method", method, "time integration"));
    visit(base::field("rho-inf", rho_inf,
                      "numerical damping of generalized-alpha: 1 none, 0 strongest")
              .within(base::Range::fraction));
    visit(base::field("projection", projection,
                      "newmark: project positions onto the joints each step")
              .on_off());
    visit(base::field("newton-tolerance", newton_tolerance,
                      "relative change at which the iteration of "
                      "frames and joints ends")
              .positive());
    visit(base::field("outer-tolerance", outer_tolerance,
                      "relative change of the coupling load at which "
                      "no further large solve is made")
              .positive());
    visit(base::field("max-iterations", max_iterations, "most Newton iterations in a step")
              .positive());
    visit(base::field("max-outer-iterations", max_outer_iterations, "most large solves in a step")
              .positive());
  }
};

}  // namespace buckens::model
