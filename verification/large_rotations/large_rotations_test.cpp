// SPDX-License-Identifier: Apache-2.0
// Statics of slender beams that turn by far more than a frame may bend; see README.md.
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "buckens/analysis/statics/path.h"
#include "buckens/model_file/model_file.h"
#include "buckens/results/table.h"

namespace buckens::verification::large_rotations {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

std::string point(const Vector3d& p) {
  return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", p.x(), p.y(), p.z());
}

/// A clamped chain of one-element beams between the points, each a body with its own frame.
std::string chain(const std::vector<Vector3d>& points) {
  std::string bodies;
  std::string joints = "  clamp: {fixed: {between: [ground, b0/start]}}\n";
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    bodies += fmt::format(
        "  b{}: {{beam: {{from: {}, to: {}, elements: 1, section: square, material: soft}}}}\n", k,
        point(points[k]), point(points[k + 1]));
    if (k == 0) continue;
    joints += fmt::format("  j{}: {{fixed: {{between: [b{}/end, b{}/start]}}}}\n", k, k - 1, k);
  }
  return fmt::format("bodies:\n{}joints:\n{}", bodies, joints);
}

struct Traced {
  results::Table table;
  results::RunSummary summary;
};

std::unique_ptr<Traced> traced_run(const std::string& text) {
  auto out = std::make_unique<Traced>();
  const auto built = model::build_model(model_file::read_model_text(text, "chain.yaml"));
  out->summary = analysis::trace_static_path(*built, out->table);
  return out;
}

Vector3d last_row(const Eigen::MatrixXd& values) {
  return values.row(values.rows() - 1).transpose();
}

/// A straight beam under the end moment 2πEI/L that bends it to a circle.
struct Circle {
  double gap = 0;     // of the tip from the clamp, over L
  double middle = 0;  // error of the middle's place (0, L/π), over L
  results::RunSummary summary;
};

Circle circle(int frames) {
  const double L = 1.0;
  const double EI = 1e4 / 12 * 1e-4;
  std::vector<Vector3d> points;
  for (int k = 0; k <= frames; ++k) points.emplace_back(L * k / frames, 0, 0);
  const auto traced = traced_run(fmt::format(
      R"(buckens: 1
planar: xy
materials: {{soft: {{E: 1e4, nu: 0, rho: 1}}}}
sections: {{square: {{general: {{A: 1, Iy: {0:.17g}, Iz: {0:.17g}, J: 1e-4}}}}}}
{1}loads:
  bend: {{torque: {{on: b{2}/end, value: [0, 0, {3:.17g}]}}}}
static: {{steps: 10, arc-step: 1}}
output: {{sensors: {{tip: {{position: b{2}/end}}, middle: {{position: b{4}/end}}}}}}
)",
      EI / 1e4, chain(points), frames - 1, 2 * pi * EI / L, frames / 2 - 1));
  EXPECT_TRUE(traced->summary.finished);
  return {last_row(traced->table.values("sensors/tip")).norm() / L,
          (last_row(traced->table.values("sensors/middle")) - Vector3d(0, L / pi, 0)).norm() / L,
          traced->summary};
}

TEST(Circle, ClosesAndIsRoundWithTheSquareOfTheNumberOfFrames) {
  const Circle coarse = circle(16);
  const Circle middle = circle(32);
  const Circle fine = circle(64);
  // Equal frames under one moment form a regular polygon, which closes to rounding; its size is
  // that of a polygon with chords of L/n, off by π²/(6n²).
  EXPECT_LT(fine.gap, 1e-12);
  EXPECT_LT(fine.middle, 1e-3);
  EXPECT_NEAR(fine.middle, pi / (6.0 * 64 * 64), 1e-2 * fine.middle);
  // Terms of fourth order are below a hundredth at a turn of 0.4 rad per frame.
  EXPECT_NEAR(std::log2(coarse.middle / middle.middle), 2.0, 0.02);
  EXPECT_NEAR(std::log2(middle.middle / fine.middle), 2.0, 0.005);
  EXPECT_EQ(fine.summary.trust, std::vector<std::string>{});  // no frame bends by 0.1 rad
  RecordProperty("middle_64", fmt::format("{:.3g} L", fine.middle));
}

// Bathe and Bolourchi 1979: the 45-degree bend of radius 100 and unit square section.
TEST(Bend, ReachesThePublishedTip) {
  const double R = 100.0;
  for (const int frames : {8, 16}) {
    std::vector<Vector3d> points;
    for (int k = 0; k <= frames; ++k) {
      const double phi = 0.25 * pi * k / frames;
      points.emplace_back(R * std::sin(phi), R * (1 - std::cos(phi)), 0);
    }
    const auto traced = traced_run(fmt::format(
        R"(buckens: 1
materials: {{soft: {{E: 1e7, nu: 0, rho: 1}}}}
sections: {{square: {{general: {{A: 1, Iy: 8.3333333333333333e-2, Iz: 8.3333333333333333e-2, J: 0.140577}}}}}}
{0}loads:
  lift: {{force: {{on: b{1}/end, value: [0, 0, 600]}}}}
static: {{steps: 6, arc-step: 0.5}}
output: {{sensors: {{tip: {{displacement: b{1}/end}}}}}}
)",
        chain(points), frames - 1));
    EXPECT_TRUE(traced->summary.finished);
    const Vector3d tip = last_row(traced->table.values("sensors/tip"));
    const Vector3d published(-23.82, -13.73, 53.61);
    SCOPED_TRACE(testing::Message() << frames << " frames: " << tip.transpose());
    // The spread of published results; 8, 16 and 32 frames differ by 0.03 and 0.007.
    for (Eigen::Index k = 0; k < 3; ++k) EXPECT_NEAR(tip[k], published[k], 0.05);
    // Newton with all geometric terms of the tangent.
    EXPECT_LE(traced->summary.newton_iterations.max, 4);
    EXPECT_EQ(traced->summary.trust.empty(), frames == 16);  // 8 bend by 0.16 rad
  }
}

}  // namespace
}  // namespace buckens::verification::large_rotations
