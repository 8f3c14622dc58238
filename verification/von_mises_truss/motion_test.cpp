// SPDX-License-Identifier: Apache-2.0
// Dynamic snap-through of the two-bar truss; see README.md.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "verification/von_mises_truss/truss.h"

#include "buckens/analysis/simulation/simulate.h"
#include "buckens/model_file/model_file.h"
#include "buckens/results/table.h"

namespace buckens::verification::von_mises_truss {
namespace {

constexpr std::array<int, 2> kBars = {1, 2};
// All levels in the reference; what each neglects: docs/theory/08-coupling.md.
constexpr std::array<const char*, 7> kVariants = {"full",   "none",   "nocent",        "nocor",
                                                  "nojvar", "noquad", "no_cent_no_cor"};

/// One of the tabulated runs.
struct Snap {
  const char* truss;    // "A", "C"
  int bars;             // per member
  const char* variant;  // of the coupling, as the reference names it
  int rate;             // N/s
};

std::string name_of(const Snap& run) {
  return fmt::format("{}_n{}_{}_{}", run.truss, run.bars, run.variant, run.rate);
}

const nlohmann::json& table_of(const Snap& run) {
  return truss_reference()[run.truss]["dyn"][fmt::format("Fdot_{}", run.rate)];
}

/// The coupling as the model file names it.
std::string coupling(const std::string& variant) {
  if (variant == "no_cent_no_cor") return "{drop: [cent0, cent1, cor-ref, cor-fe]}";
  return variant;
}

/// w at the tabulated times with `steps` steps between two of them.
std::vector<double> motion(const Snap& run, int steps) {
  const std::vector<double> t = table_of(run)["t"];
  const auto built = model::build_model(model_file::read_model_text(
      fmt::format(
          "{}loads: {{push: {{force: {{on: left/apex, value: [0, \"-{}*t\", 0]}}}}}}\n"
          "simulation: {{duration: {:.17g}, step: {:.17g}}}\noutput: {{every: {:.17g}, {}}}\n",
          Truss(run.truss).model(run.bars, coupling(run.variant)), run.rate, t.back(), t[1] / steps,
          t[1], Truss::sensor()),
      "truss.yaml"));
  results::Table table;
  EXPECT_TRUE(analysis::simulate(*built, table).finished);
  const Eigen::MatrixXd w = table.values("sensors/w");
  EXPECT_EQ(w.rows(), static_cast<Eigen::Index>(t.size()));
  return {w.data(), w.data() + w.rows()};
}

double error(const Snap& run, const std::vector<double>& w) {
  const std::vector<double> exact = table_of(run)[fmt::format("n{}_{}", run.bars, run.variant)];
  double largest = 0.0;
  for (std::size_t k = 0; k < exact.size(); ++k) {
    largest = std::max(largest, std::abs(w[k] - exact[k]));
  }
  return largest;
}

/// The limit of a method of order two.
std::vector<double> extrapolated(const std::vector<double>& coarse,
                                 const std::vector<double>& fine) {
  std::vector<double> out(fine.size());
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = (4.0 * fine[k] - coarse[k]) / 3.0;
  return out;
}

class TrussMotion : public testing::TestWithParam<Snap> {};

TEST_P(TrussMotion, ConvergesToTheTableWithTheSquareOfTheStep) {
  const Snap run = GetParam();
  // The slowest load takes ten times as long, over more vibrations.
  const int steps = run.rate == 1000 ? 200 : 100;
  const std::vector<double> coarse = motion(run, steps);
  const std::vector<double> fine = motion(run, 2 * steps);
  const double e_fine = error(run, fine);
  const double e_limit = error(run, extrapolated(coarse, fine));
  RecordProperty("errors", fmt::format("{:.2g} {:.2g}", e_fine, e_limit));
  // Terms of fourth order, large where the load is slow and vibrations are many.
  EXPECT_NEAR(error(run, coarse) / e_fine, 4.0, run.rate == 1000 ? 0.2 : 0.1);
  EXPECT_LT(e_limit, run.rate == 1000 ? 1e-5 : 1e-7);
}

std::vector<Snap> all_runs() {
  std::vector<Snap> out;
  for (const char* truss : {"A", "C"}) {
    for (const int bars : kBars) {
      for (const char* variant : kVariants) {
        for (const int rate : {1000, 5000, 10000}) out.push_back({truss, bars, variant, rate});
      }
    }
  }
  return out;
}

INSTANTIATE_TEST_SUITE_P(Runs, TrussMotion, testing::ValuesIn(all_runs()),
                         [](const auto& run) { return name_of(run.param); });

class TrussMotionDirectly : public testing::TestWithParam<Snap> {};

TEST_P(TrussMotionDirectly, IsTheTableToATenthOfAMicrometre) {
  const Snap run = GetParam();
  // 40 intervals: steps of 4.9 µs (A) and 9.6 µs (C), with errors of 7e-8 m at most.
  const double e = error(run, motion(run, run.truss == std::string("A") ? 600 : 400));
  RecordProperty("error", fmt::format("{:.2g}", e));
  EXPECT_LT(e, 1e-7);
}

std::vector<Snap> fast_runs() {
  std::vector<Snap> out;
  for (const int bars : kBars) {
    for (const char* variant : kVariants) out.push_back({"C", bars, variant, 10000});
    for (const char* variant : {"full", "none"}) out.push_back({"A", bars, variant, 10000});
  }
  return out;
}

INSTANTIATE_TEST_SUITE_P(Runs, TrussMotionDirectly, testing::ValuesIn(fast_runs()),
                         [](const auto& run) { return name_of(run.param); });

}  // namespace
}  // namespace buckens::verification::von_mises_truss
