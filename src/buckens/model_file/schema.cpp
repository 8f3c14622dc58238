// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "buckens/model_file/model_file.h"
#include "buckens/model_file/shape.h"
#include "buckens/model_file/values.h"

namespace buckens::model_file {

namespace {

using Json = nlohmann::ordered_json;

Json schema_of(const Shape& shape, const base::FieldNote& note);

Json any_of(std::vector<Json> alternatives) {
  Json out;
  out["anyOf"] = std::move(alternatives);
  return out;
}

Json number_schema(const base::FieldNote& note, const char* type) {
  Json out = {{"type", type}};
  switch (note.range) {
    case base::Range::any:
      break;
    case base::Range::positive:
      out["exclusiveMinimum"] = 0;
      break;
    case base::Range::non_negative:
      out["minimum"] = 0;
      break;
    case base::Range::fraction:
      out["minimum"] = 0;
      out["maximum"] = 1;
      break;
    case base::Range::poisson:
      out["exclusiveMinimum"] = -1;
      out["maximum"] = 0.5;
      break;
  }
  return out;
}

/// Quantities with units and expressions are texts to a schema.
Json quantity_schema(const base::FieldNote& note, const char* type = "number") {
  return any_of({number_schema(note, type), Json{{"type", "string"}, {"minLength", 1}}});
}

Json marker_schema() {
  const Json point = {{"type", "array"},
                      {"minItems", 3},
                      {"maxItems", 3},
                      {"items", {{"type", {"number", "string"}}}}};
  const Json ground = {{"type", "object"},
                       {"properties", {{"ground", point}}},
                       {"required", {"ground"}},
                       {"additionalProperties", false}};
  return any_of({Json{{"type", "string"}, {"minLength", 1}}, ground});
}

std::string description(const FieldShape& field) {
  std::string out(field.note.doc);
  if (!field.note.any_dimension && !(field.note.dimension == base::kNumber)) {
    out += fmt::format(" [{}]", base::si_unit(field.note.dimension));
  }
  if (!field.standard.empty()) out += fmt::format(". Default: {}", field.standard);
  return out;
}

Json record_schema(const Shape& shape) {
  Json properties = Json::object();
  Json required = Json::array();
  for (const auto* list : {&shape.alternatives, &shape.fields}) {
    for (const FieldShape& field : *list) {
      Json property = schema_of(field.shape, field.note);
      property["description"] = description(field);
      properties[std::string(field.note.name)] = std::move(property);
      if (field.note.is_required) required.push_back(field.note.name);
    }
  }
  Json out = {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  if (!required.empty()) out["required"] = required;
  for (const FieldShape& alternative : shape.alternatives) {
    out["oneOf"].push_back({{"required", Json::array({alternative.note.name})}});
  }
  return out;
}

Json record_or_shorthand_schema(const Shape& shape) {
  const FieldShape* shorthand = shape.shorthand();
  if (shorthand == nullptr) return record_schema(shape);
  Json single = schema_of(shorthand->shape, shorthand->note);
  if (shorthand->note.name.empty()) return single;
  std::vector<Json> all = {std::move(single)};
  if (const FieldShape* list = shape.list_shorthand()) {
    all.push_back(schema_of(list->shape, list->note));
  }
  all.push_back(record_schema(shape));
  return any_of(std::move(all));
}

Json list_schema(const Shape& shape, const base::FieldNote& note) {
  Json out = {{"type", "array"}, {"items", schema_of(shape.element[0], note)}};
  if (shape.count >= 0) {
    out["minItems"] = shape.count;
    out["maxItems"] = shape.count;
  }
  return out;
}

/// A number, an expression, or a table, whose points may stand in a file.
Json time_law_schema(const Shape& shape) {
  Json table = record_schema(shape.element[0]);
  Json& points = table["properties"]["table"];
  const Json text = points["description"];
  points.erase("description");
  points = any_of({Json{{"type", "string"}, {"minLength", 1}}, points});
  points["description"] = text;
  return any_of({Json{{"type", "number"}}, Json{{"type", "string"}, {"minLength", 1}}, table});
}

Json schema_of(const Shape& shape, const base::FieldNote& note) {
  switch (shape.kind) {
    case Shape::Kind::quantity:
      return quantity_schema(note);
    case Shape::Kind::integer:
      return quantity_schema(note, "integer");
    case Shape::Kind::frame_division: {
      Json out = quantity_schema(note, "integer");
      out["examples"] = shape.choices;
      return out;
    }
    case Shape::Kind::text:
      return {{"type", {"string", "number"}}};
    case Shape::Kind::truth:
      if (note.is_switch) return Json{{"enum", {"on", "off", true, false}}};
      return {{"type", "boolean"}};
    case Shape::Kind::choice:
      return {{"enum", shape.choices}};
    case Shape::Kind::time_law:
      return time_law_schema(shape);
    case Shape::Kind::position_law:
      return {{"type", {"number", "string"}}};
    case Shape::Kind::marker:
      return marker_schema();
    case Shape::Kind::word_or_marker:
      return any_of({Json{{"enum", shape.choices}}, marker_schema()});
    case Shape::Kind::list:
      if (!takes_single_text(shape)) return list_schema(shape, note);
      return any_of({schema_of(shape.element[0], note), list_schema(shape, note)});
    case Shape::Kind::reference:
      return any_of({Json{{"type", "string"}, {"minLength", 1}}, record_schema(shape.element[0])});
    case Shape::Kind::named:
      return {{"type", "object"},
              {"additionalProperties", record_or_shorthand_schema(shape.element[0])}};
    case Shape::Kind::record:
      break;
  }
  return record_or_shorthand_schema(shape);
}

}  // namespace

std::string model_schema_json() {
  Json out = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
              {"title", "Buckens model file"},
              {"description",
               "Flexible multibody model, format 1. Plain numbers are SI; texts may "
               "carry units."}};
  out.update(record_schema(model_file_shape()));
  out["properties"]["buckens"] = {{"const", 1}, {"description", "version of the file format"}};
  return out.dump(1) + "\n";
}

}  // namespace buckens::model_file
