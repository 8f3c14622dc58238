// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/base/task_pool.h"
#include "buckens/fem/element/elasticity.h"
#include "buckens/fem/fe_model.h"
#include "buckens/fem/solid/sampling.h"

namespace buckens::fem {

class SolidBlock;

/// Six strains or stresses per column: xx, yy, zz, xy, yz, zx in model axes, shear strains as 2ε.
using TensorColumns = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// A node with one of the materials that meet at it.
struct StrainPlace {
  int node = 0;
  int material = -1;  ///< index into SolidStrains::elasticities(); −1: no solid at this node
};

/// Twice the strain energy of a difference of strains, and of the strains themselves [J].
struct EnergyOfError {
  double error = 0;
  double energy = 0;
};

/// Strains of solid elements at nodes and at centres.
///
/// In each element strains are taken at the points of solid_sampling(), including those of the
/// incompatible modes of hex8, extrapolated to the nodes by its polynomial, and averaged there over
/// the elements of one elasticity: stresses may jump where the material changes. Second order in
/// the element size at centres of hex8, at nodes of hex8 inside the mesh, and for hex20 and tet10;
/// first order at nodes of hex8 on the surface. Theory: docs/theory/18-stresses.md.
///
/// Only the condensed inner modes of hex8 (81 numbers) are stored per element; the cost of an
/// evaluation is that of the gradients at the points.
class SolidStrains {
 public:
  /// @param nodes at which strains are wanted
  /// @param elements solid elements at whose centres they are wanted, numbered among the solids
  SolidStrains(const FeModel& fe, const std::vector<int>& nodes, const std::vector<int>& elements);

  /// The wanted nodes in their order, one entry per material at the node.
  const std::vector<StrainPlace>& places() const { return places_; }
  Eigen::Index num_places() const { return static_cast<Eigen::Index>(places_.size()); }
  int num_elements() const { return static_cast<int>(element_materials_.size()); }
  /// For each wanted element, index into elasticities().
  const std::vector<int>& element_materials() const { return element_materials_; }
  const std::vector<Elasticity>& elasticities() const { return elasticities_; }

  /// @param d nodal variables
  /// @param at_places 6×places; zero where there is no solid
  /// @param at_elements 6×elements, at their centres
  /// @param pool null: the calling thread alone. No bit depends on it
  void evaluate(const linalg::Vector& d, TensorColumns& at_places, TensorColumns& at_elements,
                TaskPool* pool = nullptr) const;

  /// Stresses from strains of evaluate(), each with its own elasticity.
  void stresses(const TensorColumns& strain_at_places, const TensorColumns& strain_at_elements,
                TensorColumns& at_places, TensorColumns& at_elements,
                TaskPool* pool = nullptr) const;

  /// How far the strains of the elements are from continuous ones, in the energy norm (Zienkiewicz
  /// & Zhu, 1987); docs/theory/21-errors.md (E2).
  /// @param at_places from evaluate(); elements without wanted nodes do not count
  EnergyOfError energy_of_error(const linalg::Vector& d, const TensorColumns& at_places) const;

  /// Place of a node among places() with the material of a solid element, −1 if it is not wanted.
  int place_of(int node, int element) const;

 private:
  using InnerProducts = Eigen::Matrix<double, 9, 9>;
  struct Element {
    const SolidBlock* block;
    int index;         // in the block
    int row;           // among the wanted elements, −1
    int material;      // index into elasticities_
    int first_corner;  // into corner_places_, −1 if none of its nodes is wanted
    int inner;         // index into inner_, −1 without incompatible modes
  };

  int material_of(const SolidBlock& block, int element);
  void add_places(const std::vector<int>& nodes);
  InnerProducts inner_inverse(const Element& element) const;
  template <int nodes, class AtNode, class AtCentre>
  void evaluate_element(const Element& element, const linalg::Vector& d, const AtNode& at_node,
                        const AtCentre& at_centre) const;
  template <class AtNode, class AtCentre>
  void evaluate_any(const Element& element, const linalg::Vector& d, const AtNode& at_node,
                    const AtCentre& at_centre) const;

  struct StrainAtPlace {
    int place;
    Eigen::Matrix<double, 6, 1> strain;
  };
  /// Adds to the means at places, in the order of the elements.
  void add_by_threads(const linalg::Vector& d, TensorColumns& at_places, TensorColumns& at_elements,
                      TaskPool& pool) const;

  const FeModel& fe_;
  std::vector<StrainPlace> places_;
  std::vector<double> share_;           // weight of one element in the mean at each place
  std::vector<int> first_place_;        // of each node, −1 if it is not wanted
  std::vector<int> element_materials_;  // of the wanted elements
  std::vector<int> solid_materials_;    // of all solid elements
  std::vector<Elasticity> elasticities_;
  std::vector<Element> elements_;  // elements to evaluate
  std::vector<int> corner_places_;
  std::vector<InnerProducts> inner_;
};

/// Principal values, in descending order. @param s σ_xx, σ_yy, σ_zz, τ_xy, τ_yz, τ_zx
Eigen::Vector3d principal_stresses(const Eigen::Ref<const Eigen::Matrix<double, 6, 1>>& s);

}  // namespace buckens::fem
