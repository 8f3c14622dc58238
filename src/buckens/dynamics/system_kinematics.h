// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/model/model.h"
#include "buckens/model/state.h"

namespace buckens::dynamics {

/// Motion of one body at one instant, as far as joints and loads use it.
struct BodyMotion {
  body::FrameMotion frame;
  Eigen::VectorXd y, y_dot;  ///< marker rows of a flexible body
};

/// Derivatives of one scalar with respect to one body: frame coordinates (rotation in body axes,
/// translation in world axes) and six interface values.
struct BodyRow {
  int body = model::kGround;
  Eigen::Matrix<double, 1, 6> frame = Eigen::Matrix<double, 1, 6>::Zero();
  int translation_row = -1;  ///< first of three interface rows, −1: none
  int rotation_row = -1;
  Eigen::Matrix<double, 1, 6> interface = Eigen::Matrix<double, 1, 6>::Zero();

  /// Rate of the scalar by this body's motion.
  double rate(const BodyMotion& motion) const;
  /// Change of the scalar by a displacement of the body.
  double change(const Eigen::Matrix<double, 6, 1>& u, const Eigen::VectorXd& y) const;
};

/// The bodies' shares of a scalar: two of one between two markers, more of one that couples
/// coordinates of several joints. Several shares may be of the same body.
struct SystemRow {
  BodyRow first, second;
  std::vector<BodyRow> more;  ///< empty of nearly all rows
  /// Of a row whose marker rows change as it travels along a beam: the number of its joint. Bodies
  /// stay the same. −1 of all others.
  int travelling = -1;

  std::size_t num_parts() const { return 2 + more.size(); }
  const BodyRow& part(std::size_t k) const {
    return k == 0 ? first : k == 1 ? second : more[k - 2];
  }
  BodyRow& part(std::size_t k) { return k == 0 ? first : k == 1 ? second : more[k - 2]; }

  /// All shares one after the other: `for (const BodyRow* part : row.parts())`.
  class Parts {
   public:
    struct Place {
      const SystemRow* row;
      std::size_t k;
      const BodyRow* operator*() const { return &row->part(k); }
      Place& operator++() { return ++k, *this; }
      bool operator!=(const Place& other) const { return k != other.k; }
    };
    explicit Parts(const SystemRow& row) : row_(row) {}
    Place begin() const { return {&row_, 0}; }
    Place end() const { return {&row_, row_.num_parts()}; }

   private:
    const SystemRow& row_;
  };
  Parts parts() const { return Parts(*this); }

  /// Makes all shares zero; bodies and places stay.
  void clear() {
    for (std::size_t k = 0; k < num_parts(); ++k) {
      part(k).frame.setZero();
      part(k).interface.setZero();
    }
  }
};

/// Kinematics of one marker, on a body or on the ground.
body::MarkerKinematics evaluate_marker(const model::Model& model, const model::MarkerId& id,
                                       const std::vector<BodyMotion>& motions);

/// Marker acceleration when all coordinate accelerations are zero.
spatial::MarkerBias evaluate_bias(const model::Model& model, const model::MarkerId& id,
                                  const std::vector<BodyMotion>& motions);

/// Chains the derivatives with respect to marker twists to those of the bodies' coordinates.
SystemRow system_row(const model::Model& model, const model::MarkerId& first,
                     const body::MarkerKinematics& first_kinematics, const model::MarkerId& second,
                     const body::MarkerKinematics& second_kinematics, const spatial::PairRow& J);

/// Motion of one body; its marker rows by sums where other processes have its vectors.
void motion_of(const body::Body& body, const model::BodyState& state, BodyMotion& out);
/// Motions of all bodies at a state.
std::vector<BodyMotion> motions_of(const model::Model& model, const model::State& state);
/// The same into room that is kept, so that steps allocate nothing.
void motions_of(const model::Model& model, const model::State& state, std::vector<BodyMotion>& out);

}  // namespace buckens::dynamics
