// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "buckens/base/coordinate_choice.h"
#include "buckens/base/field.h"
#include "buckens/base/marker_ref.h"
#include "buckens/model/spec/field_spec.h"

namespace buckens::model {

/// A vector quantity of one marker.
struct MarkerSensor {
  base::MarkerRef of;
  std::optional<base::MarkerRef> in;     ///< axes of the components; default: world
  std::optional<Eigen::Vector3d> along;  ///< record only the component along it; any length

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("of", of, "marker that is observed").required().shorthand().like("rod/end"));
    visit(base::field("in", in, "marker whose axes the components refer to")
              .like("rod")
              .otherwise("world axes"));
    visit(base::field("along", along, "direction of the single component to record")
              .like("[0, -1, 0]")
              .otherwise("all three components"));
  }
};

struct PositionSensor : MarkerSensor {
  static constexpr const char* kKey = "position";
  static constexpr const char* kDoc = "position of a marker in the world";
};
struct DisplacementSensor : MarkerSensor {
  static constexpr const char* kKey = "displacement";
  static constexpr const char* kDoc = "displacement of a marker in the world since t = 0";
};
struct VelocitySensor : MarkerSensor {
  static constexpr const char* kKey = "velocity";
  static constexpr const char* kDoc = "velocity of a marker";
};
struct AccelerationSensor : MarkerSensor {
  static constexpr const char* kKey = "acceleration";
  static constexpr const char* kDoc = "acceleration of a marker";
};
/// Rotation vector of a marker since t = 0.
struct RotationSensor : MarkerSensor {
  static constexpr const char* kKey = "rotation";
  static constexpr const char* kDoc = "rotation vector of a marker since t = 0";
};
struct AngularVelocitySensor : MarkerSensor {
  static constexpr const char* kKey = "angular-velocity";
  static constexpr const char* kDoc = "angular velocity of a marker";
};

/// The reference for the deflection of a marker.
struct DeflectionBase {
  enum Kind { chord, frame, other };
  static constexpr std::array<const char*, 2> kWords = {"chord", "frame"};

  Kind kind = chord;
  base::MarkerRef marker;  ///< for `other` only: a marker of the same body

  DeflectionBase(Kind k = chord) : kind(k) {}  // NOLINT: a kind is a base
  friend bool operator==(const DeflectionBase& base, Kind k) { return base.kind == k; }
};

/// Elastic displacement of a marker of a flexible body.
struct DeflectionSensor {
  static constexpr const char* kKey = "deflection";
  static constexpr const char* kDoc =
      "elastic displacement of a marker, relative to a chord between two markers, to another "
      "marker or to the body frame";
  base::MarkerRef of;
  DeflectionBase from;
  std::optional<std::array<base::MarkerRef, 2>> chord;  ///< in place of start and end

  /// Ends of the chord: as given, or start and end of the body.
  std::array<base::MarkerRef, 2> chord_ends() const {
    if (chord) return *chord;
    std::array<base::MarkerRef, 2> ends = {of, of};
    ends[0].marker = "start";
    ends[1].marker = "end";
    return ends;
  }

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("of", of, "marker that is observed").required().shorthand().like("rod/mid"));
    visit(base::field("from", from,
                      "`chord`: relative to the straight line between `start` and `end` of a beam "
                      "or between the two markers of `chord`, in axes that rotate with it; "
                      "`frame`: relative to the body frame, in its axes; a marker of the same "
                      "body: relative to its motion and rotation, in its axes"));
    visit(
        base::field("chord", chord,
                    "the two markers of the body between which the chord runs; the observed marker "
                    "is compared with the point of the chord next to it in the undeformed body")
            .like("[rod/start, rod/mid]")
            .otherwise("`start` and `end` of a beam"));
  }
};

enum class RelativeQuantity { position, distance, velocity, rotation, angle, angular_velocity };

constexpr std::array<const char*, 6> choice_names(RelativeQuantity) {
  return {"position", "distance", "velocity", "rotation", "angle", "angular-velocity"};
}

