// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/check/contact_findings.h"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/nearest.h"
#include "buckens/loads/contact_law.h"
#include "buckens/loads/contact_pair.h"
#include "buckens/model/check/marker_names.h"

namespace buckens::model {

namespace {

using loads::kLeastElasticRestitution;
using loads::ShapeSpec;

template <class Shape>
const Shape* get(const ShapeSpec& shape) {
  return std::get_if<Shape>(&shape.kind);
}

template <class Shape>
const Shape* either(const loads::ContactSpec& spec) {
  const Shape* first = get<Shape>(spec.shapes[0]);
  return first != nullptr ? first : get<Shape>(spec.shapes[1]);
}

Found direction_problem(const ShapeSpec& shape) {
  return std::visit(
      [&]<class T>(const T& own) -> Found {
        if constexpr (requires { own.normal; }) {
          if (!own.normal || own.normal->norm() > 0.0) return std::nullopt;
          return Finding{"shapes", "a normal cannot be [0, 0, 0]; give its direction"};
        } else if constexpr (requires { own.axis; }) {
          if (!own.axis || own.axis->norm() > 0.0) return std::nullopt;
          return Finding{"shapes", "an axis cannot be [0, 0, 0]; give its direction"};
        } else {
          return std::nullopt;
        }
      },
      shape.kind);
}

bool is_pair(const loads::ContactSpec& spec, const std::string& a, const std::string& b) {
  const std::string first = spec.shapes[0].touches_as(), second = spec.shapes[1].touches_as();
  return (first == a && second == b) || (first == b && second == a);
}

Found pair_problem(const loads::ContactSpec& spec) {
  using loads::to_string;
  const auto all = loads::ContactPair::all();
  const auto known = std::any_of(all.begin(), all.end(), [&](const auto& kinds) {
    return is_pair(spec, to_string(kinds[0]), to_string(kinds[1]));
  });
  if (!known) {
    std::vector<std::string> pairs;
    for (const auto& kinds : all) {
      pairs.push_back(fmt::format("{}–{}", to_string(kinds[0]), to_string(kinds[1])));
    }
    return Finding{"shapes", fmt::format("a {} and a {} cannot touch; the pairs are {}",
                                         spec.shapes[0].touches_as(), spec.shapes[1].touches_as(),
                                         fmt::join(pairs, ", "))};
  }
  const auto does_not_fit = [&](const char* what, double hole, double inside) -> Found {
    if (inside < hole) return std::nullopt;
    return Finding{"shapes", fmt::format("a radius of {:g} m does not fit into the {} of {:g} m; "
                                         "swap them, or make the {} wider",
                                         inside, what, hole, what)};
  };
  const auto* sphere = either<loads::SphereShape>(spec);
  const auto* cylinder = either<loads::CylinderShape>(spec);
  const auto* socket = either<loads::SocketShape>(spec);
  const auto* bore = either<loads::BoreShape>(spec);
  if (socket != nullptr) return does_not_fit("socket", socket->radius, sphere->radius);
  if (bore == nullptr) return std::nullopt;
  return does_not_fit("bore", bore->radius, sphere != nullptr ? sphere->radius : cylinder->radius);
}

/// Keys that only elastic contacts have.
Found rigid_problem(const loads::ContactForceSpec& spec) {
  const auto needs_stiffness = [](const char* key) {
    return Finding{key,
                   "without `stiffness` or `modulus` the contact is rigid, and this key has no "
                   "effect; give one of them"};
  };
  if (spec.damping > 0.0) return needs_stiffness("damping");
  if (spec.exponent) return needs_stiffness("exponent");
  if (spec.tangential) return needs_stiffness("tangential-stiffness");
  return std::nullopt;
}

Found too_much_restitution_problem(const loads::ContactForceSpec& spec) {
  if (spec.restitution.value_or(0.0) <= 1.0) return std::nullopt;
  return Finding{
      "restitution",
      fmt::format("expected 0 to 1, found {:g}: a rebound cannot be faster than the approach",
                  *spec.restitution)};
}

Found elastic_loss_problem(const loads::ContactForceSpec& spec) {
  if (spec.restitution && *spec.restitution < kLeastElasticRestitution) {
    return Finding{"restitution",
                   fmt::format("expected {:g} to 1 for an elastic contact, found {:g}; leave out "
                               "`stiffness` and `modulus` for a rigid contact, where 0 is allowed",
                               kLeastElasticRestitution, *spec.restitution)};
  }
  return std::nullopt;
}

/// What touches with a volume has springs spread over it.
Found exponent_problem(const loads::ContactForceSpec& spec, const std::string& first,
                       const std::string& second) {
  if (spec.exponent.value_or(1.0) == 1.0) return std::nullopt;
  const auto are = [&](const char* a, const char* b) {
    return (first == a && second == b) || (first == b && second == a);
  };
  const bool by_area = are("plane", "mesh") || are("mesh", "mesh");
  if (!by_area && !are("box", "cylinder") && !are("cylinder", "cylinder")) return std::nullopt;
  const char* what = by_area ? "touch with an area" : "share a volume";
  return Finding{"exponent",
                 fmt::format("a {} and a {} {}, over which forces grow linearly; remove `exponent`",
                             first, second, what)};
}

Found elastic_problem(const loads::ContactSpec& spec) {
  if (spec.stiffness && spec.modulus) {
    return Finding{"modulus",
                   "`stiffness` and `modulus` both define the force; remove one of them"};
  }
  if (spec.poisson && !spec.modulus) {
    return Finding{
        "poisson-ratio",
        "it requires `modulus`, which is missing; add `modulus`, or remove `poisson-ratio`"};
  }
  if (spec.modulus && spec.exponent) {
    return Finding{"exponent",
                   "with `modulus` the exponent is 1.5; remove `exponent`, or give a `stiffness` "
                   "instead of `modulus`"};
  }
  if (Found found =
          exponent_problem(spec, spec.shapes[0].touches_as(), spec.shapes[1].touches_as())) {
    return found;
  }
  const bool is_hertz = is_pair(spec, "sphere", "plane") || is_pair(spec, "sphere", "sphere") ||
                        is_pair(spec, "sphere", "socket");
  if (spec.modulus && !is_hertz) {
    return Finding{
        "modulus",
        fmt::format("Hertz's theory gives no force between a {} and a {}; give a `stiffness`",
                    spec.shapes[0].touches_as(), spec.shapes[1].touches_as())};
  }
  return elastic_loss_problem(spec);
}

Found contact_friction_problem(const loads::ContactForceSpec& spec) {
  if (spec.dynamic && *spec.dynamic > spec.coefficient) {
    return Finding{"dynamic", fmt::format("dynamic friction is {:g}, which exceeds static "
                                          "friction, {:g}; swap `static` and `dynamic`",
                                          *spec.dynamic, spec.coefficient)};
  }
  if (spec.coefficient == 0.0 && (spec.stribeck || spec.tangential)) {
    return Finding{
        spec.stribeck ? "stribeck-velocity" : "tangential-stiffness",
        "it requires `static` friction, which is missing; add `static`, or remove this key"};
  }
  if (spec.dynamic && *spec.dynamic < spec.coefficient && !spec.stribeck) {
    return Finding{"stribeck-velocity",
                   "the key \"stribeck-velocity\" is missing; where `static` and `dynamic` differ, "
                   "it sets the sliding speed over which one passes into the other"};
  }
  return std::nullopt;
}

/// Whether two entries have shapes that can touch, where they can meet at all.
Found kinds_problem(const loads::ContactsSpec& spec, const loads::ContactMemberSpec& a,
                    const loads::ContactMemberSpec& b) {
  const auto is_on_ground = [](const loads::ContactMemberSpec& one) { return one.on.is_ground(); };
  if (is_on_ground(a) && is_on_ground(b)) return std::nullopt;
  const std::string first = a.shape.touches_as(), second = b.shape.touches_as();
  const auto all = loads::ContactPair::all();
  const auto is_either = [&](const auto& kinds) {
    const std::string one = loads::to_string(kinds[0]), other = loads::to_string(kinds[1]);
    return (first == one && second == other) || (first == other && second == one);
  };
  if (std::none_of(all.begin(), all.end(), is_either)) {
    return Finding{"among", fmt::format("a {} and a {} cannot touch; use other shapes, or "
                                        "separate them by `against`",
                                        first, second)};
  }
  const auto has = [&](const char* kind) { return first == kind || second == kind; };
  if (spec.modulus && !(has("sphere") && (first == second || has("plane") || has("socket")))) {
    return Finding{
        "modulus",
        fmt::format("Hertz's theory gives no force between a {} and a {}; give a `stiffness`",
                    first, second)};
  }
  return exponent_problem(spec, first, second);
}

Found kinds_problem(const loads::ContactsSpec& spec) {
  const auto& others = spec.against.empty() ? spec.among : spec.against;
  for (std::size_t i = 0; i < spec.among.size(); ++i) {
    for (std::size_t j = spec.against.empty() ? i : 0; j < others.size(); ++j) {
      // One body does not touch itself.
      if (&spec.among[i] == &others[j] && spec.among[i].bodies.empty()) continue;
      if (Found found = kinds_problem(spec, spec.among[i], others[j])) return found;
    }
  }
  return std::nullopt;
}

}  // namespace

Found own_joint_problem(const loads::ContactSpec& spec, const ModelDescription& /*model*/) {
  for (const ShapeSpec& shape : spec.shapes) {
    if (Found found = direction_problem(shape)) return found;
  }
  if (Found found = pair_problem(spec)) return found;
  if (Found found = too_much_restitution_problem(spec)) return found;
  if (!spec.stiffness && !spec.modulus) {
    if (Found found = rigid_problem(spec)) return found;
  }
  if (spec.stiffness || spec.modulus || spec.poisson) {
    if (Found found = elastic_problem(spec)) return found;
  }
  return contact_friction_problem(spec);
}

Found own_joint_problem(const loads::ContactsSpec& spec, const ModelDescription& /*model*/) {
  const auto problem_in = [](const std::vector<loads::ContactMemberSpec>& list,
                             const char* key) -> Found {
    for (const loads::ContactMemberSpec& member : list) {
      if (Found found = direction_problem(member.shape)) return Finding{key, found->text};
      if (member.bodies.empty() == member.on.body.empty()) {
        return Finding{
            key,
            "each entry needs exactly one of `on` (a marker) and `bodies` (a list of body names)"};
      }
    }
    return std::nullopt;
  };
  if (Found found = problem_in(spec.among, "among")) return found;
  if (Found found = problem_in(spec.against, "against")) return found;
  if (Found found = kinds_problem(spec)) return found;
  if (spec.stiffness && spec.modulus) {
    return Finding{"modulus",
                   "`stiffness` and `modulus` both define the force; remove one of them"};
  }
  if (spec.poisson && !spec.modulus) {
    return Finding{
        "poisson-ratio",
        "it requires `modulus`, which is missing; add `modulus`, or remove `poisson-ratio`"};
  }
  if (spec.modulus && spec.exponent) {
    return Finding{"exponent",
                   "with `modulus` the exponent is 1.5; remove `exponent`, or give a `stiffness` "
                   "instead of `modulus`"};
  }
  if (Found found = too_much_restitution_problem(spec)) return found;
  const bool is_rigid = !spec.stiffness && !spec.modulus;
  if (Found found = is_rigid ? rigid_problem(spec) : elastic_loss_problem(spec)) return found;
  return contact_friction_problem(spec);
}

Found restitution_problem(const loads::ContactForceSpec& spec, bool is_elastic) {
  if (Found found = too_much_restitution_problem(spec)) return found;
  return is_elastic ? elastic_loss_problem(spec) : std::nullopt;
}

Found own_joint_problem(const ContactSensor& spec, const ModelDescription& model) {
  std::vector<std::string> known;
  for (const loads::LoadSpec& load : model.loads) {
    const bool is_one = std::holds_alternative<loads::ContactSpec>(load.kind) ||
                        std::holds_alternative<loads::ContactsSpec>(load.kind);
    if (is_one) known.push_back(load.name);
  }
  if (std::find(known.begin(), known.end(), spec.contact) != known.end()) return std::nullopt;
  return Finding{"contact", fmt::format("there is no contact \"{}\".{}", spec.contact,
                                        known.empty() ? " The model has none."
                                                      : base::suggestion(spec.contact, known))};
}

}  // namespace buckens::model
