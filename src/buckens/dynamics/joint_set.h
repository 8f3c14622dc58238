// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "buckens/dynamics/circumstances.h"
#include "buckens/dynamics/constraints.h"
#include "buckens/dynamics/forces.h"
#include "buckens/dynamics/law_ends.h"
#include "buckens/loads/coordinate_law.h"

namespace buckens::dynamics {

/// Residuals of the joints at one instant.
struct JointResiduals {
  linalg::Vector g;      ///< residuals [m] or [-]
  linalg::Vector g_dot;  ///< their rates [m/s] or [1/s]
  linalg::Vector g_t;    ///< their partial time derivatives
};

/// All joints of a model laid out for a step, which reads them several times: markers and rows
/// contiguous in memory, directions in body axes. Gives the same as evaluate_constraints() and
/// add_joint_forces(), which use the model. Rows that slide or follow a law of time are left to
/// their own code; coincident points and perpendicular directions, which nearly all joints consist
/// of, are coded explicitly.
///
/// Laws on a joint, friction above all, look at the same two markers and at what the joint carries.
/// They are evaluated with it.
class JointSet {
 public:
  static constexpr std::size_t kMostRows = 6;  ///< of one joint

  /// @param model must outlive this object
  explicit JointSet(const model::Model& model);

  std::size_t size() const { return joints_.size(); }
  int first_row(std::size_t joint) const { return joints_[joint].first_row; }
  int num_rows(std::size_t joint) const { return joints_[joint].num_rows; }

  /// What laws on joints are evaluated with.
  struct Laws {
    const Circumstances& around;  ///< with the memory and λ of the joints
    /// Not null: how their forces grow with the multipliers, in the order of the soft rows.
    std::vector<ReactionSlope>* slopes = nullptr;
    /// Not null: their soft rows, one entry per law, see number_of().
    std::vector<SoftRows>* soft = nullptr;
    /// Not null: what they remember if the step ends here.
    LawEnds* ends = nullptr;
  };

  /// Residuals of all rows. With multipliers, the forces Gᵀλ are added: the rows of a joint act on
  /// its two markers together, and a marker's wrench goes to its body once. Allocates nothing once
  /// `out` has its size.
  /// @param memory turns and states as at the start of the step, null: none yet
  /// @param lambda,forces both or neither
  /// @param with null: without the laws()
  void evaluate(const std::vector<BodyMotion>& motions, double t, const model::RowMemory* memory,
                JointResiduals& out, const linalg::Vector* lambda = nullptr,
                Forces* forces = nullptr, const Laws* with = nullptr) const;
  /// Of each load of the model, whether it is a law that is evaluated with its joint.
  const std::vector<char>& laws() const { return is_law_; }
  bool has_laws() const { return !laws_.empty(); }
  /// The number of a load among them.
  std::size_t number_of(std::size_t load) const { return law_of_load_[load]; }

  /// Appends the soft rows of one of laws(), as evaluate_soft_rows() does.
  /// @param slopes null, or how their forces grow with multipliers
  void append_soft_rows(std::size_t load, const std::vector<BodyMotion>& motions, double t,
                        const Circumstances& around, SoftRows& out,
                        std::vector<ReactionSlope>* slopes) const;

  /// Whether a soft row is that of one of these laws.
  bool has_soft_row(int soft) const { return is_soft_row_[static_cast<std::size_t>(soft)] != 0; }

  /// Derivatives of the rows of one joint, num_rows() of them; zero where it has let go.
  void derivatives(std::size_t joint, const std::vector<BodyMotion>& motions, double t,
                   const model::RowMemory* memory, std::array<SystemRow, kMostRows>& out) const;

