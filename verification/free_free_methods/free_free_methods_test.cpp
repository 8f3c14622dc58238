// SPDX-License-Identifier: Apache-2.0
// Every method of free vibration gives the tabulated frequencies; see README.md.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "buckens/base/test/source_directory.h"
#include "buckens/body/free_free_modes.h"
#include "buckens/fem/assembly/assemble.h"
#include "buckens/fem/mesh/box_mesh.h"

namespace buckens::verification::free_free_methods {
namespace {

using body::FreeModeMethod;
using nlohmann::json;

json read(const std::string& path) {
  std::ifstream file(std::string(buckens::test::kSourceDirectory) + "/verification/" + path);
  return json::parse(file);
}

body::FlexiblePart beam(const json& params, int divisions) {
  fem::Structure structure;
  fem::add_node(structure, "start", {0, 0, 0});
  fem::add_node(structure, "end", {params["L"], 0, 0});
  fem::add_beam(
      structure, 0, 1, divisions,
      fem::BeamProperties::of(fem::Material::isotropic(params["E"], params["nu"], params["rho"]),
                              fem::Section::rectangle(params["h"], params["b"]),
                              fem::BeamTheory::euler_bernoulli));
  return {"beam", fem::assemble(structure), body::CouplingLevel::full};
}

body::FlexiblePart block_of_case(const json& given) {
  fem::Box box;
  for (std::size_t k = 0; k < 3; ++k) {
    box.size[static_cast<Eigen::Index>(k)] = given["L"][k];
    box.divisions[k] = given["mesh"][k];
  }
  fem::Structure structure;
  fem::add_box(structure, box, fem::Material::isotropic(given["E"], given["nu"], given["rho"]));
  return {"block", fem::assemble(structure), body::CouplingLevel::full};
}

/// All tabulated frequencies of a beam in ascending order, as far as no kind of motion ends.
std::vector<double> lowest_of(const json& kinds, int divisions) {
  std::vector<double> all;
  double complete = 1e300;
  for (const auto& [kind, values] : kinds.items()) {
    if (!values.is_array()) continue;
    const std::vector<double> own = values.get<std::vector<double>>();
    all.insert(all.end(), own.begin(), own.end());
    const bool bends = kind.starts_with("bending");
    if (static_cast<int>(own.size()) < (bends ? 2 * divisions : divisions)) {
      complete = std::min(complete, own.back());
    }
  }
  std::sort(all.begin(), all.end());
  all.erase(std::upper_bound(all.begin(), all.end(), complete), all.end());
  return all;
}

void expect_frequencies(const body::FlexiblePart& part, FreeModeMethod method,
                        const std::vector<double>& expected, double tolerance) {
  const auto modes =
      body::free_free_modes(part, {.count = static_cast<int>(expected.size()), .method = method});
  ASSERT_EQ(modes.omega.size(), static_cast<Eigen::Index>(expected.size()));
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const double found = modes.omega[static_cast<Eigen::Index>(k)] / (2 * M_PI);
    EXPECT_NEAR(found, expected[k], tolerance * expected[k]) << "mode " << k + 1;
  }
}

class FreeFreeMethods : public testing::TestWithParam<FreeModeMethod> {};

TEST_P(FreeFreeMethods, BeamsOf1To16Elements) {
  const json reference = read("free_free_beam/reference.json");
  for (const int n : {1, 2, 3, 4, 8, 16}) {
    SCOPED_TRACE(n);
    const std::vector<double> expected = lowest_of(reference["FE_Hz"]["n" + std::to_string(n)], n);
    ASSERT_GE(expected.size(), n == 1 ? 6U : 10U);
    // Rounding of the assembled K: ε (ω_max/ω)² ≤ 3e-10 at n = 16.
    expect_frequencies(beam(reference["params"], n), GetParam(), expected, 1e-9);
  }
}

TEST_P(FreeFreeMethods, BlocksOfSolidsWithSevenfoldFrequencies) {
  const json reference = read("free_free_methods/reference.json");
  for (const auto& [name, given] : reference["blocks"].items()) {
    SCOPED_TRACE(name);
    // All 18 of the cube: 2, 5, 3, 1, 7 equal ones. Rounding of K: 1e-14.
    expect_frequencies(block_of_case(given), GetParam(),
                       given["freq_Hz"].get<std::vector<double>>(), 1e-10);
  }
}

INSTANTIATE_TEST_SUITE_P(All, FreeFreeMethods,
                         testing::Values(FreeModeMethod::subspace, FreeModeMethod::augmented,
                                         FreeModeMethod::penalty, FreeModeMethod::spectra,
                                         FreeModeMethod::dense),
                         [](const auto& method) { return body::to_string(method.param); });

// A square column of cubes: bending in pairs, beyond the dense limit.
TEST(FreeFreePairs, SquareColumnOfSolidsHasAllItsPairs) {
  fem::Structure structure;
  fem::Box box;
  box.size = {0.1, 0.1, 0.8};
  box.divisions = {3, 3, 12};
  fem::add_box(structure, box, fem::Material::isotropic(2.1e11, 0.3, 7850.0));
  const body::FlexiblePart part("column", fem::assemble(structure), body::CouplingLevel::full);
  const auto all =
      body::free_free_modes(part, {.count = 30, .method = FreeModeMethod::dense, .judge = false});
  for (const int count : {7, 12, 30}) {
    const auto modes = body::free_free_modes(part, count);
    ASSERT_EQ(modes.method, FreeModeMethod::subspace);
    ASSERT_EQ(modes.omega.size(), count);
    for (Eigen::Index k = 0; k < count; ++k) {
      // Rounding of K, ε (ω_max/ω)² = 1e-12.
      EXPECT_NEAR(modes.omega[k], all.omega[k], 1e-10 * all.omega[k]) << count << ": " << k;
    }
  }
  EXPECT_NEAR(all.omega[0], all.omega[1], 1e-10 * all.omega[0]);  // the first pair of bending
}

}  // namespace
}  // namespace buckens::verification::free_free_methods