/// Motion of the second marker relative to the first, in the first one's axes.
struct RelativeSensor {
  static constexpr const char* kKey = "relative";
  static constexpr const char* kDoc = "motion of the second marker relative to the first";
  std::array<base::MarkerRef, 2> between;
  RelativeQuantity quantity = RelativeQuantity::position;
  std::optional<Eigen::Vector3d> axis;  ///< of `angle`, in the first marker

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("between", between, "the two markers").required().like("[crank, rod]"));
    visit(base::field("quantity", quantity,
                      "what is recorded; `angle` includes whole turns about the axis and is zero "
                      "as placed, before assembly and static start move the bodies"));
    visit(base::field("axis", axis, "axis of `angle` in the first marker's axes")
              .like("[0, 0, 1]")
              .otherwise("planar models: the normal of the plane"));
  }
};

/// Force or torque of a joint on its second marker.
struct JointForceSensor {
  static constexpr const char* kKey = "joint-force";
  static constexpr const char* kDoc = "force of a joint on its second marker";
  std::string joint;
  std::optional<base::MarkerRef> in;  ///< axes of the components; default: world

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("joint", joint, "name of the joint").required().shorthand().like("base"));
    visit(base::field("in", in, "marker whose axes the components refer to")
              .like("rod")
              .otherwise("world axes"));
  }
};
struct JointTorqueSensor : JointForceSensor {
  static constexpr const char* kKey = "joint-torque";
  static constexpr const char* kDoc = "torque of a joint on its second marker";
};

/// Coordinate of a joint, and its rate.
struct JointCoordinateSensor {
  static constexpr const char* kKey = "joint-coordinate";
  static constexpr const char* kDoc =
      "angle of a joint about its axis, including whole turns, or displacement along it, from the "
      "position as placed; or another of its coordinates; with its rate";
  std::string joint;
  std::optional<base::CoordinateChoice> which;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("joint", joint, "name of the joint").required().shorthand().like("hinge"));
    visit(base::field("which", which, "of joints with several coordinates")
              .like("displacement")
              .otherwise("the angle of joints that rotate, the displacement of those that slide; "
                         "needed where there are only others"));
  }
};

/// Resultant of a load over all bodies on which it acts.
struct LoadForceSensor {
  static constexpr const char* kKey = "load-force";
  static constexpr const char* kDoc = "resultant force of a load on the bodies on which it acts";
  std::string load;
  std::optional<base::MarkerRef> in;  ///< axes of the components; default: world

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("load", load, "name of the load").required().shorthand().like("gas"));
    visit(base::field("in", in, "marker whose axes the components refer to")
              .like("rod")
              .otherwise("world axes"));
  }
};
struct LoadTorqueSensor {
  static constexpr const char* kKey = "load-torque";
  static constexpr const char* kDoc =
      "resultant torque of a load about a marker, or about the origin of the world";
  std::string load;
  std::optional<base::MarkerRef> about;
  std::optional<base::MarkerRef> in;  ///< axes of the components; default: world

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("load", load, "name of the load").required().shorthand().like("gas"));
    visit(base::field("about", about, "marker about whose position the torque is taken")
              .like("crank")
              .otherwise("the origin of the world"));
    visit(base::field("in", in, "marker whose axes the components refer to")
              .like("rod")
              .otherwise("world axes"));
  }
};

/// Force of a spring, damper or bushing, tension positive.
struct SpringForceSensor {
  static constexpr const char* kKey = "spring-force";
  static constexpr const char* kDoc =
      "force of a spring-damper or bushing on its first marker: of a spring-damper the tension "
      "between its markers, positive if it pulls them together; of a bushing three components "
      "in "
      "the axes of its first marker, positive if the second marker is pulled back; of a "
      "slide-spring, slide-stop or slide-friction the force opposing the displacement of its joint";
  std::string spring;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("spring", spring, "name of the load or bushing")
              .required()
              .shorthand()
              .like("strut"));
  }
};
struct SpringTorqueSensor {
  static constexpr const char* kKey = "spring-torque";
  static constexpr const char* kDoc =
      "torque of a torsional-spring or bushing: of a torsional spring about its axis, positive if "
      "it turns the second marker back from a positive angle; of a bushing three components in "
      "the axes of its first marker, with the same sign; of a hinge-spring, hinge-stop or "
      "hinge-friction the torque opposing the angle of its joint; of ball-friction three "
      "components "
      "in the axes of the first marker of its joint, which oppose the rotation of the second";
  std::string spring;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("spring", spring, "name of the load or bushing")
              .required()
              .shorthand()
              .like("strut"));
  }
};

