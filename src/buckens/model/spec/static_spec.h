// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>

#include "buckens/base/field.h"
#include "buckens/base/source_location.h"
#include "buckens/model/spec/rest_friction.h"

namespace buckens::model {

enum class StaticMethod { arc_length, load };

constexpr std::array<const char*, 2> choice_names(StaticMethod) { return {"arc-length", "load"}; }

/// Criterion that ends a static path before its last load factor.
struct StaticStopSpec {
  SourceLocation where;
  std::string sensor;
  std::string component;  ///< for a sensor with several; empty: the sensor is a single number
  double at = 0;          ///< SI

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("sensor", sensor, "name of the sensor to watch").required().like("w"));
    visit(base::field("component", component, "column of the sensor")
              .like("y")
              .otherwise("for sensors with one column"));
    visit(base::field("at", at, "value at which the path ends, crossed in either direction")
              .of_any_dimension()
              .required()
              .like("500 mm"));
  }
};

/// Equilibria over a load factor, as traced by `buckens static`.
struct StaticSpec {
  SourceLocation where;
  std::array<double, 2> load_factor = {0.0, 1.0};  ///< first and last
  StaticMethod method = StaticMethod::arc_length;
  int steps = 10;
  double arc_step = 0.05;
  int max_points = 1000;
  double time = 0;  ///< [s]
  RestFriction friction = RestFriction::free;
  std::optional<StaticStopSpec> stop;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("load-factor", load_factor,
                      "first and last factor of all applied forces and torques; gravity, springs "
                      "and drives are not scaled")
              .like("[0, 1]"));
    visit(base::field("method", method,
                      "`arc-length` follows the path through limit points, `load` increases the "
                      "factor step by step"));
    visit(base::field("steps", steps, "the load factor changes by at most 1/steps of its range")
              .positive());
    visit(base::field("arc-step", arc_step,
                      "arc-length: largest motion in a step: rotation in rad, displacement as a "
                      "fraction of the model's length")
              .positive());
    visit(base::field("max-points", max_points, "the path ends after this many points").positive());
    visit(base::field("time", time,
                      "instant at which the laws of time of loads and drives are evaluated")
              .in(base::kTime)
              .like("1 s"));
    visit(
        base::field("friction", friction,
                    "`free` neglects friction; `frozen` holds what rubs, joints, brakes and "
                    "contacts, where it is, and warns where that takes more than friction gives"));
    visit(base::field("stop", stop, "ends the path early").otherwise("at the last load factor"));
  }
};

}  // namespace buckens::model
