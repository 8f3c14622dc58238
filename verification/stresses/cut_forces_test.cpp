// SPDX-License-Identifier: Apache-2.0
// Nodal forces over cuts of a mesh against joint forces, and stresses integrated over them.
#include <cmath>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "buckens/analysis/simulation/simulate.h"
#include "buckens/fem/assembly/assemble.h"
#include "buckens/fem/constraint/node_region.h"
#include "buckens/fem/solid/block.h"
#include "buckens/model_file/model_file.h"
#include "buckens/results/table.h"

namespace buckens::verification::stresses {
namespace {

using Eigen::Matrix3Xd;
using Eigen::Vector3d;

constexpr double kLength = 1.0, kRho = 7850.0;
// So small that deformations change no lever arm by more than rounding.
const Vector3d kGravity(1e-9, -2e-9, 0.5e-9);
const Vector3d kPull(3e-6, 1e-6, -2e-6);

/// A cantilever that carries its weight and a force at its tip, clamped at an interface.
std::string model_text(const std::string& element, int divisions) {
  return fmt::format(R"(
buckens: 1
gravity: [1e-9, -2e-9, 0.5e-9]
bodies:
  bar:
    mesh:
      box: {{from: [0, -50 mm, -50 mm], size: [1 m, 0.1 m, 0.1 m], divisions: [{0}, {1}, {1}], element: {2}}}
      material: {{E: 210 GPa, nu: 0.3, rho: 7850 kg/m^3}}
    interfaces: {{root: {{face: x0}}, tip: {{face: x1}}}}
joints: {{wall: {{fixed: {{between: [ground, bar/root]}}}}}}
loads: {{pull: {{force: {{on: bar/tip, value: [3e-6, 1e-6, -2e-6]}}}}}}
initial: {{start: static}}
simulation: {{duration: 1 ms, step: 1 ms}}
output: {{every: 1 ms, fields: [stress]}}
)",
                     8 * divisions, 2 * divisions, element);
}

struct Resultant {
  Vector3d force = Vector3d::Zero();
  Vector3d moment = Vector3d::Zero();  // about the model origin
};

/// A cantilever in static equilibrium.
class Cantilever {
 public:
  Cantilever(const std::string& element, int divisions)
      : built_(model::build_model(
            model_file::read_model_text(model_text(element, divisions), "bar.yaml"))) {
    analysis::simulate(*built_, table_);
    const Eigen::VectorXd values = table_.values("bodies/bar/displacement").row(0);
    displacement_ = values.reshaped(6, values.size() / 6).topRows<3>();
  }

  const fem::FeModel& mesh() const { return built_->model.bodies[0].flexible->mesh(); }

  const fem::SolidBlock& solids() const {
    for (const auto& block : mesh().blocks) {
      if (const auto* own = dynamic_cast<const fem::SolidBlock*>(block.get())) return *own;
    }
    throw std::logic_error("the bar has no solids");
  }

