// SPDX-License-Identifier: Apache-2.0
#include <map>

#include <fmt/format.h>

#include "buckens/base/units.h"
#include "buckens/model_file/model_file.h"
#include "buckens/model_file/shape.h"

namespace buckens::model_file {

namespace {

constexpr const char* kIntroduction = R"(# The model file

<!-- Written by the program from the field lists of its input. Do not edit: run
     `buckens reference > docs/reference/model-file.md`. -->

This page lists every key of a model file. A model file is YAML; JSON, which is a subset, works too.
`buckens check MODEL.yaml` reports what is wrong with it, with line and column. `buckens schema` prints a
JSON Schema that lets editors complete and check model files. The smallest complete model is

```yaml
buckens: 1
gravity: [0, -9.81 m/s^2, 0]
planar: xy
bodies:
  rod: {rigid: {mass: 1 kg, com: [500 mm, 0, 0], inertia: [0, 0, 0.0833 kg m^2]}}
joints:
  pin: {revolute: {between: [ground, rod/origin]}}
simulation: {duration: 2 s, step: 1 ms}
output: {every: 10 ms, sensors: {com: {position: rod}}}
```

## Values

**Numbers** are plain decimals (`75`, `-2.5e3`) of at most 1e60, in SI units. Anything that different
programs read differently is refused: `010`, `0x10`, `yes` for a number, `.inf`, duplicate keys, anchors,
merge keys.

**Quantities** carry a unit after white space: `75 mm`, `9.81 m/s^2`, `-2.727e-3 kg m^2`. Units are
multiplied by a blank, `*` or `·`, divided by `/` (each slash divides only by the unit that follows:
`kg/m/s`), and raised with `^`. A wrong dimension is an error. The radian may be left out next to
a mass (`N m` for `N m/rad`), but not between `Hz` and `rad/s`. Known units:

)";

constexpr const char* kValues = R"(
**Expressions** are allowed wherever numbers are: `2*L`, `"L/2 + 10"`, `"2*pi*50 rad/s"`. They may use the
entries of `parameters` (in SI units), `pi`, `e`, and the functions sin, cos, tan, asin, acos, atan, atan2,
sinh, cosh, tanh, exp, ln, log10, log2, sqrt, abs, sign, rint, min, max, sum, avg; powers are written `^`,
conditions `a < b ? x : y`. A unit, if any, comes last, after white space, and multiplies the whole
expression: `"10*sin(20*t) N"`, `"2*L mm"`. Quote expressions that contain `: `, ` #`, `,` or braces.

**Laws of time** are numbers, expressions of `t` (seconds), or tables:

)";

constexpr const char* kLawRemarks = R"(
A table must cover the simulation, unless `extrapolation: hold` extends its first and last value. CSV
columns are separated by commas, semicolons or blanks. Lines that begin with `#` are skipped, and so is one
heading line, whose first cell does not begin like a number.

If a law drives a joint, its first and second derivatives are used. Formulas are differentiated
numerically to about eleven digits and must be defined in a neighbourhood of every time that occurs. At
t = 0 only later times count, so `max(t, 0)` starts with speed 1. A law with unbounded speed at t = 0
(`sqrt(t)`) is refused; one with unbounded acceleration (`t^1.5`) causes a warning. Tables should be splines.

**Laws of signals** are laws of time or expressions of `t` and the names of `signals`:
`"20*(0.5 - angle) - 3*speed"`. Signals are numbers in SI units.

**Characteristics** are expressions of `angle` (or `displacement`) and `rate`, or tables as above with the
angle in rad or the displacement in m instead of the time.

**As placed** means the position of the bodies in the model file, before assembly and a static start move
them.

**Markers** are written `ground` (the world), `rod` (the body frame, at the mass centre), `rod/origin`
(origin of the model axes), `rod/com`, `rod/start`, `rod/mid`, `rod/end` (beams), `rod/<node>`
(structures), `rod/<marker>` (entries of `markers`), or `{ground: [x, y, z]}` for a point of the world.
Markers use the model axes of their body unless they define their own.

**Names** consist of letters, digits, `_` and `-`. **Axes:** a body is described in its model axes, which
`at` places in the world; lists of three are x, y, z components.

**Changes from the command line:** `--set bodies.rod.beam.elements=8`, `--set parameters.L="2 m"`,
`--set gravity.1=0` (list entries are counted from 0).

)";

std::string type_text(const Shape& shape, const base::FieldNote& note);

std::string quantity_text(const base::FieldNote& note) {
  if (note.any_dimension) return "quantity";
  if (note.dimension == base::kNumber) return "number";
  return base::dimension_name(note.dimension)
             .substr(base::dimension_name(note.dimension).find(' ') + 1) +
         (note.word.empty() ? "" : fmt::format(" or `{}`", note.word));
}