 private:
  /// A marker in the undeformed body, on the ground in the world.
  struct End {
    int body = model::kGround;
    int translation_row = -1, rotation_row = -1;
    Eigen::Vector3d z;
    Eigen::Matrix3d R;
    bool is_turned = false;  // R is not the identity
  };
  enum class Kind { point, direction, other };
  struct Row {
    Kind kind;
    Eigen::Vector3d b;  // of a direction row, in the first body; of a point row, in the world
    Eigen::Vector3d c;  // in the second body
    const joints::ConstraintRow* row;
    int state;  // first of its own in RowMemory::rows
  };
  /// A coordinate that a coupler takes part in.
  struct Coupled {
    End first, second;
    std::size_t coordinate;
    const joints::CoordinateTerm* term;
    const model::CoupledCoordinate* slider;  // on a beam, null: another
  };
  struct Law {
    std::size_t load;
    int regime;                              // its place in Forces::regimes, −1: none
    int soft;                                // its first soft row
    const loads::ReactionFollower* follows;  // null: not the reaction
    const loads::CoordinateLaw* along;       // null: another kind
    bool has_state;                          // one, of a law along a coordinate
  };
  struct Joint {
    End first, second;
    int first_row, num_rows;
    std::size_t rows;                  // first of them in rows_
    std::size_t coupled, num_coupled;  // of a coupler in coupled_
    std::size_t laws, num_laws;        // in laws_
    const model::Joint* slider;        // on a beam, null: another
  };
  /// Motion of one end, world axes unless said otherwise. `axes` turn what was given in body axes
  /// along with the marker's place in the mesh.
  struct Motion {
    Eigen::Matrix3d R_WB, axes;
    Eigen::Matrix3d rotation_map;  // of ends that follow rotations of a mesh
    Eigen::Vector3d z;             // in the deformed body, body axes
    Eigen::Vector3d p, w, v;

    spatial::MarkerMotion marker(const End& end) const {
      return {p, end.is_turned ? Eigen::Matrix3d(axes * end.R) : axes, w, v};
    }
  };

  static Motion motion_of(const End& end, const std::vector<BodyMotion>& motions);
  static void add_wrench(const End& end, const Motion& motion, const spatial::Wrench& wrench,
                         Forces& out);
  static void derive(const End& end, const Motion& motion, const spatial::Wrench& wrench,
                     BodyRow& out);

  void take_laws();
  /// Residuals of a joint of two markers. @return what its multipliers do
  /// @param units null, or room for what unit multipliers do to the second marker
  JointWrenches evaluate_rows(std::size_t joint, const Motion& F, const Motion& M, double t,
                              const double* states, const linalg::Vector* lambda,
                              JointResiduals& out, spatial::Wrench* units) const;
  /// Both ends of a joint and its markers.
  struct Look {
    const Motion &F, &M;
    spatial::MarkerMotion first, second;
  };
  /// Adds what the laws of a joint do.
  void act(const Joint& joint, const Look& look, double t, const Laws& with,
           const spatial::Wrench* units, JointWrenches& wrenches, Forces& forces) const;
  /// Adds what one of them does. @return its regime
  int add_response(const Law& law, const loads::Sight& sight, LawEnds* ends,
                   JointWrenches& wrenches, Forces& forces) const;
  /// Appends the soft rows of a law. @return its regime
  int append_tangent(const Joint& joint, const Law& law, const Look& look,
                     const loads::Sight& sight, bool is_off, SoftRows& out) const;
  static void append_slopes(const Joint& joint, const Law& law, const loads::Sight& sight,
                            int regime, const spatial::Wrench* units,
                            std::vector<ReactionSlope>& out);

  void evaluate_coupler(const Joint& joint, const std::vector<BodyMotion>& motions, double t,
                        const model::RowMemory* memory, JointResiduals& out,
                        const linalg::Vector* lambda, Forces* forces) const;
  void evaluate_slider(const model::Joint& joint, const std::vector<BodyMotion>& motions, double t,
                       const model::RowMemory* memory, JointResiduals& out,
                       const linalg::Vector* lambda, Forces* forces) const;
  void derive_held(std::size_t joint, const std::vector<BodyMotion>& motions, double t,
                   const model::RowMemory* memory, std::array<SystemRow, kMostRows>& out) const;
  void derive_coupler(const Joint& joint, const std::vector<BodyMotion>& motions, double t,
                      const model::RowMemory* memory, SystemRow& out) const;

  const model::Model& model_;
  std::vector<Joint> joints_;
  std::vector<Row> rows_;
  std::vector<Coupled> coupled_;
  std::vector<Law> laws_;
  std::vector<std::size_t> law_of_load_;  // in laws_, of laws()
  std::vector<char> is_law_, is_soft_row_;
  int num_rows_ = 0;
};

}  // namespace buckens::dynamics
