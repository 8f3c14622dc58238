// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/analysis/statics/rest_rows.h"
#include "buckens/dynamics/system_kinematics.h"

namespace buckens::analysis {

/// Positions of the coordinates of one body among those that joints and loads use.
struct BodyCoordinates {
  int first = 0;         ///< of its coordinates
  int rotations = 0;     ///< frame rotations along Body::rotation_basis
  int translations = 0;  ///< frame translations along Body::translation_basis
  int rows = 0;          ///< interface rows y = N d

  int num_frame() const { return rotations + translations; }
  int size() const { return num_frame() + rows; }
};

/// Response of joints, loads and rows at rest to small motions of the bodies: the linearisation for
/// statics, stability and vibrations. Coordinates s body by body: frame, then interface values.
///
/// Central differences of the loads, of Gᵀλ and of Jᵀf with λ and f held; bodies without common
/// neighbours are moved together. Steps are 1e-5: in rad for rotations, also of nodes, else
/// relative to the model's length. That balances rounding (1e-16/step) and curvature (step²) in any
/// unit.
class LinearisedLoads {
 public:
  /// @param rest null: without rows at rest; outlives this object
  explicit LinearisedLoads(const model::Model& model, const RestRows* rest = nullptr);

  /// −∂(loads on one body)/∂(coordinates of another that affects it, or of itself).
  struct Block {
    std::size_t on, by;
    Eigen::MatrixXd stiffness;  ///< coordinates of `on` × of `by`
  };
  /// All structurally non-zero blocks. Their order and sizes are always the same, unless others of
  /// many bodies touch each other.
  /// @param motions at which to linearise; rates are used as given
  std::vector<Block> stiffness(const std::vector<dynamics::BodyMotion>& motions, double t,
                               const linalg::Vector& lambda, double load_factor = 1.0,
                               const RestStands& stands = {}) const;

  /// Derivatives of a scalar, such as a joint row, with respect to the coordinates of its body.
  linalg::Vector gradient(const dynamics::BodyRow& part) const;

  const std::vector<BodyCoordinates>& bodies() const { return bodies_; }
  int size() const { return size_; }

 private:
  double step(std::size_t body, int k) const;
  /// What acts, beside the configuration.
  struct Acting {
    double t;
    const linalg::Vector& lambda;
    double load_factor;
    const RestStands& stands;
  };
  linalg::Vector loads_after(const std::vector<dynamics::BodyMotion>& motions, const Acting& acting,
                             const linalg::Vector& step) const;

  const model::Model& model_;
  const RestRows* rest_;
  std::vector<BodyCoordinates> bodies_;
  int size_ = 0;
  std::vector<Eigen::VectorXd> lengths_;  // of the interface rows of each body
  /// Bodies affected by a body, including itself, and sets of which no body is affected by two.
  struct Neighbours {
    std::vector<std::vector<std::size_t>> of, colors;
  };
  Neighbours neighbours_at(const std::vector<dynamics::BodyMotion>& motions) const;
  Neighbours neighbours_;  // by joints and loads between given bodies
};

}  // namespace buckens::analysis
