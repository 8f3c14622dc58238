// SPDX-License-Identifier: Apache-2.0
// No bit of what is made of all elements depends on the number of threads.
#include <gtest/gtest.h>

#include "buckens/base/allowed_threads.h"
#include "buckens/base/errors.h"
#include "buckens/fem/assembly/assemble.h"
#include "buckens/fem/solid/recovery.h"
#include "buckens/fem/solid/strains.h"
#include "buckens/fem/test/shell_fixture.h"
#include "buckens/fem/test/solid_fixture.h"
#include "buckens/linalg/same_bits.h"

namespace buckens::fem::test {
namespace {

Material damped_steel_of_threads() {
  Material material = steel();
  material.damping_stiffness = 1e-4;
  return material;
}

/// 3993 variables, 1000 elements in eight pieces.
Structure large_box() {
  Structure s;
  add_box(s, {{0, 0, 0}, {0.4, 0.3, 0.2}, {10, 10, 10}}, damped_steel_of_threads(),
          SolidForm::usual(SolidKind::hex8));
  distort(s, 0.002);
  return s;
}

FeModel assembled_by(int threads, const Structure& structure) {
  const base::AllowedThreads allowed(threads);
  return assemble(structure);
}

void expect_same_bits(const FeModel& found, const FeModel& expected) {
  EXPECT_TRUE(linalg::have_same_bits(found.M.copied(), expected.M.copied()));
  EXPECT_TRUE(linalg::have_same_bits(found.K.copied(), expected.K.copied()));
  EXPECT_TRUE(linalg::have_same_bits(found.K_damping.copied(), expected.K_damping.copied()));
  const ShapeIntegrals& shape = found.shape;
  EXPECT_EQ(shape.mass, expected.shape.mass);
  EXPECT_EQ(shape.com, expected.shape.com);
  EXPECT_EQ(shape.C0, expected.shape.C0);
  EXPECT_EQ(shape.J0, expected.shape.J0);
  EXPECT_EQ(shape.c, expected.shape.c);
  for (std::size_t k = 0; k < shape.W.size(); ++k) {
    EXPECT_TRUE(linalg::have_same_bits(shape.W[k], expected.shape.W[k])) << k;
  }
}

void expect_the_same_by_threads(const Structure& structure) {
  const FeModel alone = assembled_by(1, structure);
  ASSERT_GE(alone.dofs.num_dofs, 3000);  // smaller meshes wake no threads
  const linalg::Vector d = linalg::Vector::LinSpaced(alone.dofs.num_dofs, -1.0, 2.0).array().sin();
  const linalg::Matrix stresses = SolidRecovery(alone).stresses(d);
  for (const int threads : {2, 3}) {
    SCOPED_TRACE(threads);
    expect_same_bits(assembled_by(threads, structure), alone);
    const base::AllowedThreads allowed(threads);
    EXPECT_EQ(SolidRecovery(alone).stresses(d, base::AllowedThreads::pool()), stresses);
  }
}

TEST(AssemblyThreads, SolidsAreTheSame) { expect_the_same_by_threads(large_box()); }

TEST(AssemblyThreads, ShellsAreTheSame) {
  expect_the_same_by_threads(twisted_shells(damped_steel_of_threads()));
}

TEST(AssemblyThreads, KindsOfElementsBesideEachOtherAreTheSame) {
  Structure s = large_box();
  const int tip = add_node(s, "tip", {0.9, 0.1, 0.3});
  const int foot = add_node(s, "foot", {0.5, 0.1, 0.3});
  add_beam(s, foot, tip, 3, beam_properties(BeamTheory::timoshenko, true));
  for (const int node : {0, 5, 40}) s.bars.add(node, foot, steel(), Section::circle(0.01));
  s.masses.add(tip, 0.4);
  expect_the_same_by_threads(s);
}

TEST(AssemblyThreads, StrainsAreTheSame) {
  const FeModel fe = assemble(large_box());
  std::vector<int> nodes, elements;
  for (int k = 0; k < 1331; k += 2) nodes.push_back(k);
  for (int k = 0; k < 1000; k += 3) elements.push_back(k);
  const SolidStrains strains(fe, nodes, elements);
  const linalg::Vector d = linalg::Vector::LinSpaced(fe.dofs.num_dofs, -1.0, 2.0).array().sin();
  TensorColumns at_places, at_elements, stress_at_places, stress_at_elements;
  strains.evaluate(d, at_places, at_elements);
  strains.stresses(at_places, at_elements, stress_at_places, stress_at_elements);
  TaskPool pool(3);
  TensorColumns places, centres, of_places, of_centres;
  strains.evaluate(d, places, centres, &pool);
  strains.stresses(places, centres, of_places, of_centres, &pool);
  EXPECT_EQ(places, at_places);
  EXPECT_EQ(centres, at_elements);
  EXPECT_EQ(of_places, stress_at_places);
  EXPECT_EQ(of_centres, stress_at_elements);
}

std::string refusal(int threads, const Structure& structure) {
  try {
    (void)assembled_by(threads, structure);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "";
}

TEST(AssemblyThreads, FaultsAreToldAsByOneThread) {
  Structure s = large_box();
  for (const std::size_t node : {700U, 1200U}) s.nodes[node].position.x() += 0.3;
  const std::string alone = refusal(1, s);
  EXPECT_NE(alone.find("inverted or flat, and so are"), std::string::npos) << alone;
  EXPECT_EQ(refusal(3, s), alone);
}

}  // namespace
}  // namespace buckens::fem::test
