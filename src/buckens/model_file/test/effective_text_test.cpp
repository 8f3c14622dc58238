// SPDX-License-Identifier: Apache-2.0
#include "buckens/model_file/effective_text.h"

#include <gtest/gtest.h>

#include "buckens/model_file/overrides.h"

namespace buckens::model_file {
namespace {

std::string after(const std::string& text, const std::vector<std::string>& overrides) {
  const YamlNode before = parse_yaml(text, "model.yaml");
  YamlNode changed = before;
  apply_overrides(changed, overrides);
  const std::string out = effective_text(text, before, changed);
  EXPECT_TRUE(same_content(parse_yaml(out, "again.yaml"), changed)) << out;
  return out;
}

constexpr char kText[] = R"(# What it is
buckens: 1
title: "A rod: long"   # a title
parameters: {L: 300 mm, n: 4}

bodies:
  # the only one
  rod:
    beam: {to: [L, 0, 0], elements: n, section: {circle: {diameter: 6 mm}}, material: steel}

    coupling: none     # for speed

# How far
simulation:
  duration: 1 s  # long
  step: 1 ms
# the end
)";

TEST(EffectiveText, KeepsWhatIsNotChangedAsItIsWritten) {
  EXPECT_EQ(after(kText, {}), kText);
  std::string wanted = kText;
  wanted.replace(wanted.find("  step: 1 ms"), 12, "  step: 0.1 ms");
  EXPECT_EQ(after(kText, {"simulation.step=0.1 ms"}), wanted);
}

TEST(EffectiveText, WritesChangedEntriesAnew) {
  const std::string out =
      after(kText, {"bodies.rod.beam.elements=2*n", "parameters.L=0.5 m", "title=Other",
                    "bodies.rod.coupling=full", "gravity=[0, -1, 0]", "simulation.rho-inf=0.9"});
  EXPECT_NE(out.find("title: Other\n"), out.npos);
  EXPECT_NE(out.find("parameters: {L: 0.5 m, n: 4}\n\nbodies:\n  # the only one\n"), out.npos);
  EXPECT_NE(out.find("elements: 2*n, section: {circle: {diameter: 6 mm}}"), out.npos);
  EXPECT_NE(out.find("    coupling: full\n\n# How far\n"), out.npos);
  EXPECT_NE(out.find("  step: 1 ms\n# the end\n  rho-inf: 0.9\ngravity: [0, -1, 0]\n"), out.npos)
      << out;
}

TEST(EffectiveText, KeepsTextsThatBracketsWouldBreak) {
  const std::string out =
      after("buckens: 1\nloads:\n  push: {force: {on: a/b, value: 1}}\n",
            {"loads.push={force: {on: a/b, value: [0, \"max(1,2) N\", 't: \"quoted\" \\']}}"});
  EXPECT_NE(out.find("\"max(1,2) N\", \"t: \\\"quoted\\\" \\\\\""), out.npos) << out;
  after("buckens: 1\nparameters:\n  a: 1\n  b: max(1,2)\n", {"parameters.a=max(2,3)"});
  after("buckens: 1\nparameters: \n  a: 1\n", {"parameters={a: 1, b: 'x, y', c: ~, d: []}"});
}

TEST(EffectiveText, CopesWithAnyLayout) {
  after("{\"buckens\": 1, \"parameters\": {\"a\": 1, \"b\": \"2\"}}", {"parameters.a=3"});
  after("{\n  \"buckens\": 1,\n  \"parameters\": {\n    \"a\": 1,\n    \"b\": 2\n  }\n}\n",
        {"parameters.a=3"});
  after("buckens: 1\nparameters: {\n  a: 1,\n  b: 2\n}\n", {"parameters.b=3"});
  after("? buckens\n: 1\n? parameters\n: {a: 1}\n", {"parameters.a=3"});
  after("buckens: 1\r\nparameters:\r\n  a: 1\r\n  b: 2", {"parameters.b=3", "title=\"x\""});
  after("---\nbuckens: 1\nparameters: {a: 1}\n...\n", {"parameters.a=3"});
  after("buckens: 1\ntitle: >\n  folded\n  # no comment\nparameters: {a: 1}\n", {"parameters.a=3"});
  after("buckens: 1\ntitle: >\n  folded\n  # no comment\nparameters: {a: 1}\n", {"title=other"});
  after("buckens: 1\nparameters:\n  größe: 1\n  \"a b\": 2\n", {"parameters.größe=3"});
  after(
      "buckens: 1\nbodies:\n  a:\n    structure:\n      beams:\n      - nodes: [a, b]\n"
      "        section: x\n",
      {"bodies.a.structure.beams.0.section=y"});
  after("buckens: 1\nbodies:\n  a:\n", {"bodies.a={rigid: {mass: 1}}"});
}

TEST(EffectiveText, EveryTreeCanBeWritten) {
  const YamlNode root = parse_yaml(kText, "model.yaml");
  EXPECT_TRUE(same_content(parse_yaml(yaml_text(root), "again.yaml"), root)) << yaml_text(root);
}

}  // namespace
}  // namespace buckens::model_file
