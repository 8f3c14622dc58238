// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/vibration/strain_energy_groups.h"

#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/fem/line/beam_block.h"

namespace buckens::analysis {
namespace {

/// Solids that count how often their stiffness is formed.
class CountedSolids final : public fem::ElementBlock {
 public:
  mutable int formed = 0;

  int num_elements() const override { return 1; }
  std::span<const int> nodes(int /*element*/) const override { return {}; }
  bool is_line() const override { return false; }
  bool is_solid() const override { return true; }
  bool has_rotations() const override { return false; }
  const fem::Material* material(int /*element*/) const override { return nullptr; }
  const fem::Section* section(int /*element*/) const override { return nullptr; }
  void check(const fem::MeshView& /*mesh*/) const override {}
  void add_mass(const std::vector<fem::Node>& /*nodes*/, fem::MassMoment& /*sum*/) const override {}
  void add_inertia(const fem::MeshView& /*mesh*/, const Eigen::Vector3d& /*com*/,
                   fem::InertiaSum& /*sum*/) const override {}
  void add_stiffness(const fem::MeshView& /*mesh*/, fem::StiffnessSum& /*sum*/) const override {
    ++formed;
  }
  void add_force_rows(const fem::MeshView& /*mesh*/, int /*first_element*/,
                      std::vector<linalg::Triplet>& /*rows*/) const override {}
  fem::PointRows point_rows(const fem::MeshView& /*mesh*/, int /*element*/,
                            double /*xi*/) const override {
    return {};
  }
};

TEST(StrainEnergyGroups, OfABodyOfSolidsNeedNoSecondStiffness) {
  const auto solids = std::make_shared<CountedSolids>();
  fem::FeModel fe;
  fe.dofs.num_dofs = 1;
  // Models have a block of each kind, most of them empty.
  fe.blocks = {std::make_shared<fem::BeamBlock>(), solids};
  linalg::SparseMatrix K(1, 1);
  K.insert(0, 0) = 1.0;
  fe.K = K;
  const StrainEnergyGroups groups(fe);
  EXPECT_EQ(groups.names(), std::vector<std::string>{"solids"});
  EXPECT_EQ(groups.shares(linalg::Vector::Ones(1)), std::vector<double>{1.0});
  EXPECT_EQ(solids->formed, 0);
}

}  // namespace
}  // namespace buckens::analysis
