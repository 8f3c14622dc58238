// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "buckens/base/field.h"
#include "buckens/base/marker_ref.h"
#include "buckens/base/source_location.h"
#include "buckens/loads/contact_settings.h"
#include "buckens/loads/contact_shape_spec.h"

namespace buckens::loads {

/// Force law of elastic contacts, with the same keys for one pair and for many bodies.
struct ContactForceSpec {
  std::optional<double> stiffness;    ///< K [N/m^n]
  std::optional<double> exponent;     ///< n
  std::optional<double> restitution;  ///< 0 … 1
  std::optional<double> threshold;    ///< [m/s]
  double damping = 0;                 ///< [N s/m]
  double coefficient = 0;             ///< of friction while it sticks
  std::optional<double> dynamic;      ///< of friction while it slides
  std::optional<double> stribeck;     ///< [m/s]
  std::optional<double> tangential;   ///< stiffness of sticking [N/m]
  ContactSettings settings;           ///< of what events change, as the model is built

 protected:
  /// @param without consequence if neither a stiffness nor moduli are given
  template <class Visitor>
  void stiffness_fields(Visitor& visit, const char* without) {
    visit(base::field(
              "stiffness", stiffness,
              "force at 1 m of overlap: N/m, with an `exponent` n other than 1 the number "
              "of N/m^n; of each point of a box, capsule or cylinder that touches (of two capsules "
              "side by side, 35/48 of it at each end); of two boxes, a cylinder and a box or "
              "cylinder, or a mesh and a plane, of each quarter of an area like the mean face of "
              "the smaller one (of a cylinder an end, of a mesh a sixth of the surface)")
              .in(base::kStiffness)
              .positive()
              .like("1e7 N/m")
              .otherwise(base::lasting_text(std::string("by `modulus`; ") + without)));
    visit(base::field("exponent", exponent, "n of the force, stiffness times overlap to the n")
              .positive()
              .like("1.5")
              .otherwise("1; with `modulus` 1.5"));
  }

  /// @param restitution_otherwise restitution if none is given
  template <class Visitor>
  void loss_fields(Visitor& visit, const char* restitution_otherwise) {
    visit(base::field("restitution", restitution,
                      "share of the speed of approach with which the bodies part, 0 … 1; of an "
                      "elastic contact at least 0.01")
              .non_negative()
              .like("0.8")
              .otherwise(restitution_otherwise));
    visit(
        base::field("threshold", threshold,
                    "speed of approach: below it a rigid contact stays closed, and losses of an "
                    "elastic one do not rise further")
            .in(base::kVelocity)
            .positive()
            .like("1 mm/s")
            .otherwise("a thousandth of the smaller shape's size per second; elastic: at least the "
                       "speed below which its weight keeps the lighter body there"));
    visit(base::field("damping", damping,
                      "of an elastic contact, in addition; its force is at most that of the "
                      "stiffness")
              .in(base::kDamping)
              .non_negative()
              .like("100 N s/m"));
  }

  template <class Visitor>
  void friction_fields(Visitor& visit) {
    visit(base::field("static", coefficient, "coefficient of friction while it sticks")
              .non_negative()
              .like("0.3"));
    visit(base::field("dynamic", dynamic, "coefficient of friction while it slides")
              .non_negative()
              .like("0.25")
              .otherwise("the same as `static`"));
    visit(base::field("stribeck-velocity", stribeck,
                      "speed of sliding at which the coefficient has dropped from `static` "
                      "towards `dynamic` by 63 %; needed if they differ")
              .in(base::kVelocity)
              .positive()
              .like("10 mm/s")
              .otherwise("none"));
    visit(base::field("tangential-stiffness", tangential,
                      "of the elastic displacement while friction sticks, of each point of an "
                      "elastic contact")
              .in(base::kStiffness)
              .positive()
              .like("1e7 N/m")
              .otherwise("0.8 of the stiffness normal to the surface under the weight of the "
                         "lighter body"));
  }
};

/// Contact of two bodies: elastic with a stiffness or moduli, otherwise rigid.
struct ContactSpec : ContactForceSpec {
  static constexpr const char* kKey = "contact";
  static constexpr const char* kDoc =
      "contact between two shapes on markers: elastic, or rigid with impacts; with friction";
  std::array<base::MarkerRef, 2> between;
  std::array<ShapeSpec, 2> shapes;
  std::optional<std::array<double, 2>> modulus;  ///< [Pa]
  std::optional<std::array<double, 2>> poisson;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("between", between, "the two markers that carry the shapes")
              .required()
              .like("[ground, ball]"));
    visit(base::field("shapes", shapes, "the shape on the first marker and that on the second")
              .required()
              .like("[{plane: [0, 0, 1]}, {sphere: 50 mm}]"));
    stiffness_fields(visit, "without either the contact is rigid");
    visit(base::field("modulus", modulus,
                      "Young's moduli of both bodies, for the force by Hertz; for spheres on "
                      "planes, spheres and in sockets")
              .in(base::kStress)
              .positive()
              .like("[210 GPa, 70 GPa]")
              .otherwise("none"));
    visit(base::field("poisson-ratio", poisson, "Poisson's ratios that belong to `modulus`")
              .within(base::Range::poisson)
              .like("[0.3, 0.33]")
              .otherwise("0.3 for both"));
    loss_fields(visit, "elastic: 1; rigid: 0");
    friction_fields(visit);
  }
};

/// One or several bodies of `contacts` that have the same shape.
struct ContactMemberSpec {
  SourceLocation where;
  base::MarkerRef on;
  std::vector<std::string> bodies;  ///< names, or patterns of names: "ball*"
  ShapeSpec shape;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("on", on, "marker that carries the shape; or give `bodies`")
              .like("ground")
              .otherwise("`bodies`"));
    visit(base::field("bodies", bodies,
                      "bodies that carry the shape at their mass centres: names, or patterns in "
                      "which * stands for any characters")
              .like("\"ball*\"")
              .otherwise("`on`"));
    visit(base::inlined(shape.kind, "shape").required());
  }
};

/// Contact among many bodies.
struct ContactsSpec : ContactForceSpec {
  static constexpr const char* kKey = "contacts";
  static constexpr const char* kDoc =
      "contact among many bodies: whichever of them come near each other are found in every step; "
      "elastic, or rigid with impacts; with friction";
  std::vector<ContactMemberSpec> among;
  std::vector<ContactMemberSpec> against;
  std::optional<double> modulus;  ///< [Pa]
  std::optional<double> poisson;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("among", among,
                      "what touches: every shape can touch every other, except of the same body "
                      "and of bodies that a joint connects")
              .required()
              .like("[{on: ground, plane: [0, 0, 1]}, {bodies: \"ball*\", sphere: 50 mm}]"));
    visit(base::field("against", against,
                      "a second list: then only what is in different lists can touch")
              .like("[{on: ground, plane: [0, 0, 1]}]"));
    stiffness_fields(visit, "without either the contacts are rigid");
    visit(base::field("modulus", modulus,
                      "Young's modulus of all bodies, for the force by Hertz; for spheres and "
                      "planes")
              .in(base::kStress)
              .positive()
              .like("210 GPa")
              .otherwise("none"));
    visit(base::field("poisson-ratio", poisson, "Poisson's ratio that belongs to `modulus`")
              .within(base::Range::poisson)
              .like("0.3")
              .otherwise("0.3"));
    loss_fields(visit, "elastic: 1; rigid: 0");
    friction_fields(visit);
  }
};

}  // namespace buckens::loads
