// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

namespace buckens::joints {

/// A point of a curve, by its parameter.
struct CurvePoint {
  Eigen::Vector3d p, tangent, curvature;  ///< c, c′, c″
};

/// The next piece of a curve, from the end of the previous one.
struct CurveStep {
  enum class Kind {
    line,         ///< straight
    smooth_arc,   ///< an arc that leaves along the piece before
    arc_through,  ///< the arc through `by`
    arc_about     ///< the arc about `by`, the shorter way
  };
  Kind kind = Kind::line;
  Eigen::Vector3d to = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d by = Eigen::Vector3d::Zero();  ///< [m]
};

/// Straight lines and arcs that join smoothly, parametrised by arc length.
class CurvePieces {
 public:
  CurvePieces() = default;
  /// @throws ModelError if a piece has no length or defines no circle, or two meet at an angle
  CurvePieces(const Eigen::Vector3d& start, const std::vector<CurveStep>& steps);

  bool empty() const { return pieces_.empty(); }
  double length() const { return empty() ? 0.0 : pieces_.back().to; }
  /// @param s 0 … length()
  CurvePoint at(double s) const;
  /// @throws ModelError if the last piece does not join the first one smoothly
  void require_closed() const;

  struct Piece {
    double from = 0, to = 0;  ///< along the curve [m]
    double radius = 0;        ///< 0: a line
    /// Start and direction of a line; centre of an arc and its radius vector at the start.
    Eigen::Vector3d origin, first;
    Eigen::Vector3d second = Eigen::Vector3d::Zero();  ///< of an arc: tangent at its start
    CurvePoint at(double s) const;
  };
  const std::vector<Piece>& all() const { return pieces_; }

 private:
  void add(Piece piece, double length);
  void add_arc(const Eigen::Vector3d& from, const CurveStep& step);
  void add_line(const Eigen::Vector3d& from, const Eigen::Vector3d& way);

  std::vector<Piece> pieces_;
};

}  // namespace buckens::joints
