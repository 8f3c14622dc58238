// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/initial/assembly_moves.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/dynamics/constraints.h"

namespace buckens::analysis {

using Eigen::Vector3d;

namespace {

// Of the model's length, and in rad: more than placements with rounded numbers cause.
constexpr double kLargeMove = 1e-3;
// The same, below which a motion is rounding.
constexpr double kNoMove = 1e-9;
// Share by which motions of parts that move alike may differ.
constexpr double kMovedAlike = 1e-9;
// Thousands of bodies in the wrong place are one mistake, not thousands.
constexpr std::size_t kMostMovesTold = 10;

/// A joint that is open with the bodies as placed.
struct OpenJoint {
  const model::Joint* joint = nullptr;
  double gap = 0;    // [m]
  double angle = 0;  // [rad], as far as sines are angles

  bool is_drive() const {
    return joint->type == joints::JointType::prescribed_rotation ||
           joint->type == joints::JointType::prescribed_translation ||
           joint->type == joints::JointType::prescribed_coordinate;
  }
  double size(double length) const { return std::max(gap / length, angle); }
};

std::vector<OpenJoint> open_joints(const model::Model& model, const model::State& state) {
  std::vector<OpenJoint> out;
  const double t = state.t;
  model::State placed = model::placed_state(model);
  placed.t = t;
  placed.memory.released = state.memory.released;
  dynamics::Constraints constraints;
  dynamics::evaluate_constraints(model, dynamics::motions_of(model, placed), t, &placed.memory,
                                 constraints);
  for (const model::Joint& joint : model.joints) {
    OpenJoint open{&joint, 0, 0};
    for (std::size_t k = 0; k < joint.rows.size(); ++k) {
      const double g = constraints.g[joint.first_row + static_cast<Eigen::Index>(k)];
      double& own = joint.rows[k].is_length() ? open.gap : open.angle;
      own = std::hypot(own, g);
    }
    if (!joint.is_tie && open.size(model.length) > kNoMove) out.push_back(open);
  }
  return out;
}

bool touches(const model::Joint& joint, const model::WholeBody& whole) {
  const auto is_own = [&](int body) {
    return body >= whole.first && body < whole.first + whole.count;
  };
  return is_own(joint.first.body) || is_own(joint.second.body);
}

/// The joint responsible for the motion of a body: joints before drives, its own before those of
/// others, and of these the one with the largest gap.
const OpenJoint* to_blame(const std::vector<OpenJoint>& open, const model::WholeBody& whole,
                          double length) {
  const OpenJoint* best = nullptr;
  const auto rank = [&](const OpenJoint& o) {
    // A joint that is practically closed does not precede an open drive.
    const bool is_open = !o.is_drive() && o.size(length) > kLargeMove;
    return std::tuple(is_open, touches(*o.joint, whole), o.size(length));
  };
  for (const OpenJoint& o : open) {
    if (best == nullptr || rank(o) > rank(*best)) best = &o;
  }
  return best;
}

/// Without the rounding in components that are zero.
std::string direction(const Vector3d& v) {
  const auto shown = [](double x) { return std::abs(x) > 1e-6 ? x : 0.0; };
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", shown(v[0]), shown(v[1]), shown(v[2]));
}

std::optional<AssemblyMove> move_of(const model::Model& model, const model::WholeBody& whole,
                                    const model::State& assembled) {
  std::optional<AssemblyMove> out;
  double most = kNoMove;
  for (int k = whole.first; k < whole.first + whole.count; ++k) {
    const auto b = static_cast<std::size_t>(k);
    const spatial::Pose& from = model.placed[b];
    const spatial::Pose& to = assembled.bodies[b].frame.X_WB;
    const Eigen::AngleAxisd turn(Eigen::Quaterniond(to.q * from.q.conjugate()));
    const double size = std::max((to.p - from.p).norm() / model.length, turn.angle());
    // Of parts that turn alike the first is told, whatever rounding makes of the others.
    if (size <= most * (1.0 + kMovedAlike)) continue;
    most = size;
    out.emplace();
    out->translation = to.p - from.p;
    out->angle = turn.angle();
    out->axis = turn.axis();
    out->is_large = size > kLargeMove;
  }
  return out;
}

}  // namespace

std::string AssemblyMove::text() const {
  std::string out = fmt::format("assembly ");
  const double way = translation.norm();
  // A millionth of the other is rounding, in any units.
  if (way > 0.0) {
    out += fmt::format("moved body \"{}\" by {:.4g} m along {}", body, way,
                       direction(translation / way));
  }
  if (angle > kNoMove) {
    out += way > 0.0 ? " and turned it" : fmt::format("turned body \"{}\"", body);
    out += fmt::format(" by {:.4g} rad about {}", angle, direction(axis));
  }
  if (joint.empty()) return out;
  if (is_drive) {
    return out + fmt::format(": drive \"{}\" does not start from zero ({})", joint, gap);
  }
  return out + fmt::format(" to close joint \"{}\" ({})", joint, gap);
}

std::vector<AssemblyMove> assembly_moves(const model::Model& model, const model::State& assembled) {
  std::vector<AssemblyMove> out;
  const std::vector<OpenJoint> open = open_joints(model, assembled);
  for (const model::WholeBody& whole : model.wholes) {
    std::optional<AssemblyMove> move = move_of(model, whole, assembled);
    if (!move) continue;
    move->body = whole.name;
    if (const OpenJoint* blamed = to_blame(open, whole, model.length)) {
      const model::Joint& joint = *blamed->joint;
      move->joint = joint.name;
      move->where = joint.where;
      move->is_drive = blamed->is_drive();
      move->gap = fmt::format("{} between {} and {}, {:.4g} m apart and {:.4g} rad askew as placed",
                              joints::to_string(joint.type), joint.first.text, joint.second.text,
                              blamed->gap, blamed->angle);
      if (move->is_drive) move->is_large = false;
    }
    out.push_back(std::move(*move));
  }
  return out;
}

std::vector<std::string> judge_assembly(const model::BuiltModel& built,
                                        const std::vector<AssemblyMove>& moves) {
  std::vector<std::string> out;
  std::size_t count = 0;
  double farthest = 0;
  for (const AssemblyMove& move : moves) {
    if (!move.is_large) continue;
    const std::string text =
        move.text() + "; correct the placement (`at`) of the body, its lengths, or the markers";
    if (built.description.assembly == model::AssemblyRule::strict) {
      throw ModelError(move.where, text + " (`assembly: strict` accepts no such motion)");
    }
    farthest = std::max(farthest, move.translation.norm());
    if (++count > kMostMovesTold) continue;
    out.push_back(move.where.empty() ? text : move.where.text() + ": " + text);
  }
  if (count > kMostMovesTold) {
    out.push_back(
        fmt::format("assembly moved {} more bodies; the largest displacement of all is {:.4g} m. "
                    "`buckens check --json` lists them",
                    count - kMostMovesTold, farthest));
  }
  return out;
}

}  // namespace buckens::analysis
