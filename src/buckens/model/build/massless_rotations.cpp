// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/massless_rotations.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/linalg/pivoted_qr.h"
#include "buckens/linalg/symmetric_eigen.h"

namespace buckens::model {

using Axes = Eigen::Matrix<double, 3, Eigen::Dynamic>;
using Eigen::MatrixXd;
using Eigen::Vector3d;

namespace {

// Lever arms, as fractions of the model's length: those due to rounding of positions are far below
// this, those of a mechanism above.
constexpr double kNoArm = 1e-6;
// Of the least inertia that joints may give: with the substitute for a missing one, iterations
// converge by about this factor.
constexpr double kStandIn = 1e-2;
constexpr double kProbe = 0.1;  // rad, and rad/s
constexpr int kInstants = 32;

std::string text(const Vector3d& axis) {
  const auto clean = [](double x) { return std::abs(x) < 5e-4 ? 0.0 : x; };
  return fmt::format("({:.3g}, {:.3g}, {:.3g})", clean(axis.x()), clean(axis.y()), clean(axis.z()));
}

/// Motion of a marker where the body turns about an axis through its mass centre.
/// @param axis in body axes; zero: at rest
spatial::MarkerMotion turned(const Model& model, const MarkerId& id, int body, const Vector3d& axis,
                             double angle, double rate) {
  spatial::MarkerMotion out;
  if (id.body == kGround) {
    out.p = id.X_WF.p;
    out.R = id.X_WF.R();
    return out;
  }
  const auto b = static_cast<std::size_t>(id.body);
  const spatial::Pose& X = model.placed[b];
  const spatial::Pose& marker = model.bodies[b].markers[static_cast<std::size_t>(id.marker)].X_BF;
  const bool moves = id.body == body;
  const Eigen::Matrix3d R =
      moves ? Eigen::Matrix3d(X.R() * Eigen::AngleAxisd(angle, axis).toRotationMatrix()) : X.R();
  out.p = X.p + R * marker.p;
  out.R = R * marker.R();
  if (!moves) return out;
  out.w = rate * (X.R() * axis);
  out.v = out.w.cross(out.p - X.p);
  return out;
}

class MasslessRotations {
 public:
  MasslessRotations(Model& model, double duration) : model_(model), duration_(duration) {
    lightest_ = model.bodies.empty() ? 0.0 : model.bodies.front().mass;
    for (const body::Body& body : model.bodies) lightest_ = std::min(lightest_, body.mass);
  }

  void run() {
    for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
      if (model_.bodies[b].missing_rotations.cols() > 0) settle(b);
    }
    require_independent();
  }

 private:
  /// Change of all joint rows by rotations of one body, lengths as shares of the model's.
  MatrixXd rows_by(std::size_t b, const Axes& axes) const {
    MatrixXd out = MatrixXd::Zero(model_.num_constraint_rows(), axes.cols());
    const auto body = static_cast<int>(b);
    for (const Joint& joint : model_.joints) {
      if (joint.first.body != body && joint.second.body != body) continue;
      for (Eigen::Index a = 0; a < axes.cols(); ++a) {
        const auto F = turned(model_, joint.first, body, axes.col(a), 0.0, 1.0);
        const auto M = turned(model_, joint.second, body, axes.col(a), 0.0, 1.0);
        Eigen::Matrix<double, 12, 1> twists;
        twists << F.w, F.v, M.w, M.v;
        for (std::size_t k = 0; k < joint.rows.size(); ++k) {
          const double change = joint.rows[k].evaluate(F, M, 0.0).J.dot(twists);
          out(joint.first_row + static_cast<int>(k), a) =
              joint.rows[k].is_length() ? change / model_.length : change;
        }
      }
    }
    return out;
  }

  void settle(std::size_t b) {
    body::Body& body = model_.bodies[b];
    const Axes missing = body.missing_rotations;
    const MatrixXd rows = rows_by(b, missing);
    const linalg::SymmetricEigen eigen = linalg::symmetric_eigen(rows.transpose() * rows);
    const auto& squares = eigen.values;  // of arms, ascending
    Eigen::Index free = 0;
    while (free < squares.size() && !(squares[free] > kNoArm * kNoArm)) ++free;
    if (free < missing.cols()) {  // otherwise the axes stay those that can be read
      const Axes axes = missing * eigen.vectors;
      keep(b, axes.rightCols(axes.cols() - free), std::sqrt(squares[free]));
      body.missing_rotations = axes.leftCols(free);
    }
    for (Eigen::Index k = 0; k < body.missing_rotations.cols(); ++k) {
      const Vector3d axis = body.missing_rotations.col(k);
      require_no_load(b, axis);
      model_.notes.push_back(body::missing_inertia_note(body, axis));
    }
  }

