// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "buckens/base/test/source_directory.h"

namespace buckens::verification {

inline const nlohmann::json& truss_reference() {
  static const nlohmann::json json = [] {
    std::ifstream file(std::string(buckens::test::kSourceDirectory) +
                       "/verification/von_mises_truss/reference.json");
    return nlohmann::json::parse(file);
  }();
  return json;
}

/// Two pinned bars from (±b, 0) to the apex (0, H), a load at the apex.
struct Truss {
  double b, H, EA, rhoA, tip;
  double w_crit, F_crit;

  /// @param name "A" or "C"
  explicit Truss(const std::string& name) {
    const nlohmann::json& json = truss_reference()[name];
    const nlohmann::json& p = json["params"];
    b = p["b"];
    H = p["H"];
    EA = p["EA"];
    rhoA = p["rhoA"];
    tip = p["mtip"];
    w_crit = json["w_crit"];
    F_crit = json["F_crit"];
  }

  double L0() const { return std::hypot(b, H); }
  /// F = 2 EA (L0 − L)/L0 · (H − w)/L, the exact equilibrium of bars of linear stiffness [N].
  double force(double w) const {
    const double L = std::hypot(b, H - w);
    return 2.0 * EA * (L0() - L) / L0() * (H - w) / L;
  }

  /// The model file up to `loads`, `static` and `simulation`; the load acts on left/apex, the
  /// sensor w is the way of the apex downwards.
  /// @param bars per member, 1 or 2, each with its own frame
  std::string model(int bars, const std::string& coupling = "full") const {
    std::string bodies, joints;
    for (const int side : {-1, 1}) {
      const char* name = side < 0 ? "left" : "right";
      bodies += fmt::format(
          "  {}:\n    structure:\n      nodes: {{foot: [{:.17g}, 0, 0], apex: [0, {:.17g}, 0]}}\n"
          "      bars: [{{between: [foot, apex], elements: {}, area: 1, material: bar}}]\n"
          "    frames: per-element\n    coupling: {}\n",
          name, side * b, H, bars, coupling);
      joints += fmt::format(
          "  {0}_foot: {{revolute: {{between: [{{ground: [{1:.17g}, 0, 0]}}, {0}/foot]}}}}\n", name,
          side * b);
    }
    joints += "  hinge: {revolute: {between: [left/apex, right/apex]}}\n";
    if (tip > 0.0) {
      bodies += fmt::format(
          "  tip: {{rigid: {{mass: {:.17g}}}, at: {{position: [0, {:.17g}, 0]}}}}\n", tip, H);
      joints += "  tip: {revolute: {between: [left/apex, tip]}}\n";
    }
    return fmt::format(
        "buckens: 1\nplanar: xy\nmaterials: {{bar: {{E: {:.17g}, nu: 0, rho: {:.17g}}}}}\n"
        "bodies:\n{}joints:\n{}",
        EA, rhoA, bodies, joints);
  }

  static std::string sensor() {
    return "sensors: {w: {displacement: {of: left/apex, along: [0, -1, 0]}}}";
  }
};

}  // namespace buckens::verification
