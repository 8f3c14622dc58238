// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/contact_settings.h"

#include <vector>

#include <gtest/gtest.h>

#include "buckens/loads/contact_friction.h"
#include "buckens/loads/contact_law.h"
#include "buckens/loads/contact_stop.h"

namespace buckens::loads {
namespace {

ContactData elastic() {
  ContactData data;
  data.stiffness = 1e5;
  data.loss = loss_factor(0.8);
  data.static_coefficient = 0.4;
  data.dynamic_coefficient = 0.3;
  return data;
}

TEST(ContactSettings, WithoutSignalsAllStays) {
  ContactSettings settings;
  EXPECT_FALSE(settings.any());
  settings = {1, 1, 1, 1, 1};
  EXPECT_TRUE(settings.any());
  ContactData data = elastic();
  settings.put({}, data);
  EXPECT_EQ(data.stiffness, 1e5);
  EXPECT_EQ(data.loss, loss_factor(0.8));
  EXPECT_EQ(data.dynamic_coefficient, 0.3);
  EXPECT_EQ(settings.restitution_at({}, 0.7), 0.7);
}

TEST(ContactSettings, TakesTheValuesOfItsPlaces) {
  const ContactSettings settings{1, 2, 3, 4, 5};
  const std::vector<double> signals = {9.0, 2e5, 0.5, 30.0, 0.6, 0.2};
  ContactData data = elastic();
  settings.put(signals, data);
  EXPECT_EQ(data.stiffness, 2e5);
  EXPECT_EQ(data.loss, loss_factor(0.5));
  EXPECT_EQ(data.damping, 30.0);
  EXPECT_EQ(data.static_coefficient, 0.6);
  EXPECT_EQ(data.dynamic_coefficient, 0.2);
  EXPECT_EQ(settings.restitution_at(signals, 0.9), 0.5);
}

TEST(ContactSettings, KeepsWithinWhatALawAdmits) {
  const ContactSettings settings{1, 2, 3, 4, 0};
  const std::vector<double> signals = {9.0, -2e5, -0.5, -30.0, 0.1};
  ContactData data = elastic();
  settings.put(signals, data);
  EXPECT_EQ(data.stiffness, 0.0);
  EXPECT_EQ(data.loss, loss_factor(kLeastElasticRestitution));
  EXPECT_EQ(data.damping, 0.0);
  EXPECT_EQ(data.dynamic_coefficient, 0.1);  // of 0.3, not above that of sticking
  EXPECT_EQ(settings.restitution_at(signals, 0.9), 0.0);
  ContactFrictionData friction{0.4, 0.3, 0.0, 0.0};
  settings.put(signals, friction);
  EXPECT_EQ(friction.static_coefficient, 0.1);
  EXPECT_EQ(friction.dynamic_coefficient, 0.1);
}

TEST(ContactSettings, AStopReturnsWhatComesFasterThanItsThreshold) {
  const spatial::RigidTouch touch{spatial::RigidTouch::Data{}};
  ContactSettings settings;
  settings.restitution = 1;
  const ContactStop stop(touch, 0.8, 0.1, settings);
  const std::vector<double> signals = {9.0, 0.5};
  EXPECT_EQ(stop.restitution(1.0, {}), 0.8);
  EXPECT_EQ(stop.restitution(1.0, signals), 0.5);
  EXPECT_EQ(stop.restitution(0.05, signals), 0.0);
}

}  // namespace
}  // namespace buckens::loads
