// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/model/spec/model_description.h"

namespace buckens::analysis {

/// Checks the laws of time that drive joints for what no mechanism can follow.
class DriveLaws {
 public:
  explicit DriveLaws(const model::ModelDescription& description);

  /// Refuses a law that jumps between two times: it would move the mechanism to another position
  /// instantaneously. A change within 1/4096 of the interval counts as a jump.
  /// @throws NumericalError with place, joint and law
  void check(double from, double to) const;

  /// Warnings for laws whose acceleration has no bound at t = 0, such as t^1.5.
  /// @throws NumericalError with place, joint and law if their rate has none, such as sqrt(t)
  std::vector<std::string> check_start(double duration) const;

  /// Warnings for laws whose rate jumps within ]0, duration[: joint forces have spikes there.
  std::vector<std::string> corners(double duration) const;

 private:
  void take(const joints::DriveLaws& laws, const joints::JointSpec& joint, const char* unit);

  struct Drive {
    std::string joint;
    SourceLocation where;
    base::TimeLaw law;
    const char* unit;
  };
  std::vector<Drive> drives_;
};

}  // namespace buckens::analysis