  /// Nodal forces that the part x < cut exerts on the part beyond, as the difference of elastic and
  /// weight forces of the elements beyond; they act at the nodes of the cut only.
  Resultant cut_force(double cut) const {
    const fem::SolidBlock& elements = solids();
    std::vector<int> beyond, number(mesh().nodes.size(), -1), nodes;
    fem::Structure part;
    for (int e = 0; e < elements.num_elements(); ++e) {
      if (elements.positions(mesh().nodes, e).row(0).mean() < cut) continue;
      beyond.push_back(e);
      for (const int node : elements.nodes(e)) {
        int& known = number[static_cast<std::size_t>(node)];
        if (known >= 0) continue;
        known = static_cast<int>(nodes.size());
        nodes.push_back(node);
        part.nodes.push_back(mesh().nodes[static_cast<std::size_t>(node)]);
      }
    }
    part.solids = elements.subset(beyond, number);
    const fem::FeModel fe = fem::assemble(part, std::nullopt);
    linalg::Vector d(fe.dofs.num_dofs), g(fe.dofs.num_dofs);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      d.segment<3>(fe.dofs.node_dofs[k][0]) = displacement_.col(nodes[k]);
      g.segment<3>(fe.dofs.node_dofs[k][0]) = kGravity;
    }
    const linalg::Vector f = fe.K * d - fe.M * g;
    Resultant out;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const Vector3d& at = part.nodes[k].position;
      if (std::abs(at.x() - cut) > 1e-9) continue;
      const Vector3d force = f.segment<3>(fe.dofs.node_dofs[k][0]);
      out.force += force;
      out.moment += at.cross(force);
    }
    return out;
  }

  /// Joint force and torque on the bar, less what acts on x < cut.
  Resultant expected(double cut) const {
    const double mass = kRho * 0.01 * cut;
    Resultant out;
    out.force = table_.values("joints/wall/force").row(0).transpose() + mass * kGravity;
    out.moment = table_.values("joints/wall/torque").row(0).transpose() +
                 Vector3d(0.5 * cut, 0, 0).cross(mass * kGravity);
    return out;
  }

  /// ∫ σ n dA over the cut from the stresses recorded at nodes, on the part beyond.
  Vector3d integrated(double cut) const {
    const Eigen::VectorXd values = table_.field_values("fields/bodies/bar/nodes/stress").row(0);
    const Eigen::MatrixXd stress = values.reshaped(6, values.size() / 6);
    const fem::SolidBlock& elements = solids();
    Vector3d out = Vector3d::Zero();
    for (int e = 0; e < elements.num_elements(); ++e) {
      const fem::NodeVectors x = elements.positions(mesh().nodes, e);
      if (x.row(0).mean() < cut || x.row(0).minCoeff() < cut - 1e-9) continue;
      if (x.row(0).minCoeff() > cut + 1e-9) continue;
      const auto& topology = fem::solid_topology(elements.form(e).kind);
      for (int face = 0; face < static_cast<int>(topology.faces.size()); ++face) {
        const auto integrals = fem::face_integrals(elements, mesh().nodes, {e, face});
        const bool is_cut =
            std::all_of(integrals.nodes.begin(), integrals.nodes.end(), [&](int node) {
              return std::abs(mesh().nodes[static_cast<std::size_t>(node)].position.x() - cut) <
                     1e-9;
            });
        if (!is_cut) continue;
        for (std::size_t k = 0; k < integrals.nodes.size(); ++k) {
          const auto s = stress.col(integrals.nodes[k]);
          // The outward normal of the part beyond is −x.
          out -= integrals.area[static_cast<Eigen::Index>(k)] * Vector3d(s[0], s[3], s[5]);
        }
      }
    }
    return out;
  }

 private:
  std::unique_ptr<model::BuiltModel> built_;
  results::Table table_;
  Matrix3Xd displacement_;
};

class CutForces : public testing::TestWithParam<const char*> {};

TEST_P(CutForces, OfNodesAreThoseOfTheJoint) {
  const Cantilever bar(GetParam(), 1);
  const Resultant wall = bar.expected(0.0);
  // The joint carries all: a check of what follows.
  const Vector3d all = -kPull - kRho * 0.01 * kLength * kGravity;
  EXPECT_LT((wall.force - all).norm(), 1e-9 * all.norm());
  for (const double cut : {0.125, 0.5, 0.875}) {
    const Resultant expected = bar.expected(cut);
    const Resultant found = bar.cut_force(cut);
    // Nodal forces are differences of stiff numbers: ε E b ‖d‖/F with ‖d‖ the bending deflection is
    // 1e-11; a digit each for the sums and the joint iteration.
    EXPECT_LT((found.force - expected.force).norm(), 1e-9 * wall.force.norm()) << cut;
    EXPECT_LT((found.moment - expected.moment).norm(), 1e-9 * wall.moment.norm()) << cut;
  }
}

/// Stresses averaged at nodes and interpolated over the cut carry what the nodal forces carry: with
/// tetrahedra but for an error of second order, with regular hexahedra exactly, because the errors
/// of the elements on both sides of the cut are opposite there.
TEST_P(CutForces, OfStressesConvergeToThem) {
  const auto error = [](int divisions) {
    const Cantilever bar(GetParam(), divisions);
    const Vector3d expected = bar.expected(0.5).force;
    return (bar.integrated(0.5) - expected).norm() / expected.norm();
  };
  const double coarse = error(1);
  const double fine = error(2);
  if (std::string(GetParam()).starts_with("hex")) {
    EXPECT_LT(std::max(coarse, fine), 1e-9) << "as the nodal forces";
    return;
  }
  EXPECT_GT(coarse / fine, 3.2) << "a fifth below the factor 4 of the theory";
  EXPECT_LT(fine, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Elements, CutForces, testing::Values("hex8", "hex20", "tet10"),
                         [](const auto& element) { return std::string(element.param); });

}  // namespace
}  // namespace buckens::verification::stresses
