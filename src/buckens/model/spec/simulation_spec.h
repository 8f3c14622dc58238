// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "buckens/base/field.h"
#include "buckens/base/source_location.h"

namespace buckens::model {

enum class IntegrationMethod { generalized_alpha, newmark, hht, wilson };

constexpr std::array<const char*, 4> choice_names(IntegrationMethod) {
  return {"generalized-alpha", "newmark", "hht", "wilson"};
}

/// Duration and time steps of a simulation.
struct SimulationSpec {
  SourceLocation where;
  double duration = 0;  ///< [s]
  /// [s]; adjusted once so that duration/step is an integer. With step control the maximum step; 0
  /// or none: chosen by the program
  std::optional<double> step;
  IntegrationMethod method = IntegrationMethod::generalized_alpha;
  double rho_inf = 0.9;
  std::optional<double> alpha;      ///< HHT, −1/3 … 0; −0.1 unless given
  std::optional<double> theta;      ///< Wilson, at least 1.366; 1.4 unless given
  std::optional<double> tolerance;  ///< of step control; 1e-3 unless given
  double absolute_tolerance = 1e-9;
  bool projection = true;
  double newton_tolerance = 1e-10;
  double outer_tolerance = 1e-6;
  bool iterate_coupling = false;
  int kept_solves = 80;
  int max_iterations = 40;
  int max_outer_iterations = 30;
  bool error = false;
  double checkpoint = 30;  ///< wall time between checkpoints [s]; 0: none

  bool has_step_control() const { return tolerance.has_value() || step.value_or(0.0) == 0.0; }

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("duration", duration, "time to simulate")
              .in(base::kTime)
              .required()
              .positive()
              .like("0.1 s"));
    visit(base::field("step", step,
                      "time step; adjusted once so that a whole number fits the duration. `auto`: "
                      "the program chooses steps to meet `tolerance`. A time together with "
                      "`tolerance`: the longest step")
              .in(base::kTime)
              .positive()
              .or_word("auto")
              .like("0.1 ms")
              .otherwise("required without `tolerance`"));
    visit(base::field("method", method, "time integration"));
    visit(base::field("rho-inf", rho_inf,
                      "numerical damping of generalized-alpha: 1 none, 0 strongest")
              .within(base::Range::fraction));
    visit(base::field("alpha", alpha, "numerical damping of hht: 0 none, -1/3 strongest")
              .like("-0.1")
              .otherwise("-0.1"));
    visit(base::field("theta", theta, "collocation of wilson, at least 1.366")
              .like("1.4")
              .otherwise("1.4"));
    visit(base::field("tolerance", tolerance,
                      "enables step control: admissible total error of all steps of the run, "
                      "relative to the mechanism's size for the position of a body, in rad for its "
                      "rotation, relative to the largest so far for its deformation (of undamped "
                      "vibrations, a tenth of it per radian)")
              .positive()
              .like("1e-4")
              .otherwise("1e-3 with `step: auto`, else no step control"));
    accuracy_and_effort(visit);
  }

 private:
  template <class Visitor>
  void accuracy_and_effort(Visitor& visit) {
    visit(base::field(
              "absolute-tolerance", absolute_tolerance,
              "error of deformation that is always admissible, relative to the mechanism's size")
              .positive());
    visit(base::field("projection", projection,
                      "newmark, wilson: project positions onto the joints each step")
              .on_off());
    iteration_fields(visit);
    visit(base::field("error", error, "on: same as `buckens run --error`").on_off());
    visit(base::field("checkpoint", checkpoint,
                      "wall time between checkpoints, from which `buckens run --continue` goes on "
                      "after a crash; one is also written at the end. off: none")
              .in(base::kTime)
              .positive()
              .or_word("off")
              .like("30 s")
              .otherwise("30 s"));
  }

 private:
  template <class Visitor>
  void iteration_fields(Visitor& visit) {
    visit(base::field("newton-tolerance", newton_tolerance,
                      "relative change at which the iteration of frames and joints stops")
              .positive());
    visit(base::field(
              "outer-tolerance", outer_tolerance,
              "relative change of the coupling load below which no further large solve is done")
              .positive());
    visit(base::field("iterate-coupling", iterate_coupling,
                      "on: large solves until outer-tolerance is met; off: the second one in a "
                      "step is the last if the coupling load it used was accurate to 1e-4")
              .on_off());
    visit(base::field("kept-solves", kept_solves,
                      "most answers to changes of the coupling load that are kept per factor, to "
                      "be combined in place of second large solves; 0: none, at most 1000")
              .non_negative());
    visit(base::field("max-iterations", max_iterations,
                      "maximum number of Newton iterations in a step, counted anew when rigid rows "
                      "close, open, stick or slide")
              .positive());
    visit(base::field("max-outer-iterations", max_outer_iterations,
                      "maximum number of large solves in a step")
              .positive());
  }
};

}  // namespace buckens::model
