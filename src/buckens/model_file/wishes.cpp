// SPDX-License-Identifier: Apache-2.0
#include "buckens/model_file/wishes.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace buckens::model_file {

namespace {

/// A name under which users look for something, and what they can do.
struct Wish {
  std::string_view name;     // lower case, without separators
  std::string_view section;  // of the model file to which it belongs; empty: any
  std::string_view instead;
};

constexpr std::string_view kLosses =
    "drag is not supported yet; instead use damping: of a `bushing`, a `spring-damper` or a "
    "`torsional-spring`, or a torque or force as a law of time";
constexpr std::string_view kFriction =
    "friction in joints is the load `hinge-friction` (against rotation) or `slide-friction` "
    "(against sliding) here";
constexpr std::string_view kContact =
    "contact between bodies is the load `contact` here, between shapes at two markers";
constexpr std::string_view kLimits =
    "limits of a joint are the loads `hinge-stop` (of its angle) and `slide-stop` (of its "
    "displacement) here";
constexpr std::string_view kGears =
    "transmissions are the joints `gear`, `rack`, `belt` and `coupler` here";
constexpr std::string_view kCam =
    "a cam that guides its follower both ways is the joint `slot` here, one that the follower can "
    "leave is the load `cam`";
constexpr std::string_view kControl =
    "a controller is one of the `signals` here, such as a `pid`; the loads `hinge-motor` and "
    "`slide-motor` take their torque or force from it";
constexpr std::string_view kUniversal =
    "a joint with a cross between two shafts is called `universal` here";
constexpr std::string_view kMaterial =
    "nonlinear materials are not supported yet; materials are linear elastic: E, nu, rho, or "
    "`orthotropic`";
constexpr std::string_view kHeat =
    "temperatures and thermal loads are not supported yet; instead use `initial: {preload: true}` "
    "with parts whose lengths include the expansion";
constexpr std::string_view kPlace =
    "the initial position and orientation of a body are given by its key `at`: bodies: {NAME: {at: "
    "{position: [...], orientation: {...}}}}";

constexpr std::array<Wish, 58> kWishes = {{
    {"friction", "", kFriction},
    {"drag", "loads", kLosses},
    {"contact", "", kContact},
    {"impact", "", kContact},
    {"collision", "", kContact},
    {"limit", "", kLimits},
    {"limits", "", kLimits},
    {"stop", "joints", kLimits},
    {"stops", "joints", kLimits},
    {"gear", "", kGears},
    {"gears", "", kGears},
    {"belt", "", kGears},
    {"chain", "", kGears},
    {"rackpinion", "", kGears},
    {"rackandpinion", "", kGears},
    {"cam", "", kCam},
    {"pulley", "", kGears},
    {"coupler", "joints", kGears},
    {"pid", "", kControl},
    {"controller", "", kControl},
    {"controllers", "", kControl},
    {"control", "", kControl},
    {"hooke", "joints", kUniversal},
    {"cardan", "joints", kUniversal},
    {"helical", "joints", "a helical joint is called `screw` here"},
    {"inplane", "joints", "a point in a plane is called `point-in-plane` here"},
    {"inline", "joints", "a point on a line is called `point-on-line` here"},
    {"pointonsurface", "joints", "a point in a plane is called `point-in-plane` here"},
    {"plasticity", "", kMaterial},
    {"yield", "", kMaterial},
    {"hyperelastic", "", kMaterial},
    {"viscoelastic", "", kMaterial},
    {"temperature", "", kHeat},
    {"thermal", "", kHeat},
    {"thermalexpansion", "", kHeat},
    {"hinge", "joints", "a hinge is called `revolute` here"},
    {"pin", "joints", "a pin joint is called `revolute` here"},
    {"rotational", "joints", "a joint that lets its parts turn is called `revolute` here"},
    {"ball", "joints", "a ball joint is called `spherical` here"},
    {"slider", "joints", "a slider is called `prismatic` here"},
    {"translational", "joints", "a joint that lets its parts slide is called `prismatic` here"},
    {"translation", "joints", "a joint that lets its parts slide is called `prismatic` here"},
    {"weld", "joints", "a weld is called `fixed` here"},
    {"rigid", "joints", "a rigid connection is called `fixed` here"},
    {"motor", "joints",
     "a motor is a load `hinge-motor` or `slide-motor` here, or a `prescribed-rotation`"},
    {"actuator", "joints",
     "a drive is a `prescribed-rotation` or `prescribed-translation` here, or a "
     "`prescribed-coordinate`"},
    {"motion", "joints",
     "a drive is a `prescribed-rotation` or `prescribed-translation` here, or a "
     "`prescribed-coordinate`"},
    {"spring", "", "springs are the loads `spring-damper` and `torsional-spring`, or a `bushing`"},
    {"damper", "", "dampers are the loads `spring-damper` and `torsional-spring` with `damping`"},
    {"moment", "loads", "a moment is called `torque` here"},
    {"gravity", "loads", "gravity is a key of the whole model: gravity: [0, -9.81 m/s^2, 0]"},
    {"acceleration", "loads", "accelerations of the base are the load `base-acceleration`"},
    {"position", "initial", kPlace},
    {"orientation", "initial", kPlace},
    {"rotation", "initial", kPlace},
    {"angle", "initial", kPlace},
    {"displacement", "initial",
     "nodes are displaced by `nodal-displacement`, bodies by their key `at`"},
    {"at", "initial", kPlace},
}};

}  // namespace

std::optional<std::string> advice_on_key(const std::string& key, const std::string& path) {
  std::string plain;
  for (const char c : key) {
    if (c != '-' && c != '_' && c != ' ') {
      plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
  }
  const std::string_view section = std::string_view(path).substr(0, path.find('.'));
  const auto found = std::find_if(kWishes.begin(), kWishes.end(), [&](const Wish& wish) {
    return wish.name == plain && (wish.section.empty() || wish.section == section);
  });
  if (found == kWishes.end()) return std::nullopt;
  return std::string(found->instead);
}

}  // namespace buckens::model_file