/// Section of a beam at a marker on the mesh, or at an end of a numbered element; or solid elements
/// around a node, or a numbered one.
struct SectionPlace {
  base::MarkerRef of;
  std::optional<int> element;  ///< from 1, in the order of the model file

  template <class Visitor>
  void place_fields(Visitor& visit) {
    visit(base::field("of", of,
                      "start, mid, end or a node of a flexible body; with `element`, the body")
              .required()
              .shorthand()
              .like("rod/mid"));
    visit(
        base::field("element", element,
                    "number of the element, counted from 1: beams, bars and solids in the order of "
                    "the file, meshes along x, then y, then z; for lines, their first end")
            .positive()
            .otherwise("the first element that touches the marker"));
  }
};
struct SectionForceSensor : SectionPlace {
  static constexpr const char* kKey = "section-force";
  static constexpr const char* kDoc =
      "normal force, shear forces, torsion and bending moments of "
      "a beam in its local axes";
  template <class Visitor>
  void fields(Visitor& visit) {
    place_fields(visit);
  }
};
struct StressSensor : SectionPlace {
  static constexpr const char* kKey = "stress";
  static constexpr const char* kDoc =
      "largest stress in a section of a beam or bar; at a node of solids the von Mises stress "
      "of the mean over the elements there, taken at their centres; for a body without a marker, "
      "the largest anywhere in it";
  template <class Visitor>
  void fields(Visitor& visit) {
    place_fields(visit);
  }
};

enum class EnergyKind {
  total,
  kinetic,
  potential,
  strain,
  work,
  dissipated,
  balance,
  // Parts of work.
  loads,
  drives,
  events,
  // Parts of what is dissipated.
  joint_friction,
  contact_friction,
  belts,
  impacts,
  damping,
  // What force laws hold.
  springs,
  stops,
  contacts
};

constexpr std::array<const char*, 18> choice_names(EnergyKind) {
  return {"total",   "kinetic", "potential", "strain",  "work",           "dissipated",
          "balance", "loads",   "drives",    "events",  "joint-friction", "contact-friction",
          "belts",   "impacts", "damping",   "springs", "stops",          "contacts"};
}

struct EnergySensor {
  static constexpr const char* kKey = "energy";
  static constexpr const char* kDoc =
      "energy of the whole model: `kinetic`; `strain` of deformed bodies; `potential` is strain "
      "plus "
      "gravity plus springs; `total` is kinetic plus potential; `work` of loads and drives and "
      "what "
      "dampers `dissipated` since t = 0; `balance` is the part of the change of the total since t "
      "= 0 that these two do not explain. Parts of the work: `loads`, `drives` (with motors), "
      "`events` (what springs gain or lose as they are switched or changed). Parts of what is "
      "dissipated: "
      "`joint-friction` (with brakes), `contact-friction`, `belts` (and cables: slip and damping), "
      "`impacts` (of rigid stops, contacts and locks), `damping` (the rest: dampers, bushings, "
      "materials, yielding stops and contacts). Energy held by `springs` (and bushings), yielding "
      "`stops` and `contacts`";
  EnergyKind kind = EnergyKind::total;
  std::optional<std::string> part;  ///< name whose part of it is meant

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("kind", kind, "which energy").shorthand());
    visit(base::field("of", part,
                      "name of a load, joint, contact or body: only its part of the work, of what "
                      "is dissipated, or of what is held; of a joint with all laws that act on it")
              .like("pin_friction")
              .otherwise("the whole model"));
  }
};

