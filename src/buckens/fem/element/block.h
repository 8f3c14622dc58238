// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "buckens/base/task_pool.h"
#include "buckens/fem/element/dof_map.h"
#include "buckens/fem/element/material.h"
#include "buckens/fem/line/section.h"
#include "buckens/linalg/matrix_types.h"

namespace buckens::fem {

/// Mass and first moment about the origin of the model axes.
struct MassMoment {
  double mass = 0;                                  ///< [kg]
  Eigen::Vector3d first = Eigen::Vector3d::Zero();  ///< ∫ s dm [kg m]
};

/// Inertia of a body under assembly. Entries with row or column −1 are never added.
struct InertiaSum {
  std::array<std::vector<linalg::Triplet>, 6> W;  ///< order of ShapeIntegrals::W
  std::vector<linalg::Triplet> M_flywheel;        ///< the part of M that is not in Σ W_aa
  std::vector<linalg::Triplet> nodal;             ///< NodalMass::Ms, by node numbers
  linalg::Matrix c;                               ///< n×9
  Eigen::Matrix3d C0 = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d J0_flywheel = Eigen::Matrix3d::Zero();
};

/// Stiffness of a body under assembly.
struct StiffnessSum {
  std::vector<linalg::Triplet> K;
  std::vector<linalg::Triplet> K_damping;  ///< β K
};

/// Linear map from nodal variables to a point of the mesh: y = N d, entries (0…2, DOF, value).
struct PointRows {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< undeformed, model axes [m]
  std::vector<linalg::Triplet> translation;
  std::vector<linalg::Triplet> rotation;
  bool has_rotation = false;  ///< false where the mesh has no rotations (bars)
};

/// Data that a block needs from its body.
struct MeshView {
  const std::vector<Node>& nodes;
  const DofMap& dofs;
  TaskPool* pool = nullptr;  ///< shares what is done with all elements; no bit depends on it
};

/// All elements of one kind in a body, so that one virtual call processes the whole block.
class ElementBlock {
 public:
  virtual ~ElementBlock() = default;

  virtual int num_elements() const = 0;
  /// The nodes of an element; of a line, from end to end.
  virtual std::span<const int> nodes(int element) const = 0;
  /// First and last node; the same one for a point mass.
  std::array<int, 2> ends(int element) const {
    const auto all = nodes(element);
    return {all.front(), all.back()};
  }
  /// Whether the elements are lines (beams, bars) rather than on a single node.
  virtual bool is_line() const = 0;
  /// Whether the elements are volumes.
  virtual bool is_solid() const { return false; }
  /// Whether the elements are surfaces with a thickness.
  virtual bool is_shell() const { return false; }
  /// Whether the elements connect their nodes.
  virtual bool holds_nodes() const { return is_line() || is_solid() || is_shell(); }
  /// Whether the nodes of the elements have rotations.
  virtual bool has_rotations() const = 0;
  /// Null for elements without a material or section.
  virtual const Material* material(int element) const = 0;
  virtual const Section* section(int element) const = 0;
  /// Section at the first (0) or second (1) end of a line element.
  virtual const Section* end_section(int element, int /*end*/) const { return section(element); }
  /// Axes x, y, z of a line element as columns, model axes: x from its first to its second end.
  virtual Eigen::Matrix3d line_axes(const std::vector<Node>& /*nodes*/, int /*element*/) const {
    return Eigen::Matrix3d::Identity();
  }
  /// E A of the uniform line element with the same extension under tension [N].
  virtual double axial_rigidity(int element) const {
    return material(element)->E * section(element)->A;
  }

  /// @throws ModelError naming the nodes of an invalid element (zero length, bad constants)
  virtual void check(const MeshView& mesh) const = 0;

  virtual void add_mass(const std::vector<Node>& nodes, MassMoment& sum) const = 0;
  /// @param com mass centre of the whole body in model axes [m]
  virtual void add_inertia(const MeshView& mesh, const Eigen::Vector3d& com,
                           InertiaSum& sum) const = 0;
  virtual void add_stiffness(const MeshView& mesh, StiffnessSum& sum) const = 0;

  /// Section forces as rows over d: row 12 e + (0…5) at the first end, (6…11) at the second, with e
  /// counted from `first_element`. See recovery.h for their meaning.
  virtual void add_force_rows(const MeshView& mesh, int first_element,
                              std::vector<linalg::Triplet>& rows) const = 0;
  /// @param xi 0 at the first end, 1 at the second
  virtual PointRows point_rows(const MeshView& mesh, int element, double xi) const = 0;

  /// Stresses σ_xx, σ_yy, σ_zz, τ_xy, τ_yz, τ_zx at the centres of solid elements or of both sides
  /// of shells, model axes, as rows over d: rows 6 e + (0…5) with e counted from `first_element`; a
  /// shell has two sets of rows, those of the side the normal points to first.
  virtual void add_stress_rows(const MeshView& /*mesh*/, int /*first_element*/,
                               std::vector<linalg::Triplet>& /*rows*/) const {}
  /// Faces of a solid element, or the one of a shell, in pieces for drawing, nodes
  /// counter-clockwise seen from outside; −1 as the fourth node of a triangle. Elements with a
  /// common face divide it into the same pieces.
  virtual std::vector<std::array<int, 4>> faces(int /*element*/) const { return {}; }
};

}  // namespace buckens::fem
