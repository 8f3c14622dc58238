// SPDX-License-Identifier: Apache-2.0
#include "buckens/joints/curve_pieces.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::joints {

using Eigen::Vector3d;

namespace {

// Largest angle between neighbours that counts as none: coordinates given by a few digits.
constexpr double kSmooth = 1.7e-3;  // 0.1 degrees
// Shares of a length up to which points count as one, radii as equal, and an arc as straight.
constexpr double kSame = 1e-9;
constexpr double kRadii = 1e-4;
constexpr double kStraight = 1e-9;
constexpr double kFullTurn = 2.0 * std::numbers::pi;

double angle_to(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

std::string kink(const std::string& where, double angle) {
  return fmt::format(
      "{} meet at a kink of {:.3g} degrees, around which no point can be led; round it with an "
      "arc, or let an arc without `through` and `centre` go on smoothly",
      where, angle * 360.0 / kFullTurn);
}

/// Where the circle through three points leaves the first one.
/// @throws ModelError if they lie on one line
Vector3d tangent_through(const Vector3d& from, const Vector3d& by, const Vector3d& to,
                         std::size_t number) {
  const Vector3d chord = to - from;
  const Vector3d a = by - from;
  const Vector3d b = to - by;
  const Vector3d normal = a.cross(b);
  if (normal.norm() <= kStraight * chord.squaredNorm() || b.norm() <= kSame * chord.norm()) {
    throw ModelError(fmt::format(
        "piece {} of `segments`: no circle passes through its ends and `through`, which lie on "
        "one line; write `line`, or move the point",
        number));
  }
  // Back from the chord by the angle at which both chords meet.
  return Eigen::AngleAxisd(-angle_to(a, b), normal.normalized()) * chord.normalized();
}

/// The same about a centre, the shorter way.
/// @throws ModelError if there is no such circle, or both ways are as long
Vector3d tangent_about(const Vector3d& from, const Vector3d& centre, const Vector3d& to,
                       std::size_t number) {
  const Vector3d begin = from - centre;
  const Vector3d end = to - centre;
  if (std::abs(begin.norm() - end.norm()) > kRadii * begin.norm()) {
    throw ModelError(fmt::format(
        "piece {} of `segments`: its `centre` is {:.6g} m from its start and {:.6g} m from its "
        "end; correct one of them, or give a point `through` which it passes",
        number, begin.norm(), end.norm()));
  }
  const Vector3d normal = begin.cross(end);
  if (normal.norm() <= kStraight * begin.squaredNorm()) {
    throw ModelError(fmt::format(
        "piece {} of `segments` is half a circle, for which `centre` does not say on which side; "
        "give a point `through` which it passes",
        number));
  }
  // From the chord, so that it ends at its end even where radii differ by rounding.
  const double half = 0.5 * angle_to(begin, end);
  return Eigen::AngleAxisd(-half, normal.normalized()) * (to - from).normalized();
}

}  // namespace

CurvePoint CurvePieces::Piece::at(double s) const {
  const double way = s - from;
  if (radius == 0.0) return {origin + way * first, first, Vector3d::Zero()};
  const double c = std::cos(way / radius);
  const double d = std::sin(way / radius);
  const Vector3d outwards = c * first + d * second;
  return {origin + radius * outwards, c * second - d * first, -outwards / radius};
}

CurvePieces::CurvePieces(const Vector3d& start, const std::vector<CurveStep>& steps) {
  Vector3d place = start;
  for (const CurveStep& step : steps) {
    const std::size_t number = pieces_.size() + 1;
    const Vector3d chord = step.to - place;
    if (!(chord.norm() > 0.0)) {
      throw ModelError(fmt::format(
          "piece {} of `segments` ends where it begins; remove it, or divide a full circle into "
          "two arcs",
          number));
    }
    if (step.kind == CurveStep::Kind::line) {
      add_line(place, chord);
    } else {
      add_arc(place, step);
    }
    place = step.to;
  }
  if (pieces_.empty()) throw ModelError("`segments` is empty; give lines and arcs");
}

void CurvePieces::add(Piece piece, double length) {
  piece.from = this->length();
  piece.to = piece.from + length;
  if (!pieces_.empty()) {
    const Vector3d before = pieces_.back().at(piece.from).tangent;
    const double angle = angle_to(before, piece.at(piece.from).tangent);
    if (angle > kSmooth) {
      const std::size_t number = pieces_.size();
      throw ModelError(
          kink(fmt::format("pieces {} and {} of `segments`", number, number + 1), angle));
    }
  }
  pieces_.push_back(std::move(piece));
}

void CurvePieces::add_arc(const Vector3d& from, const CurveStep& step) {
  using Kind = CurveStep::Kind;
  const std::size_t number = pieces_.size() + 1;
  const Vector3d chord = step.to - from;
  if (step.kind == Kind::smooth_arc && pieces_.empty()) {
    throw ModelError(
        "piece 1 of `segments` is an arc with nothing to go on from; give a point `through` "
        "which it passes, or its `centre`");
  }
  const Vector3d tangent = step.kind == Kind::smooth_arc ? pieces_.back().at(length()).tangent
                           : step.kind == Kind::arc_through
                               ? tangent_through(from, step.by, step.to, number)
                               : tangent_about(from, step.by, step.to, number);
  const Vector3d aside = chord - chord.dot(tangent) * tangent;
  if (aside.norm() <= kStraight * chord.norm()) {
    if (chord.dot(tangent) < 0.0) {
      throw ModelError(
          fmt::format("piece {} of `segments`: no arc leaves along the piece before it and ends "
                      "straight behind "
                      "its start; divide it",
                      number));
    }
    return add_line(from, chord);
  }
  Piece arc;
  const Vector3d inwards = aside.normalized();
  arc.radius = chord.squaredNorm() / (2.0 * chord.dot(inwards));
  arc.origin = from + arc.radius * inwards;
  arc.first = -inwards;
  arc.second = tangent;
  add(arc, arc.radius * 2.0 * std::atan2(chord.dot(inwards), chord.dot(tangent)));
}

void CurvePieces::add_line(const Vector3d& from, const Vector3d& way) {
  Piece line;
  line.origin = from;
  line.first = way.normalized();
  add(line, way.norm());
}

CurvePoint CurvePieces::at(double s) const {
  const auto next = std::upper_bound(pieces_.begin(), pieces_.end(), s,
                                     [](double value, const Piece& p) { return value < p.from; });
  return (next == pieces_.begin() ? pieces_.front() : *std::prev(next)).at(s);
}

void CurvePieces::require_closed() const {
  const CurvePoint begin = at(0.0);
  const CurvePoint end = at(length());
  const double open = (end.p - begin.p).norm();
  if (open > kSame * length()) {
    throw ModelError(
        fmt::format("the last piece of `segments` ends {:.6g} m from `start`; end it "
                    "there, or leave `closed` out",
                    open));
  }
  const double angle = angle_to(end.tangent, begin.tangent);
  if (angle > kSmooth) throw ModelError(kink("the last and first piece of `segments`", angle));
}

}  // namespace buckens::joints
