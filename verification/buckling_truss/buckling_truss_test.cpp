// SPDX-License-Identifier: Apache-2.0
// Load at which the bars of a shallow truss buckle; see README.md.
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "buckens/analysis/statics/path.h"
#include "buckens/base/test/source_directory.h"
#include "buckens/model_file/model_file.h"
#include "buckens/results/table.h"

namespace buckens::verification::buckling_truss {
namespace {

constexpr double kB = 1.0, kH = 0.2, kEA = 2e5, kEI = 100.0;  // those of the example
constexpr double kFullLoad = 1000.0;                          // N at factor one

/// Load at which both straight bars buckle. The bar force P acts on the shortened bar, so that
/// P (1 − P/EA) = π² EI/L0² in place of Euler's load.
double buckling_load() {
  const double L0 = std::hypot(kB, kH);
  const double euler = std::numbers::pi * std::numbers::pi * kEI / (L0 * L0);
  const double P = 0.5 * kEA * (1.0 - std::sqrt(1.0 - 4.0 * euler / kEA));
  const double L = L0 * (1.0 - P / kEA);
  return 2.0 * P * std::sqrt(L * L - kB * kB) / L;
}

results::RunSummary trace(const std::vector<std::string>& overrides) {
  const auto built = model::build_model(
      model_file::read_model_file(std::string(buckens::test::kSourceDirectory) +
                                      "/examples/snap_through_bending/snap_through_bending.yaml",
                                  overrides));
  results::Table table;
  return analysis::trace_static_path(*built, table);
}

/// Load of the first bifurcation of the truss without lateral loads [N].
double found_load(int elements) {
  const auto summary = trace({"parameters.bow=0", fmt::format("parameters.n={}", elements),
                              "static.load-factor=[0, 0.45]"});
  const auto& points = summary.static_path->critical_points;
  EXPECT_EQ(points.size(), 1U);
  EXPECT_EQ(points.at(0).kind, "bifurcation");
  return kFullLoad * points.at(0).load_factor;
}

TEST(BucklingTruss, ConvergesToTheBucklingLoadWithTheSquareOfTheNumberOfFrames) {
  const double exact = buckling_load();
  const double coarse = found_load(4) / exact - 1.0;
  const double middle = found_load(8) / exact - 1.0;
  const double fine = found_load(16) / exact - 1.0;
  RecordProperty("errors", fmt::format("{:.3g} {:.3g} {:.3g}", coarse, middle, fine));
  EXPECT_LT(std::abs(fine), 3e-3);
  // Terms of fourth order are a few hundredths with four frames.
  EXPECT_NEAR(std::log2(coarse / middle), 2.0, 0.1);
  EXPECT_NEAR(std::log2(middle / fine), 2.0, 0.03);
}

}  // namespace
}  // namespace buckens::verification::buckling_truss