/// Forces and gap of a contact.
struct ContactSensor {
  static constexpr const char* kKey = "contact";
  static constexpr const char* kDoc =
      "of a contact: the sum of its forces across the surface (`normal`), the size of their "
      "resultant along it (`friction`) and the least distance of both shapes, negative where they "
      "overlap (`gap`); of contacts of many bodies: the sums of all forces across and along, and "
      "the "
      "number of pairs that touch (`touching`)";
  std::string contact;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("contact", contact, "name of the contact")
              .required()
              .shorthand()
              .like("bounce"));
  }
};

/// Tensions of an elastic belt.
struct BeltSensor {
  static constexpr const char* kKey = "belt";
  static constexpr const char* kDoc =
      "of an elastic belt: the forces in its spans, `left` and `right` of the way from the first "
      "pulley to the second as seen against the axis, and the length by which it has slipped "
      "(`slip`)";
  std::string belt;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(
        base::field("belt", belt, "name of the elastic belt").required().shorthand().like("drive"));
  }
};

/// Tensions, wraps and slips of a cable.
struct CableSensor {
  static constexpr const char* kKey = "cable";
  static constexpr const char* kDoc =
      "of a cable: the forces in its spans (`tension1` …), the angles by which it is wrapped "
      "around "
      "its pulleys (`wrap1` …) and the lengths by which it has slipped over them in its own "
      "direction (`slip1` …)";
  std::string cable;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("cable", cable, "name of the cable").required().shorthand().like("hoist"));
  }
};

/// Force and deflection of elastic teeth.
struct GearSensor {
  static constexpr const char* kKey = "gear";
  static constexpr const char* kDoc =
      "of an elastic gear: the force of its teeth and how far they give way (`deflection`), both "
      "normal to their flanks and positive where the first gear turned forwards about `axis` "
      "pushes the second; zero while teeth pass their play. Of a joint `gear` or `rack` with "
      "`backlash`: the same force, and how far teeth are from the middle of their play, on the "
      "pitch circle (`play`)";
  std::string gear;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("gear", gear, "name of the elastic gear, or of the joint with backlash")
              .required()
              .shorthand()
              .like("mesh"));
  }
};

/// A signal of the model.
struct SignalSensor {
  static constexpr const char* kKey = "signal";
  static constexpr const char* kDoc = "value of a signal";
  std::string signal;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("signal", signal, "name of the signal").required().shorthand().like("u"));
  }
};

/// A quantity observed over time, as one or more columns of sensors.csv.
struct SensorSpec {
  std::string name;
  SourceLocation where;
  std::variant<PositionSensor, DisplacementSensor, VelocitySensor, AccelerationSensor,
               RotationSensor, AngularVelocitySensor, DeflectionSensor, RelativeSensor,
               JointForceSensor, JointTorqueSensor, LoadForceSensor, LoadTorqueSensor,
               SpringForceSensor, SpringTorqueSensor, SectionForceSensor, StressSensor,
               EnergySensor, JointCoordinateSensor, SignalSensor, ContactSensor, BeltSensor,
               CableSensor, GearSensor>
      kind;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::inlined(kind, "what is observed").required());
  }
};

/// Recorded quantities and their interval.
struct OutputSpec {
  SourceLocation where;
  std::optional<double> every;  ///< [s]; default: about 500 records over the duration
  std::vector<SensorSpec> sensors;
  std::optional<FieldOutputSpec> field_output;  ///< of meshes

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(
        base::field("every", every, "time between two records; interpolated where steps do not fit")
            .in(base::kTime)
            .positive()
            .like("1 ms")
            .otherwise("duration/500, at least one step"));
    visit(base::field("sensors", sensors, "observed quantities by name")
              .like("{tip: {position: rod/end}}"));
    visit(base::field("fields", field_output, "fields over the meshes of bodies")
              .like("[von-mises]")
              .otherwise("displacements of all nodes; stresses of lines and at the centres of "
                         "solids"));
  }
};

}  // namespace buckens::model
