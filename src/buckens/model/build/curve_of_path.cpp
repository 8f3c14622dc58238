// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/curve_of_path.h"

namespace buckens::model {

std::vector<joints::CurveStep> curve_steps(const base::PathSpec& spec) {
  using Kind = joints::CurveStep::Kind;
  std::vector<joints::CurveStep> out;
  for (const base::PathSegmentSpec& segment : spec.segments) {
    joints::CurveStep step;
    if (segment.line) {
      step.to = *segment.line;
    } else {
      step.to = segment.arc.value_or(step.to);
      step.kind = segment.through  ? Kind::arc_through
                  : segment.centre ? Kind::arc_about
                                   : Kind::smooth_arc;
      step.by = segment.through.value_or(segment.centre.value_or(step.by));
    }
    out.push_back(step);
  }
  return out;
}

std::shared_ptr<const joints::SpaceCurve> curve_of_path(const base::PathSpec& spec) {
  using joints::CurvePieces;
  using joints::SpaceCurve;
  if (spec.segments.empty()) return std::make_shared<SpaceCurve>(spec.path, spec.closed);
  const Eigen::Vector3d start = spec.start.value_or(Eigen::Vector3d::Zero());
  return std::make_shared<SpaceCurve>(CurvePieces(start, curve_steps(spec)), spec.closed);
}

}  // namespace buckens::model
