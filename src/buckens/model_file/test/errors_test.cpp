// SPDX-License-Identifier: Apache-2.0
#include "buckens/base/errors.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/model_file/model_file.h"

namespace buckens::model_file {
namespace {

using testing::HasSubstr;

std::string message(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    read_model_text(text, "m.yaml", overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no InputError";
}

/// A bad text and the expected message.
struct Bad {
  std::string text;
  std::vector<std::string> words;
};

void expect_messages(const std::vector<Bad>& cases, const std::string& before = "",
                     const std::string& after = "") {
  for (const Bad& bad : cases) {
    const std::string text = message(before + bad.text + after);
    for (const std::string& word : bad.words) EXPECT_THAT(text, HasSubstr(word)) << bad.text;
  }
}

TEST(ModelFileErrors, Files) {
  expect_messages({
      {"", {"m.yaml: the model file is empty"}},
      {"\n# only a comment\n", {"empty"}},
      {"hello", {"m.yaml:1:1", "found \"hello\""}},
      {"- 1", {"found a list"}},
      {"buckens: 1\n", {"the key \"bodies\" is missing"}},
      {"buckens: 2\nbodies: {}", {"m.yaml:1:10: buckens: this program reads format 1, not 2"}},
      {"buckens: 1\nbodies: {}", {"at least one body"}},
      {"buckens: 1\nbodies:\n", {"found no value"}},
      {"buckens: 1\nbodis: {}", {"m.yaml:2:1: unknown key \"bodis\"", "Did you mean \"bodies\"?"}},
  });
}

TEST(ModelFileErrors, YamlThatIsNotWhatItSeems) {
  expect_messages(
      {
          {"{a: {rigid: {mass: 1}}\n",
           {"m.yaml:2:9: the bracket { that opens here is not closed; add }"}},
          {"\"abc", {"YAML syntax"}},
          {"{a: {rigid: {mass: 1, mass: 2}}}",
           {"m.yaml:2:31", "\"mass\" appears twice, first at m.yaml:2:22"}},
          {"{a: {rigid: {mass: 1}}, a: {rigid: {mass: 1}}}", {"appears twice"}},
          {"{a: &x {rigid: {mass: 1}}, b: *x}", {"m.yaml:2:13: anchors and aliases"}},
          {"{a: {<<: {rigid: {mass: 1}}}}", {"merge keys"}},
          {"{a: {rigid: {mass: !!float 1}}}", {"tag", "is not supported"}},
          {"{a: {rigid: {mass: 1}}}\n---\nx: 1\n", {"second document"}},
          {"{a: {rigid: {[1]: 1}}}", {"a key must be a word"}},
          {"\"\xff\"", {"m.yaml:2:10: byte 0xFF is not UTF-8"}},
          {std::string("a\0b", 3), {"byte 0x00"}},
      },
      "buckens: 1\nbodies: ");
}

TEST(ModelFileErrors, Numbers) {
  expect_messages(
      {
          {"-0.36 kg", {"m.yaml:2:28: bodies.a.rigid.mass: -0.36 kg", "must not be negative"}},
          {"3 m", {"\"3 m\" is a length; expected a mass such as 0.36 kg"}},
          {"3 kgg", {"unknown unit \"kgg\"", "Did you mean \"kg\"?"}},
          {"3 kg/m s", {"unknown unit \"kg/m s\"", "kg/m/s"}},
          {"010", {"octal", "write 10"}},
          {"-007.5", {"octal"}},
          {"0x10", {"0x10"}},
          {"yes", {"\"yes\" is not a number"}},
          {"on", {"\"on\" is not a number"}},
          {"true", {"is not a number"}},
          {".nan", {"is not a number"}},
          {".inf", {"is not a number"}},
          {"1e999", {"1e999"}},
          {"1/0", {"has the value inf", "division by zero?"}},
          {"0/0", {"expression \"0/0\" has the value"}},
          {"sqrt(-1)", {"has the value"}},
          {"1e200*1e200", {"has the value inf"}},
          {"\"1,5 kg\"", {"decimals are written 1.5"}},
          {"''", {"found an empty text"}},
          {"", {"found no value"}},
          {"[1]", {"found a list"}},
          {"{a: 1}", {"found a map"}},
          {"2*Lenght", {"unknown name \"Lenght\"", "Did you mean \"Length\"?"}},
      },
      "buckens: 1\nbodies: {a: {rigid: {mass: ", "}}}\nparameters: {Length: 1}\n");
}

TEST(ModelFileErrors, Bodies) {
  const std::string steel = "material: {E: 1, rho: 1}, section: {circle: {diameter: 6 mm}}";
  expect_messages(
      {
          {"{rigd: {mass: 1}}", {"unknown key \"rigd\" in bodies.a. Did you mean \"rigid\"?"}},
          {"{at: {}}",
           {"one of these keys is missing: rigid, beam, structure, mesh, geometry, matrices, "
            "like"}},
          {"{rigid: {mass: 1}, like: b}", {"only one of these keys can be"}},
          {"{rigid: {mas: 1}}", {"unknown key \"mas\" in bodies.a.rigid"}},
          {"{rigid: {}}", {"the key \"mass\" is missing; add it, for example mass: 0.36 kg"}},
          {"{rigid: {mass: 1, com: [1, 2]}}", {"a list of 2 values", "list of 3 values"}},
          {"{rigid: {mass: 1, inertia: [1, 1, 5]}}", {"exceeds the sum of the other two"}},
          {"{rigid: {mass: 1, inertia: [1, 1, -5]}}", {"none can be negative"}},
          {"{rigid: {mass: 1, inertia: [1, 1, 1, 5, 0, 0]}}", {"none can be negative"}},
          {"{rigid: {mass: 1, inertia: [1, 1]}}", {"expected 3 values", "or 6"}},
          {"{rigid: {mass: 1}, coupling: ful}", {"Did you mean \"full\"?"}},
          {"{rigid: {mass: 1}, geometric-stiffness: on}", {"a rigid body has no stiffness"}},
          {"{rigid: {mass: 1}, frames: 2}", {"a rigid body has one frame"}},
          {"{rigid: {mass: 1}, frames: per-node}", {"\"per-node\" is not a number of frames"}},
          {"{rigid: {mass: 1}, damping: {mass: 1}}", {"has no material damping"}},
          {"{rigid: {mass: 1}, markers: {com: {at: origin}}}", {"\"com\" is taken"}},
          {"{rigid: {mass: 1}, markers: {q: {at: end}}}", {"body \"a\" has no place \"end\""}},
          {"{rigid: {mass: 1}, markers: {q: {}}}", {"exactly one of the keys position and at"}},
          {"{rigid: {mass: 1}, markers: {q/r: {at: com}}}", {"cannot be a name"}},
          {"{rigid: {mass: 1}, at: {orientation: {axis: [1, 0, 0]}}}", {"belong together"}},
          {"{rigid: {mass: 1}, at: {orientation: {}}}", {"in exactly one form"}},
          {"{like: nix}", {"unknown body \"nix\""}},
          {"{beam: {to: [0, 0, 0], " + steel + "}}", {"bodies.a.beam.to", "zero length"}},
          {"{beam: {to: [1, 0, 0], elements: 0, " + steel + "}}", {"must be positive"}},
          {"{beam: {to: [1, 0, 0], elements: 2.5, " + steel + "}}", {"not a whole number"}},
          {"{beam: {to: [1, 0, 0], up: [2, 0, 0], " + steel + "}}", {"parallel to the beam"}},
          {"{beam: {to: [1, 0, 0], masses: [{at: middle, mass: 1}], " + steel + "}}",
           {"unknown point \"middle\""}},
          {"{beam: {to: [1, 0, 0], elements: 3, masses: [{at: mid, mass: 1}], " + steel + "}}",
           {"even number of elements"}},
          {"{beam: {to: [1, 0, 0], material: stel, section: {circle: {diameter: 1}}}}",
           {"unknown material \"stel\"", "Did you mean \"steel\"?"}},
          {"{beam: {to: [1, 0, 0], material: steel, section: nix}}", {"unknown section \"nix\""}},
          {"{beam: {to: [1, 0, 0], material: steel, section: {tube: {outer-diameter: 6 mm, "
           "thickness: 4 mm}}}}",
           {"thickness", "inner diameter would be -0.002 m"}},
          {"{beam: {to: [1, 0, 0], material: steel, section: {box: {width: 1, height: 1, "
           "thickness: 1}}}}",
           {"thicker than half"}},
          {"{structure: {nodes: {a: [0, 0, 0]}}}", {"needs beams, bars, solids or shells"}},
          {"{structure: {nodes: {a: [0, 0, 0]}, bars: [{between: [a, b], area: 1, material: "
           "steel}]}}",
           {"bars.0.between: unknown node \"b\""}},
          {"{structure: {nodes: {a: [0, 0, 0], b: [0, 0, 0]}, beams: [{between: [a, b], " + steel +
               "}]}}",
           {"beams.0.between", "zero length"}},
      },
      "buckens: 1\nmaterials: {steel: {E: 1, rho: 7}}\nbodies: {a: ", "}\n");
  EXPECT_THAT(message("buckens: 1\nbodies: {ground: {rigid: {mass: 1}}}"), HasSubstr("the fixed"));
  EXPECT_THAT(message("buckens: 1\nmaterials: {s: {E: 1, rho: -7 kg/m^3}}\nbodies: {}"),
              HasSubstr("materials.s.rho: -7 kg/m^3 is not allowed"));
  EXPECT_THAT(message("buckens: 1\nmaterials: {s: {E: 1, rho: 1, damping: {ratio: 2 %}}}\n"),
              HasSubstr("belong together"));
}

TEST(ModelFileErrors, Reduction) {
  expect_messages(
      {
          {"{rigid: {mass: 1}, reduction: {free-free: 4}}", {"reduction", "rigid"}},
          {"{rigid: {mass: 1}, flexibility: quasi-static}", {"flexibility", "rigid"}},
          {"{rigid: {mass: 1}, reduction: {free-free: 0}}", {"free-free", "positive", "0"}},
          {"{rigid: {mass: 1}, reduction: {free-free: {modes: -2}}}", {"modes", "-2"}},
          {"{rigid: {mass: 1}, reduction: {free-free: 2, craig-bampton: 3}}", {"one basis"}},
          {"{rigid: {mass: 1}, reduction: {craig-bampton: {}}}", {"modes", "cutoff"}},
          {"{rigid: {mass: 1}, reduction: {file: a.h5}}", {"reduction.file", "no basis"}},
      },
      "buckens: 1\nbodies: {a: ", "}\n");
}

TEST(ModelFileErrors, Solids) {
  const std::string unit = "box: {size: [1, 1, 1], divisions: [1, 1, 1]";
  const std::string nodes =
      "nodes: {a: [0, 0, 0], b: [1, 0, 0], c: [1, 1, 0], d: [0, 1, 0], e: [0, 0, 1], f: [1, 0, 1], "
      "g: [1, 1, 1], h: [0, 1, 1]}";
  expect_messages(
      {
          {"{mesh: {material: m}}", {"bodies.a.mesh: one of these keys is missing: box"}},
          {"{mesh: {box: {divisions: [1, 1, 1]}, material: m}}", {"the key \"size\" is missing"}},
          {"{mesh: {box: {size: [1, 1, 1]}, material: m}}", {"\"divisions\" is missing"}},
          {"{mesh: {" + unit + "}}}", {"the key \"material\" is missing"}},
          {"{mesh: {box: {size: [1, 0, 1], divisions: [1, 1, 1]}, material: m}}",
           {"bodies.a.mesh.box.size.1", "0", "must be positive"}},
          {"{mesh: {box: {size: [1 m, 1 kg, 1], divisions: [1, 1, 1]}, material: m}}",
           {"\"1 kg\" is a mass"}},
          {"{mesh: {box: {size: [1, 1, 1], divisions: [4, 0, 1]}, material: m}}",
           {"bodies.a.mesh.box.divisions.1", "must be positive"}},
          {"{mesh: {box: {size: [1, 1, 1], divisions: [4, 1]}, material: m}}",
           {"a list of 2 values", "list of 3 values such as [110, 2, 2]"}},
          {"{mesh: {box: {size: [1, 1, 1], divisions: [30000, 30000, 2]}, material: m}}",
           {"bodies.a.mesh: these are 1.8e+09 elements", "use fewer"}},
          {"{mesh: {" + unit + ", element: hex9}, material: m}}", {"Did you mean \"hex8\"?"}},
          {"{mesh: {" + unit + ", integration: ful}, material: m}}", {"Did you mean \"full\"?"}},
          {"{mesh: {" + unit + "}, material: nix}}", {"unknown material \"nix\""}},
          {"{mesh: {" + unit + "}, material: m, masses: [{at: centre, mass: 1}]}}",
           {"bodies.a.mesh.masses.0.at: unknown node \"centre\""}},
          {"{mesh: {" + unit + "}, material: m}, geometric-stiffness: on}",
           {"bodies.a.geometric-stiffness", "remove the key"}},
          {"{structure: {" + nodes +
               ", solids: [{nodes: [a, b, c, d, e, f, g, h], material: m}]}, "
               "geometric-stiffness: on}",
           {"bodies.a.geometric-stiffness", "remove the key"}},
          {"{mesh: {" + unit + "}, material: m}, markers: {corner_000: {at: node_last}}}",
           {"\"corner_000\" is taken"}},
          {"{mesh: {" + unit + "}, material: m}, markers: {q: {at: corner_002}}}",
           {"no place \"corner_002\"", "corner_00"}},
          {"{structure: {" + nodes + ", solids: [{nodes: [a, b, c, d], material: m}]}}",
           {"solids.0.nodes: a hex8 has 8 nodes, found 4"}},
          {"{structure: {" + nodes + ", solids: [{nodes: [a, b, c, d, e, f, g, i], material: m}]}}",
           {"solids.0.nodes: unknown node \"i\""}},
          {"{structure: {" + nodes + ", solids: [{nodes: [a, b, c, d, e, f, g, a], material: m}]}}",
           {"node \"a\" appears twice"}},
          {"{structure: {" + nodes + ", solids: [{nodes: [a, b, c, d, e, f, g, h]}]}}",
           {"solids.0: the key \"material\" is missing"}},
      },
      "buckens: 1\nmaterials: {m: {E: 1, rho: 7}}\nbodies: {a: ", "}\n");
}

TEST(ModelFileErrors, KindsOfSolids) {
  const std::string unit = "box: {size: [1, 1, 1], divisions: [1, 1, 1]";
  const std::string bar = "cylinder: {to: [1, 0, 0], diameter: 0.1, divisions: ";
  const std::string tube = "tube: {to: [1, 0, 0], outer-diameter: 0.1, inner-diameter: ";
  const std::string disc = "disc: {diameter: 0.1, thickness: 0.01, ";
  expect_messages(
      {
          {"{" + unit + ", element: tet10, integration: incompatible-modes}",
           {"a.mesh.box.integration", "only hex8 has incompatible modes", "write `full`"}},
          {"{cylinder: {diameter: 0.1, to: [0, 0, 0], divisions: [1, 8, 2]}",
           {"a.mesh.cylinder.to", "the same point"}},
          {"{" + bar + "[1, 10, 2]}", {"cylinder.divisions.1", "divisible by 4, for example 12"}},
          {"{" + bar + "[1, 3, 2]}", {"too few for a round part", "at least 4"}},
          {"{" + bar + "[0, 8, 2]}", {"cylinder.divisions.0", "must be positive"}},
          {"{" + bar + "[1, 8, 2], element: hex20, integration: incompatible-modes}",
           {"cylinder.integration"}},
          {"{" + bar + "[1000, 4000, 4000]}", {"these are 2e+10 elements", "use fewer"}},
          {"{" + tube + "0.1, divisions: [1, 8, 2]}",
           {"tube.inner-diameter", "less than the outer diameter"}},
          {"{" + tube + "0.05, divisions: [1, 2, 2]}", {"tube.divisions.1"}},
          {"{" + disc + "axis: [0, 0, 0], divisions: [1, 8, 1]}", {"disc.axis", "cannot be zero"}},
          {"{" + disc + "bore: 0.2, divisions: [1, 8, 1]}",
           {"disc.bore", "less than the diameter"}},
          {"{" + disc + "divisions: [1, 9, 1]}", {"disc.divisions.1", "divisible by 4"}},
      },
      "buckens: 1\nmaterials: {m: {E: 1, rho: 7}}\nbodies: {a: {mesh: ", ", material: m}}}\n");
  EXPECT_THAT(message("buckens: 1\nmaterials: {m: {E: 1, rho: 7}}\nbodies: {a: {structure: {nodes: "
                      "{a: [0, 0, 0], b: [1, 0, 0], c: [0, 1, 0]}, solids: [{element: tet4, nodes: "
                      "[a, b, c], material: m}]}}}"),
              HasSubstr("a tet4 has 4 nodes, found 3"));
}

TEST(ModelFileErrors, OrthotropicMaterials) {
  const std::string shear = "G12: 5e9, G13: 5e9, G23: 3e9";
  const std::string rest = "nu13: 0.3, nu23: 0.4, " + shear;
  expect_messages(
      {
          {"", {"the key \"E\" is missing", "E: 200 GPa"}},
          {", E: 1, orthotropic: {E1: 135e9, E2: 1e10, E3: 1e10, nu12: 0.3, " + rest + "}",
           {"materials.m.orthotropic", "replace \"E\""}},
          {", orthotropic: {E1: 135e9, E3: 1e10, nu12: 0.3, " + rest + "}", {"\"E2\" is missing"}},
          {", orthotropic: {E1: 135e9, E2: 1e10, E3: 1e10, nu12: 4, " + rest + "}",
           {"|nu12| must be below sqrt(E1/E2) = 3.674"}},
          {", orthotropic: {axis-2: [2, 0, 0], E1: 135e9, E2: 1e10, E3: 1e10, nu12: 0.3, " + rest +
               "}",
           {"axis-2", "parallel to \"axis-1\""}},
          {", orthotropic: {axis-1: [0, 0, 0], E1: 135e9, E2: 1e10, E3: 1e10, nu12: 0.3, " + rest +
               "}",
           {"axis-1", "cannot be zero"}},
      },
      "buckens: 1\nmaterials: {m: {rho: 7", "}}\nbodies: {}\n");
}

TEST(ModelFileErrors, Interfaces) {
  const std::string unit = "box: {size: [1, 1, 1], divisions: [1, 1, 1]";
  expect_messages(
      {
          {"{mesh: {" + unit + "}, material: m}, interfaces: {q: {kind: rigid}}}",
           {"interfaces.q: one of these keys is missing: face, set, sphere, box, cylinder, plane"}},
          {"{mesh: {" + unit + "}, material: m}, interfaces: {q: {face: x0, set: [centre]}}}",
           {"only one of these keys"}},
          {"{mesh: {" + unit + "}, material: m}, interfaces: {q: {face: x0, kind: stiff}}}",
           {"interfaces.q.kind", "rigid"}},
          {"{mesh: {" + unit + "}, material: m}, interfaces: {corner_000: {face: x0}}}",
           {"bodies.a.interfaces.corner_000: the name \"corner_000\" is taken"}},
          {"{mesh: {" + unit +
               "}, material: m}, markers: {q: {at: com}}, interfaces: {q: {face: x0}}}",
           {"the name \"q\" is taken"}},
          {"{rigid: {mass: 1}, interfaces: {q: {face: x0}}}",
           {"a rigid body has no mesh and no interfaces"}},
          {"{mesh: {" + unit +
               "}, material: m}, interfaces: {q: {cylinder: {from: [1, 1, 1], to: [1, 1, 1], "
               "radius: 1}}}}",
           {"interfaces.q.cylinder.to", "zero length"}},
          {"{mesh: {" + unit +
               "}, material: m}, interfaces: {q: {plane: {point: [1, 1, 1], normal: [0, 0, 0]}}}}",
           {"interfaces.q.plane.normal", "cannot be [0, 0, 0]"}},
          {"{mesh: {" + unit +
               "}, material: m}, interfaces: {q: {sphere: {center: [1, 1, 1], radius: -1}}}}",
           {"interfaces.q.sphere.radius", "negative"}},
      },
      "buckens: 1\nmaterials: {m: {E: 1, rho: 7}}\nbodies: {a: ", "}\n");
}

TEST(ModelFileErrors, Coupling) {
  expect_messages(
      {
          {"{rigid: {mass: 1}, coupling: first-ordr}", {"Did you mean \"first-order\"?"}},
          {"{rigid: {mass: 1}, coupling: {drop: [cent2]}}", {"Did you mean \"cent0\"?"}},
          {"{rigid: {mass: 1}, coupling: {drop: cent0}}", {"expected a list"}},
          {"{rigid: {mass: 1}, coupling: {level: auto, drop: [jvar]}}",
           {"chooses the terms itself"}},
          {"{rigid: {mass: 1}, coupling: {level: auto, tolerance: 200 %}}", {"below 100 %"}},
          {"{rigid: {mass: 1}, coupling: {level: auto, tolerance: 0}}", {"must be positive"}},
      },
      "buckens: 1\nbodies: {a: ", "}\n");
}

const char* const kTwoBodies =
    "buckens: 1\n"
    "bodies:\n"
    "  rod: {beam: {to: [1,0,0], section: {circle: {diameter: 6 mm}}, material: {E: 1, rho: 1}}}\n"
    "  box: {rigid: {mass: 1}}\n";

TEST(ModelFileErrors, Joints) {
  expect_messages(
      {
          {"{fixed: {between: [ground, rodd]}}",
           {"m.yaml:5:40", "unknown body \"rodd\". Did you mean \"rod\"?"}},
          {"{fixed: {between: [ground, rod/edn]}}",
           {"body \"rod\" has no marker \"edn\". Did you mean \"end\"?"}},
          {"{fixed: {between: [ground/a, rod]}}", {"the ground has no markers"}},
          {"{fixed: {between: [{ground: [1, 2]}, rod]}}", {"three coordinates"}},
          {"{fixed: {between: [ground]}}", {"list of 2 values"}},
          {"{fixed: {between: [rod/start, rod/end]}}", {"on the same body"}},
          {"{fixd: {between: [rod, box]}}", {"Did you mean \"fixed\"?"}},
          {"{revolute: {between: [rod, box]}}", {"\"axis\" is missing; a model in space"}},
          {"{revolute: {between: [rod, box], axis: [0, 0, 0]}}", {"cannot be [0, 0, 0]"}},
          {"{prismatic: {between: [rod, box]}}", {"the key \"axis\" is missing"}},
          {"{prescribed-rotation: {between: [rod, box], axis: [0, 0, 1], angle: 150*x}}",
           {"unknown name \"x\""}},
          {"{prescribed-rotation: {between: [rod, box], axis: [0, 0, 1], angle: 150*t mm}}",
           {"\"150*t mm\" is a length; expected an angle"}},
          {"{prescribed-rotation: {between: [rod, box], axis: [0, 0, 1], angle: 150*t/0}}",
           {"has the value", "at t = 0"}},
          {"{prescribed-rotation: {between: [rod, box], axis: [0, 0, 1], angle: {table: [[0, 1], "
           "[0, 2]]}}}",
           {"the times of a table must increase"}},
          {"{prescribed-rotation: {between: [rod, box], axis: [0, 0, 1], angle: {table: [[0, 1]], "
           "unit: mm}}}",
           {"\"mm\" is not a unit of an angle"}},
          {"{prescribed-rotation: {between: [rod, box], axis: [0, 0, 1], angle: {}}}",
           {"exactly one of the keys table and file"}},
      },
      std::string(kTwoBodies) + "joints: {j: ", "}\n");
}

TEST(ModelFileErrors, LoadsInitialSimulationOutput) {
  expect_messages(
      {
          {"loads: {f: {force: {on: ground, value: [0, 0, 0]}}}", {"has no effect"}},
          {"loads: {f: {force: {on: box, value: 3}}}", {"list of 3 values"}},
          {"loads: {f: {force: {on: box, value: [0, 0, 0], axes: fix}}}", {"must be one of fixed"}},
          {"loads: {f: {spring-damper: {between: [box, rod], stiffness: -1}}}",
           {"not be negative"}},
          {"loads: {f: {spring-damper: {between: [box, box]}}}", {"the same marker"}},
          {"initial: {bodies: {bx: {velocity: [0, 0, 0]}}}", {"Did you mean \"box\"?"}},
          {"initial: {bodies: {box: {angular-velocity: [0, 0, 50 Hz]}}}",
           {"\"50 Hz\" is a frequency", "2*pi*50 rad/s"}},
          {"initial: {bodies: {box: {nodal-velocity: {x: 1}}}}", {"is rigid"}},
          {"initial: {preload: yes}", {"expected true or false, found \"yes\""}},
          {"simulation: {duration: 1 s, step: 0 s}", {"simulation.step: 0 s", "must be positive"}},
          {"simulation: {duration: -1 s, step: 1 ms}", {"must be positive"}},
          {"simulation: {duration: 1 ms, step: 1 s}", {"longer than the duration"}},
          {"simulation: {duration: 1 s, step: 1e-15}", {"steps exceed the range"}},
          {"simulation: {duration: 1 s}", {"the key \"step\" is missing"}},
          {"simulation: {duration: 1 s, setp: 1 ms}", {"Did you mean \"step\"?"}},
          {"simulation: {duration: 1 s, step: 1 ms, projection: yes}", {"expected on or off"}},
          {"simulation: {duration: 1 s, step: 1 ms, rho-inf: 1.2}", {"between 0 and 1"}},
          {"simulation: {duration: 1 s, step: 1 ms, method: houbolt}",
           {"must be one of", "wilson"}},
          {"simulation: {duration: 1 s, step: 1 ms, method: wilson, theta: 1.3}",
           {"simulation.theta", "at least 1.366", "not 1.3", "amplifies"}},
          {"simulation: {duration: 1 s, step: 1 ms, theta: 1.4}",
           {"simulation.theta", "belongs to `method: wilson`", "generalized-alpha"}},
          {"simulation: {duration: 1 s, step: 1 ms, method: hht, alpha: -0.4}",
           {"simulation.alpha", "between -1/3 and 0", "-0.4"}},
          {"simulation: {duration: 1 s, step: 1 ms, method: hht, alpha: 0.1}", {"-1/3 and 0"}},
          {"simulation: {duration: 1 s, step: 1 ms, method: newmark, alpha: -0.1}",
           {"belongs to `method: hht`", "newmark"}},
          {"simulation: {duration: 1 s, step: atuo}", {"simulation.step", "atuo"}},
          {"simulation: {duration: 1 s, step: auto, tolerance: 0}", {"must be positive"}},
          {"simulation: {duration: 1 s, step: auto, tolerance: 2}", {"swamp the motion"}},
          {"simulation: {duration: 1 s, step: auto, tolerance: 1e-16}", {"rounding", "1e-13"}},
          {"simulation: {duration: 1 s, step: auto, absolute-tolerance: -1}", {"be positive"}},
          {"output: {sensors: {a: {joint-force: x}}}", {"unknown joint \"x\""}},
          {"output: {sensors: {a: {deflection: box}}}", {"not on a flexible body"}},
          {"output: {sensors: {a: {stress: box}}}", {"not on a flexible body"}},
          {"output: {sensors: {a: {energy: totl}}}", {"Did you mean \"total\"?"}},
          {"output: {sensors: {a: {relative: {between: [rod, box], quantity: angle}}}}",
           {"\"axis\" is missing"}},
          {"output: {sensors: {a b: {energy: total}}}", {"cannot be a name"}},
          {"parameters: {t: 1}", {"has a meaning in expressions"}},
          {"parameters: {a-b: 1}", {"cannot be used in expressions"}},
          {"parameters: {a: b, b: 1}", {"unknown name \"b\""}},
      },
      kTwoBodies, "\n");
  EXPECT_THROW(read_model_text(std::string(kTwoBodies) + "loads: {f: {force: {on: box, value: "
                                                         "[{file: nix.csv}, 0, 0]}}}",
                               "m.yaml"),
               IoError);
}

TEST(ModelFileErrors, Overrides) {
  const auto set = [](const std::string& assignment) { return message(kTwoBodies, {assignment}); };
  EXPECT_THAT(
      set("bodies.rodd.beam.elements=8"),
      HasSubstr("--set bodies.rodd.beam.elements: the model file has no \"rodd\" in bodies. "
                "Did you mean \"rod\"?"));
  EXPECT_THAT(set("bodies.rod.beam.elemnts=8"), HasSubstr("Did you mean \"elements\"?"));
  EXPECT_THAT(set("bodis.rod=8"), HasSubstr("unknown key \"bodis\". Did you mean \"bodies\"?"));
  EXPECT_THAT(set("parameters.L=3"), HasSubstr("has no \"L\" in parameters, and no value uses"));
  EXPECT_THAT(set("bodies.rod.beam.elements=-8"), HasSubstr("must be positive"));
  EXPECT_THAT(set("bodies.rod.beam.elements"), HasSubstr("write PATH=VALUE"));
  EXPECT_THAT(set("bodies.rod.beam.elements="), HasSubstr("is missing"));
  EXPECT_THAT(set("bodies.rod.beam.to.7=1"), HasSubstr("not an item of bodies.rod.beam.to"));
  EXPECT_THAT(set("bodies.rod.beam.to.0.x=1"), HasSubstr("nothing below"));
  EXPECT_THAT(set("simulation.step=1 mm"), HasSubstr("the key \"duration\" is missing"));
  EXPECT_THAT(set("=3"), HasSubstr("write PATH=VALUE"));
  EXPECT_THAT(set("bodies..x=3"), HasSubstr("has no \"\" in bodies"));
  EXPECT_THAT(set("gravity=[0, 0"), HasSubstr("--set gravity: "));
}

}  // namespace
}  // namespace buckens::model_file
