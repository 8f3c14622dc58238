// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "buckens/base/field.h"
#include "buckens/base/source_location.h"

namespace buckens::base {

/// One segment of a path: a line or an arc to a point.
struct PathSegmentSpec {
  SourceLocation where;
  std::optional<Eigen::Vector3d> line, arc;        ///< their ends [m]; exactly one is given
  std::optional<Eigen::Vector3d> through, centre;  ///< of an arc [m]; at most one is given

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(field("line", line, "end of a straight line")
              .in(kLength)
              .like("[80 mm, 0, 0]")
              .otherwise("an `arc`"));
    visit(field("arc", arc, "end of an arc of a circle")
              .in(kLength)
              .like("[100 mm, 20 mm, 0]")
              .otherwise("a `line`"));
    visit(field("through", through, "of an arc: a point between its ends")
              .in(kLength)
              .like("[94 mm, 6 mm, 0]")
              .otherwise("`centre`, or the arc goes on smoothly from the piece before"));
    visit(field("centre", centre, "of an arc of less than half a circle")
              .in(kLength)
              .like("[80 mm, 20 mm, 0]")
              .otherwise("`through`, or the arc goes on smoothly from the piece before"));
  }
};

/// A curve in the axes of a marker: a spline through points, or lines and arcs.
struct PathSpec {
  std::vector<Eigen::Vector3d> path;      ///< [m]
  std::optional<Eigen::Vector3d> start;   ///< of the segments [m]
  std::vector<PathSegmentSpec> segments;  ///< exactly one of path and segments is given
  bool closed = false;

  template <class Visitor>
  void path_fields(Visitor& visit) {
    visit(field("path", path,
                "points in the first marker's axes, joined by a smooth curve (cubic spline)")
              .in(kLength)
              .like("[[0, 0, 0], [50 mm, 20 mm, 0], [100 mm, 0, 0]]")
              .otherwise("give this or `segments`"));
    visit(field("start", start, "where the first of `segments` begins")
              .in(kLength)
              .like("[0, 0, 0]")
              .otherwise("the origin of the first marker"));
    visit(field("segments", segments,
                "lines and arcs, one after the other, in the first marker's axes; they must "
                "meet smoothly")
              .like("[{line: [80 mm, 0, 0]}, {arc: [100 mm, 20 mm, 0]}]")
              .otherwise("give this or `path`"));
    visit(field("closed", closed,
                "whether the curve goes on from its last point to the first, smoothly")
              .on_off());
  }
};

}  // namespace buckens::base
