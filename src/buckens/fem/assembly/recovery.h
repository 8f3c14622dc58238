// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "buckens/fem/element/block.h"
#include "buckens/fem/fe_model.h"
#include "buckens/linalg/sparse_rows.h"

namespace buckens::fem {

/// A beam or bar element as a line, for drawing.
struct LineElement {
  int a = 0;  ///< nodes
  int b = 0;
  std::array<const Section*, 2> sections{};            ///< at both ends; owned by the model
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns x, y, z, model axes
  bool bends = false;                                  ///< beam (true) or bar
};

/// All line elements in numerical order: beams, then bars.
std::vector<LineElement> line_elements(const FeModel& fe);

/// Rows of the displacement and rotation at a point of a line element.
/// @param element number among the line elements
/// @param xi 0 at its first node, 1 at its second
/// @throws ModelError if there is no such element or xi is outside [0, 1]
PointRows point_rows(const FeModel& fe, int element, double xi);

/// Rows of the displacement and rotation of a node.
PointRows node_rows(const FeModel& fe, int node);

/// Section forces and stresses of all line elements at once.
///
/// Per element twelve section forces in element axes: N, Q_y, Q_z [N], M_t, M_y, M_z [N m] at the
/// first end, then at the second. They are exerted by the part on the +x side on the part on the −x
/// side: N > 0 is tension, M_y > 0 stretches the +z side, M_z > 0 stretches the −y side; σ_x = N/A
/// + M_y z/I_y − M_z y/I_z. With θ_z = v′: M_z = E I_z v″ and Q_y = −M_z′. They are K_e d_e of the
/// element: loads and inertia forces between the ends are lumped to the nodes as in the equations
/// of motion, so the values converge as elements get shorter.
class Recovery {
 public:
  explicit Recovery(const FeModel& fe);

  int num_elements() const { return static_cast<int>(at_ends_.size()); }

  /// @param d nodal variables
  /// @return 12×(number of elements). Cost: one sparse product.
  linalg::Matrix section_forces(const linalg::Vector& d) const;

  /// Stress estimates from section forces [Pa], for each element the larger of its two ends: row 0
  /// the largest |σ_x| over the section's stress points, row 1 a von Mises stress from that and the
  /// sum of the largest torsional and shear stresses (conservative).
  linalg::Matrix stresses(const linalg::Matrix& section_forces) const;
  /// The same of some elements. @param section_forces of these, one after the other
  linalg::Matrix stresses(const linalg::Matrix& section_forces,
                          std::span<const int> elements) const;
  /// Rows over the nodal variables that give the section forces of some elements.
  linalg::SparseRows::RowMajor rows_of(std::span<const int> elements) const;

 private:
  Eigen::Vector2d stresses_of(std::size_t element,
                              const Eigen::Ref<const linalg::Vector>& section_forces) const;

  linalg::SparseRows::RowMajor rows_;
  std::vector<Section> sections_;
  std::vector<std::array<std::size_t, 2>> at_ends_;  // sections at the ends of each element
};

}  // namespace buckens::fem
