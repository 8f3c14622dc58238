// SPDX-License-Identifier: Apache-2.0
// Free blocks of solids vibrate at the tabulated frequencies; see README.md.
#include <cmath>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "buckens/analysis/vibration/body_vibration.h"
#include "buckens/base/test/source_directory.h"
#include "buckens/model/build/build_model.h"
#include "buckens/model_file/model_file.h"

namespace buckens::verification::free_free_hex8 {
namespace {

const std::string kFolder =
    std::string(buckens::test::kSourceDirectory) + "/verification/free_free_hex8/";

/// Compares every tabulated frequency with those that `buckens modes` finds.
void expect_frequencies(const std::string& model, const std::string& name) {
  std::ifstream file(kFolder + "reference.json");
  const auto known = nlohmann::json::parse(file)["hex8"][name];
  const auto built = model::build_model(model_file::read_model_file(kFolder + model, {}));
  body::FreeModesSettings settings;
  settings.count = static_cast<int>(known["freq_Hz"].size());
  const analysis::VibrationReport report = analysis::free_body_vibrations(*built, 0, settings);
  EXPECT_EQ(report.rigid_modes, 6);
  EXPECT_NEAR(report.mass, known["mass"], 1e-13 * report.mass);
  ASSERT_EQ(report.vibrations.size(), known["freq_Hz"].size());
  for (std::size_t k = 0; k < report.vibrations.size(); ++k) {
    const double frequency = known["freq_Hz"][k];
    // Asked for. Rounding of K allows ε (ω_max/ω)² < 1e-12.
    EXPECT_NEAR(report.vibrations[k].frequency, frequency, 1e-10 * frequency) << name << " " << k;
  }
}

TEST(FreeFreeHex8, BlockOfEightElements) { expect_frequencies("block.yaml", "A_4x2x1"); }

TEST(FreeFreeHex8, CubeOfOneElementWithMultipleFrequencies) {
  expect_frequencies("cube.yaml", "C_1elem_cube");
}

}  // namespace
}  // namespace buckens::verification::free_free_hex8
