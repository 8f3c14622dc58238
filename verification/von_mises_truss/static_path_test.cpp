// SPDX-License-Identifier: Apache-2.0
// The static path of the two-bar truss through both limit points; see README.md.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "verification/von_mises_truss/truss.h"

#include "buckens/analysis/statics/path.h"
#include "buckens/model_file/model_file.h"
#include "buckens/results/table.h"

namespace buckens::verification::von_mises_truss {
namespace {

struct Path {
  std::vector<double> w, F;
  results::RunSummary summary;
};

/// @param settings of `static`, @param reference load at factor one [N]
Path trace(const Truss& truss, const std::string& settings, double reference, int bars = 1) {
  const auto built = model::build_model(model_file::read_model_text(
      fmt::format("{}loads: {{push: {{force: {{on: left/apex, value: [0, {:.17g}, 0]}}}}}}\n"
                  "static: {{{}}}\noutput: {{{}}}\n",
                  truss.model(bars), -reference, settings, Truss::sensor()),
      "truss.yaml"));
  results::Table table;
  Path out;
  out.summary = analysis::trace_static_path(*built, table);
  const Eigen::MatrixXd w = table.values("sensors/w");
  const Eigen::MatrixXd factor = table.values("sensors/load-factor");
  for (Eigen::Index k = 0; k < w.rows(); ++k) {
    out.w.push_back(w(k, 0));
    out.F.push_back(reference * factor(k, 0));
  }
  return out;
}

class TrussPath : public testing::TestWithParam<const char*> {};

TEST_P(TrussPath, LiesOnTheClosedFormThroughBothLimitPoints) {
  const Truss truss(GetParam());
  const Path path = trace(truss, "steps: 20", 1.5 * truss.F_crit);
  EXPECT_TRUE(path.summary.finished);
  double last_error = 0.0;
  for (std::size_t k = 0; k < path.w.size(); ++k) {
    // Newton converges to rounding of the largest bar force; 1e-9 is required.
    last_error = std::max(last_error, std::abs(path.F[k] - truss.force(path.w[k])));
  }
  EXPECT_LT(last_error, 1e-9 * truss.F_crit);
  RecordProperty("force_error", fmt::format("{:.2g} F_crit", last_error / truss.F_crit));
  EXPECT_NEAR(path.F.back(), 1.5 * truss.F_crit, 1e-12 * truss.F_crit);
  EXPECT_GT(path.w.back(), 2.0 * truss.H);  // snapped through
}

TEST_P(TrussPath, ReportsTheLimitPoints) {
  const Truss truss(GetParam());
  const double reference = 1.5 * truss.F_crit;
  const Path path = trace(truss, "steps: 20", reference);
  const auto& points = path.summary.static_path->critical_points;
  ASSERT_EQ(points.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    const double sign = k == 0 ? 1.0 : -1.0;
    EXPECT_EQ(points[k].kind, "limit point");
    // The load is stationary there: an error of 1e-7 of the place makes 1e-14 of the load.
    EXPECT_NEAR(points[k].load_factor * reference, sign * truss.F_crit, 1e-10 * truss.F_crit);
    const double w = k == 0 ? truss.w_crit : 2.0 * truss.H - truss.w_crit;
    double found = 0.0;
    for (const auto& [name, value] : points[k].sensors) {
      if (name == "w") found = value;
    }
    EXPECT_NEAR(found, w, 1e-7 * truss.H);
  }
}

TEST_P(TrussPath, DoesNotDependOnTheStepLength) {
  const Truss truss(GetParam());
  for (const char* step : {"arc-step: 0.2", "arc-step: 0.005"}) {
    SCOPED_TRACE(step);
    const Path path = trace(truss, step, 1.5 * truss.F_crit);
    EXPECT_TRUE(path.summary.finished);
    EXPECT_EQ(path.summary.static_path->critical_points.size(), 2U);
    for (std::size_t k = 0; k < path.w.size(); ++k) {
      EXPECT_NEAR(path.F[k], truss.force(path.w[k]), 1e-9 * truss.F_crit);
    }
  }
}

TEST_P(TrussPath, OfLoadControlEndsBelowTheLimitPoint) {
  const Truss truss(GetParam());
  const Path path = trace(truss, "method: load", 0.999 * truss.F_crit);
  EXPECT_TRUE(path.summary.finished);
  for (std::size_t k = 0; k < path.w.size(); ++k) {
    EXPECT_NEAR(path.F[k], truss.force(path.w[k]), 1e-9 * truss.F_crit);
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, TrussPath, testing::Values("A", "C"));

}  // namespace
}  // namespace buckens::verification::von_mises_truss
