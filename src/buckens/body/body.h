// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "buckens/base/task_pool.h"
#include "buckens/body/coupling_level.h"
#include "buckens/body/inertia_invariants.h"
#include "buckens/body/marker.h"
#include "buckens/body/nodal_recovery.h"
#include "buckens/body/sieve.h"
#include "buckens/body/solver_choice.h"
#include "buckens/fem/assembly/geometric_stiffness.h"
#include "buckens/fem/fe_model.h"

namespace buckens::body {

/// Properties of a reduction of a body.
struct ReductionFigures {
  std::string basis;        ///< "free-free", "craig-bampton" or "quasi-static"
  int modes = 0;            ///< vibrations in it
  int static_shapes = 0;    ///< deformations by static loads
  int full_dofs = 0;        ///< nodal variables of the mesh
  double highest_mode = 0;  ///< highest frequency among the vibrations [rad/s]
  /// Largest fraction of the static interface compliance that the vibration modes alone miss, over
  /// all interface directions; static shapes compensate for it. 0 without an interface.
  double static_share = 0;
};

/// The finite-element part of a body: everything with n rows.
///
/// A reduced body, or one with rigid regions, uses the same equations in other coordinates: `fe`
/// then holds the projected matrices, and `recovery` maps the coordinates to the nodal variables of
/// mesh().
struct FlexiblePart {
  fem::FeModel fe;  ///< of the equations of motion
  Sieve sieve;
  InertiaInvariants invariants;
  /// Of large solids: what sieve and invariants are formed from, node by node. Otherwise null.
  std::shared_ptr<const NodalMotion> nodal_motion;
  linalg::SymmetricMatrix C;  ///< α M + Σ β K, FM (22); empty pattern where undamped
  CouplingChoice coupling;
  /// Quasi-static deformation without inertia: rates of deformation are always zero.
  bool is_quasi_static = false;

  /// Set if the coordinates are not the nodal variables, otherwise empty.
  std::shared_ptr<const fem::FeModel> full_mesh;
  NodalRecovery recovery;
  ReductionFigures reduction;  ///< of a reduced body
  /// Stiffening by axial forces, empty unless requested.
  std::unique_ptr<const fem::GeometricStiffness> geometric;

  /// Rows y = N d of all markers; the first `num_interface_rows` belong to markers of joints and
  /// loads.
  Eigen::SparseMatrix<double, Eigen::RowMajor> rows;
  int num_interface_rows = 0;
  /// Number of the last interface rows that are patterns of distributed loads, not held by joints.
  int num_pattern_rows = 0;

  SolverChoice solver;  ///< of systems with M, K and C

  /// @throws ModelError if rigid motion strains the mesh or the mesh is a mechanism
  FlexiblePart(const std::string& body, fem::FeModel model, CouplingChoice choice);
  FlexiblePart(const FlexiblePart&) = delete;
  FlexiblePart& operator=(const FlexiblePart&) = delete;

  /// Enables stiffening by axial forces in beams and bars.
  void stiffen();

  Eigen::Index num_dofs() const { return fe.M.rows(); }
  /// Interface rows without patterns; a Craig–Bampton basis fixes them.
  int num_held_rows() const { return num_interface_rows - num_pattern_rows; }
  bool is_damped() const { return C.nonZeros() > 0; }
  /// Whether the body is reduced to a basis of vibration modes and static shapes.
  bool is_reduced() const { return recovery.is_dense(); }
  /// The mesh with its nodes and elements.
  const fem::FeModel& mesh() const { return full_mesh ? *full_mesh : fe; }
  /// Whether what is done with all of the mesh takes longer than to wake threads.
  bool is_large() const {
    constexpr int kManyVariables = 3000;
    return mesh().dofs.num_dofs >= kManyVariables;
  }
  /// The pool, or null where it would take longer than the calling thread alone.
  TaskPool* if_worth(TaskPool* pool) const { return is_large() ? pool : nullptr; }
  /// Nodal variables of mesh() from those of the equations of motion.
  linalg::Vector nodal(const linalg::Vector& d) const { return recovery.apply(d); }
  /// Coordinates closest to given nodal variables in the mass metric: (TᵀMT)⁻¹TᵀM d.
  linalg::Vector coordinates(const linalg::Vector& nodal_values) const;
};

/// A body of the model: a Buckens frame B that carries all large motion and, for flexible bodies, a
/// mesh that deforms relative to it. A rigid body has no nodal variables.
///
/// B has its origin at the mass centre and axes parallel to the body's model axes.
class Body {
 public:
  std::string name;
  double mass = 0;                                ///< [kg]
  Eigen::Matrix3d J0 = Eigen::Matrix3d::Zero();   ///< about the mass centre [kg m²]
  Eigen::Vector3d com = Eigen::Vector3d::Zero();  ///< mass centre in model axes [m]
  /// Orthonormal bases of the frame coordinates in use: rotations in body axes (3×0…3),
  /// translations in world axes (3×2…3). Planar models and missing inertia have fewer columns.
  Eigen::Matrix<double, 3, Eigen::Dynamic> rotation_basis;
  Eigen::Matrix<double, 3, Eigen::Dynamic> translation_basis;
  /// Axes (3×0…3, body axes) about which the frame does not rotate because it has no inertia.
  Eigen::Matrix<double, 3, Eigen::Dynamic> missing_rotations;
  /// Substitute for missing inertia where an iteration needs a regular matrix [kg m²]: about axes
  /// of `rotation_basis` without inertia that joints rotate, otherwise zero. Results do not depend
  /// on it, because its contribution is subtracted again in each iteration.
  Eigen::Matrix3d stand_in = Eigen::Matrix3d::Zero();
  std::vector<Marker> markers;
  std::shared_ptr<FlexiblePart> flexible;  ///< empty for rigid bodies; copies of a body share it

  bool is_flexible() const { return flexible != nullptr; }
  Eigen::Index num_dofs() const { return flexible ? flexible->num_dofs() : 0; }
  int num_rows() const { return flexible ? static_cast<int>(flexible->rows.rows()) : 0; }
  int num_interface_rows() const { return flexible ? flexible->num_interface_rows : 0; }

  /// Index of the marker with this name, or −1.
  int find_marker(const std::string& marker) const;
  /// y = N d for all marker rows; empty for rigid bodies.
  Eigen::VectorXd row_values(const linalg::Vector& d) const;
  /// Size used to judge rotations and rigid residuals [m]: √(tr J0 / 2m), the radius of gyration;
  /// 0 of a point mass.
  double length_scale() const;
};

/// Bases of the frame coordinates that carry inertia, rank-revealing; the other rotations become
/// `missing_rotations`.
/// @param planar normal of the plane in world axes at the initial orientation, zero for 3-D
void select_frame_coordinates(Body& body, const std::optional<Eigen::Vector3d>& plane_normal);

/// Message about a rotation that was dropped.
std::string missing_inertia_note(const Body& body, const Eigen::Vector3d& axis);

}  // namespace buckens::body
