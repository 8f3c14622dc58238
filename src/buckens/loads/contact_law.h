// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include <Eigen/Dense>

namespace buckens::loads {

/// What a contact resists with, at each point where it touches.
struct ContactData {
  double stiffness = 0;  ///< K of the force K δⁿ over the overlap δ [N/mⁿ]
  double exponent = 1;   ///< n
  double loss = 0;       ///< α of loss_factor(restitution)
  double threshold = 0;  ///< smallest speed of approach that losses are related to [m/s]
  double damping = 0;    ///< [N s/m], its force is at most K δⁿ
  double static_coefficient = 0;
  double dynamic_coefficient = 0;
  double stribeck_speed = 0;        ///< [m/s], 0: the coefficient does not fall
  double tangential_stiffness = 0;  ///< of sticking [N/m]
  double inertia = 0;               ///< that friction stops [kg]
};

/// Below it the loss would have to act within the first thousandth of the overlap.
constexpr double kLeastElasticRestitution = 0.01;

/// α of the force K δⁿ (1 + α δ̇/v) with which a free body that comes with the speed v leaves with
/// e v, exactly and for any exponent: α (1 + e) = ln((1 + α)/(1 − α e)).
/// @param restitution e, 0 < e ≤ 1
double loss_factor(double restitution);

/// K of two spherical surfaces by Hertz: 4/3 E √R, 1/E = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂.
/// @param curvature sum of both curvatures 1/R, that of a hollow one negative [1/m]
double hertz_stiffness(const std::array<double, 2>& modulus, const std::array<double, 2>& poisson,
                       double curvature);

/// Force of one point across the surface.
struct NormalForce {
  double force = 0;      ///< ≥ 0 [N]
  double energy = 0;     ///< elastic [J]
  double elastic = 0;    ///< part that belongs to it [N]
  double stiffness = 0;  ///< derivative by the overlap [N/m]
  double damping = 0;    ///< derivative by its rate [N s/m]

  NormalForce& operator*=(double share) {
    for (double* value : {&force, &energy, &elastic, &stiffness, &damping}) *value *= share;
    return *this;
  }
};
/// @param overlap [m], @param rate of it [m/s], @param approach speed with which it began [m/s]
NormalForce normal_force(const ContactData& data, double overlap, double rate, double approach);

/// Force of one point along the surface: elastic stick with return mapping.
struct FrictionForce {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< on the second body [N]
  Eigen::Vector3d strain = Eigen::Vector3d::Zero();  ///< after rest has followed [m]
  Eigen::Vector3d along = Eigen::Vector3d::Zero();   ///< unit vector against the trial force
  bool slides = false;
  double share = 1;  ///< of the trial force that the bound admits
};
/// @param strain trial: of the last step, moved on by what has slipped since [m]
/// @param slip speed of the second body along the surface [m/s], @param load normal force [N]
FrictionForce friction_force(const ContactData& data, const Eigen::Vector3d& strain,
                             const Eigen::Vector3d& slip, double load);

}  // namespace buckens::loads