  void keep(std::size_t b, const Axes& axes, double least_arm) {
    body::Body& body = model_.bodies[b];
    if (body.is_flexible()) {
      const Joint& joint = joint_that_turns(b, axes.col(0));
      throw ModelError(
          joint.where,
          fmt::format("joint \"{}\" turns body \"{}\" about {}, an axis about which the body has "
                      "no rotary inertia; give its sections extent, add a point mass with "
                      "`inertia`, or use a joint that leaves this rotation free",
                      joint.name, body.name, text(axes.col(0))));
    }
    const Eigen::Index first = body.rotation_basis.cols();
    body.rotation_basis.conservativeResize(3, first + axes.cols());
    body.rotation_basis.rightCols(axes.cols()) = axes;
    const double arm = std::min(1.0, least_arm) * model_.length;
    for (Eigen::Index k = 0; k < axes.cols(); ++k) kept_.emplace_back(b, axes.col(k));
    body.stand_in = kStandIn * lightest_ * arm * arm * (axes * axes.transpose());
  }

  const Joint& joint_that_turns(std::size_t b, const Vector3d& axis) const {
    const MatrixXd rows = rows_by(b, axis);
    Eigen::Index worst = 0;
    rows.cwiseAbs().col(0).maxCoeff(&worst);
    return *model_.owner_of_row(static_cast<int>(worst)).first;
  }

  /// Rotations without inertia must be determined by the joints all together.
  void require_independent() const {
    if (kept_.size() < 2) return;
    MatrixXd columns(model_.num_constraint_rows(), static_cast<Eigen::Index>(kept_.size()));
    for (std::size_t k = 0; k < kept_.size(); ++k) {
      const MatrixXd own = rows_by(kept_[k].first, kept_[k].second);
      columns.col(static_cast<Eigen::Index>(k)) = own / own.norm();
    }
    const linalg::PivotedQr qr(columns, kNoArm);
    if (qr.rank() == columns.cols()) return;
    const auto last = static_cast<std::size_t>(qr.order().back());
    const auto& [b, axis] = kept_[last];
    const Joint& joint = joint_that_turns(b, axis);
    throw ModelError(
        joint.where,
        fmt::format("body \"{}\" has no rotary inertia about {}, and joints such as \"{}\" let it "
                    "turn together with others that have none either; give it an `inertia`",
                    model_.bodies[b].name, text(axis), joint.name));
  }

  /// The effect of a load, with a reaction of some size if it depends on one.
  loads::Action probe(const Load& load, double t, const spatial::MarkerMotion& first,
                      const spatial::MarkerMotion& second) const {
    const std::vector<double> signals(model_.signals.all.size() + 1, 0.0);
    loads::Sight sight{t, first, second, {}, {}, nullptr, {}, signals};
    sight.reaction = {Vector3d::Ones(), Vector3d::Ones()};
    if (load.coordinate >= 0) {
      const auto& law = model_.coordinates[static_cast<std::size_t>(load.coordinate)].law;
      loads::CoordinateMotion& motion = sight.coordinate;
      motion.J = law.derivatives(first, second);
      motion.value = motion.change = law.fraction(first, second);
      Eigen::Matrix<double, 12, 1> V;
      V << first.w, first.v, second.w, second.v;
      motion.rate = motion.J.dot(V);
    }
    return load.element->respond(sight);
  }

  /// Power of a load on a rotation per rate.
  double torque(const Load& load, std::size_t b, const Vector3d& axis, double t, double angle,
                double rate, double& size) const {
    const auto body = static_cast<int>(b);
    const auto first = turned(model_, load.first, body, axis, angle, rate);
    const auto second = turned(model_, load.second, body, axis, angle, rate);
    const loads::Action action = probe(load, t, first, second);
    const Vector3d axis_W = model_.placed[b].R() * axis;
    double out = 0.0;
    const auto add = [&](const MarkerId& id, const spatial::MarkerMotion& at,
                         const spatial::Wrench& wrench) {
      if (id.body != body) return;
      out += axis_W.dot(wrench.torque + (at.p - model_.placed[b].p).cross(wrench.force));
      size += wrench.torque.norm() + model_.length * wrench.force.norm();
    };
    add(load.first, first, action.on_first);
    add(load.second, second, action.on_second);
    return out;
  }

  void require_no_load(std::size_t b, const Vector3d& axis) const {
    const auto body = static_cast<int>(b);
    for (const Load& load : model_.loads) {
      if (load.first.body != body && load.second.body != body) continue;
      if (!load.others.empty()) continue;  // cables ask for inertia themselves
      double largest = 0.0;
      double size = 0.0;
      for (int k = 0; k < kInstants; ++k) {
        const double t = k == 0 ? 0.0 : duration_ * k / (kInstants - 1);
        const double angle = kProbe * (k % 3 - 1);
        const double rate = kProbe * (k / 3 % 3 - 1);
        try {
          largest = std::max(largest, std::abs(torque(load, b, axis, t, angle, rate, size)));
        } catch (const NumericalError&) {
          continue;  // a law without a value there: the run reports it when it gets there
        }
      }
      if (!(largest > kNoArm * size / kInstants)) continue;
      throw ModelError(fmt::format(
          "load \"{}\" turns body \"{}\" about {}, an axis about which the body has no rotary "
          "inertia; give it an `inertia`, or let the load act at its mass centre",
          load.name, model_.bodies[b].name, text(axis)));
    }
  }

  Model& model_;
  double duration_;
  double lightest_ = 0;
  std::vector<std::pair<std::size_t, Vector3d>> kept_;  // body and axis
};

}  // namespace

void settle_massless_rotations(Model& model, double duration) {
  MasslessRotations(model, duration).run();
}

}  // namespace buckens::model