std::string type_text(const Shape& shape, const base::FieldNote& note) {
  switch (shape.kind) {
    case Shape::Kind::quantity:
      return quantity_text(note);
    case Shape::Kind::integer:
      return "whole number";
    case Shape::Kind::frame_division:
      return fmt::format("whole number or `{}`", shape.choices[0]);
    case Shape::Kind::text:
      return "text";
    case Shape::Kind::truth:
      return note.is_switch ? "`on`, `off`" : "`true`, `false`";
    case Shape::Kind::choice:
      return fmt::format("`{}`", fmt::join(shape.choices, "`, `"));
    case Shape::Kind::time_law:
      // Laws of signals and characteristics are read the same way, from other variables.
      return shape.choices.empty()                 ? quantity_text(note) + " or law of time"
             : shape.choices[0] == "or of signals" ? quantity_text(note) + " or law of signals"
                                                   : quantity_text(note) + " or characteristic";
    case Shape::Kind::position_law:
      return quantity_text(note) + " or formula in x, y, z";
    case Shape::Kind::marker:
      return "marker";
    case Shape::Kind::word_or_marker:
      return fmt::format("`{}` or marker", fmt::join(shape.choices, "`, `"));
    case Shape::Kind::list:
      if (takes_single_text(shape)) return "text or list of text";
      return fmt::format("list of {}{}", shape.count < 0 ? "" : fmt::format("{} × ", shape.count),
                         type_text(shape.element[0], note));
    case Shape::Kind::reference:
      return "name or map";
    case Shape::Kind::named:
      return "map by name";
    case Shape::Kind::record:
      break;
  }
  return "map";
}

std::string rule_text(const base::FieldNote& note) {
  switch (note.range) {
    case base::Range::any:
      break;
    case base::Range::positive:
      return ", positive";
    case base::Range::non_negative:
      return ", not negative";
    case base::Range::fraction:
      return ", 0 to 1";
    case base::Range::poisson:
      return ", above -1, at most 0.5";
  }
  return "";
}

/// Writes a section per record, each kind of record once.
class ReferenceWriter {
 public:
  std::string text;

  void write(const Shape& record, const std::string& path, int level) {
    const std::string title = path.empty() ? "Top level" : "`" + path + "`";
    written_.emplace(record.type, title);
    text += fmt::format("{} {}\n\n", std::string(static_cast<std::size_t>(level), '#'), title);
    write_table(record);
    // Deeper headings than four look like text.
    const int next = std::min(level + 1, 4);
    for (const auto* list : {&record.alternatives, &record.fields}) {
      for (const FieldShape& field : *list) {
        const std::string name(field.note.name);
        write_inner(field.shape, path.empty() ? name : path + "." + name, next);
      }
    }
  }

  void write_table(const Shape& record) {
    if (!record.alternatives.empty()) {
      text += "Exactly one of\n\n| key | meaning |\n|---|---|\n";
      for (const FieldShape& field : record.alternatives) {
        text += fmt::format("| `{}` | {} |\n", field.note.name, field.note.doc);
      }
      text += "\n";
    }
    if (record.fields.empty()) return;
    text += record.alternatives.empty() ? "" : "and\n\n";
    text += "| key | value | default | meaning |\n|---|---|---|---|\n";
    for (const FieldShape& field : record.fields) {
      const base::FieldNote& note = field.note;
      const std::string standard = note.is_required ? "**required**" : field.standard;
      const std::string example =
          note.example.empty() ? "" : fmt::format("; e.g. `{}`", note.example);
      const std::string key = note.name.empty() ? "(the value)" : fmt::format("`{}`", note.name);
      text += fmt::format("| {} | {}{} | {} | {}{} |\n", key, type_text(field.shape, note),
                          rule_text(note), standard, note.doc, example);
    }
    text += "\n";
    const FieldShape* shorthand = record.shorthand();
    if (shorthand != nullptr && !shorthand->note.name.empty()) {
      const FieldShape* list = record.list_shorthand();
      text += fmt::format("A single value in place of the map is `{}`{}.\n\n", shorthand->note.name,
                          list == nullptr ? "" : fmt::format(", a list `{}`", list->note.name));
    }
  }

 private:
  void write_inner(const Shape& shape, const std::string& path, int level) {
    switch (shape.kind) {
      case Shape::Kind::named:
        write_inner(shape.element[0], path + ".<name>", level);
        break;
      case Shape::Kind::list:
        write_inner(shape.element[0], path + "[]", level);
        break;
      case Shape::Kind::reference:
        write_inner(shape.element[0], path, level);
        break;
      case Shape::Kind::record:
        write_once(shape, path, level);
        break;
      default:
        break;
    }
  }

  void write_once(const Shape& shape, const std::string& path, int level) {
    const bool is_single_value =
        shape.shorthand() != nullptr && shape.shorthand()->note.name.empty();
    if (is_single_value) return;
    const auto known = written_.find(shape.type);
    if (known == written_.end()) return write(shape, path, level);
    text += fmt::format("{} `{}`\n\nAs {}.\n\n", std::string(static_cast<std::size_t>(level), '#'),
                        path, known->second);
  }

  std::map<std::type_index, std::string> written_;
};

}  // namespace

std::string model_reference_markdown() {
  std::string out = kIntroduction;
  out += fmt::format("`{}`\n", fmt::join(base::unit_names(), "`, `"));
  out += kValues;
  ReferenceWriter law;
  for (const FieldShape& joint : model_file_shape().find("joints")->shape.element[0].alternatives) {
    const FieldShape* angle = joint.shape.find("angle");
    if (angle == nullptr) continue;
    law.write_table(angle->shape.element[0]);
    break;  // every joint with an angle takes the same laws
  }
  out += law.text + kLawRemarks;
  ReferenceWriter writer;
  writer.write(model_file_shape(), "", 2);
  out += writer.text;
  while (out.ends_with("\n\n")) out.pop_back();
  return out;
}

}  // namespace buckens::model_file
