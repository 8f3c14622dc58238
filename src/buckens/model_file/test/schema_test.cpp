// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "buckens/base/test/source_directory.h"
#include "buckens/base/units.h"
#include "buckens/model_file/model_file.h"
#include "buckens/model_file/test/sample.h"
#include "buckens/model_file/yaml_tree.h"

namespace buckens::model_file {
namespace {

using Json = nlohmann::json;

std::string file_text(const std::string& name) {
  std::ifstream stream(std::string(buckens::test::kSourceDirectory) + "/" + name);
  std::ostringstream out;
  out << stream.rdbuf();
  return out.str();
}

TEST(ModelReference, CommittedFilesAreCurrent) {
  EXPECT_EQ(file_text("schema/model.schema.json"), model_schema_json())
      << "run: buckens schema > schema/model.schema.json";
  EXPECT_EQ(file_text("docs/reference/model-file.md"), model_reference_markdown())
      << "run: buckens reference > docs/reference/model-file.md";
}

TEST(ModelReference, TheKeysOfLawsOfTimeAreListedOnce) {
  const std::string page = model_reference_markdown();
  const std::size_t begin = page.find("**Laws of time**");
  const std::string laws = page.substr(begin, page.find("**Laws of signals**") - begin);
  const std::size_t head = laws.find("| key |");
  ASSERT_NE(head, std::string::npos);
  EXPECT_EQ(laws.find("| key |", head + 1), std::string::npos);
}

TEST(ModelReference, ItsExampleCanBeRead) {
  const std::string page = model_reference_markdown();
  const std::size_t begin = page.find("```yaml\n") + 8;
  const std::string example = page.substr(begin, page.find("```", begin) - begin);
  EXPECT_EQ(read_model_text(example, "page.yaml").bodies.size(), 1u);
}

Json to_json(const YamlNode& node) {
  if (node.is_list()) {
    Json out = Json::array();
    for (const auto& item : node.items) out.push_back(to_json(item));
    return out;
  }
  if (node.is_map()) {
    Json out = Json::object();
    for (const auto& entry : node.entries) out[entry.key] = to_json(entry.value);
    return out;
  }
  if (node.kind == YamlNode::Kind::null) return nullptr;
  if (node.is_quoted) return node.text;
  if (node.text == "true" || node.text == "false") return node.text == "true";
  if (const auto number = base::parse_number(node.text)) {
    if (*number == static_cast<double>(static_cast<int>(*number))) return static_cast<int>(*number);
    return *number;
  }
  return node.text;
}

bool has_type(const Json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "integer") return value.is_number_integer();
  return type == "number" && value.is_number();
}

bool matches_type(const Json& schema, const Json& value) {
  if (!schema.contains("type")) return true;
  const Json types = schema["type"].is_array() ? schema["type"] : Json::array({schema["type"]});
  return std::any_of(types.begin(), types.end(),
                     [&](const Json& type) { return has_type(value, type.get<std::string>()); });
}

/// First place where the value breaks the schema, "" if nowhere. Knows what our schema uses.
std::string first_violation(const Json& schema, const Json& value, const std::string& path);

std::string object_violation(const Json& schema, const Json& value, const std::string& path) {
  for (const auto& key : schema.value("required", Json::array())) {
    if (!value.contains(key.get<std::string>())) return path + ": misses " + key.dump();
  }
  for (const auto& [key, item] : value.items()) {
    const Json properties = schema.value("properties", Json::object());
    const Json other = schema.value("additionalProperties", Json(true));
    const Json& rule = properties.contains(key) ? properties[key] : other;
    if (rule.is_boolean() && !rule.get<bool>()) return path + ": unknown " + key;
    if (rule.is_boolean()) continue;
    const std::string found = first_violation(rule, item, path + "." + key);
    if (!found.empty()) return found;
  }
  return "";
}

std::string array_violation(const Json& schema, const Json& value, const std::string& path) {
  if (value.size() < schema.value("minItems", std::size_t{0})) return path + ": too short";
  if (value.size() > schema.value("maxItems", value.size())) return path + ": too long";
  for (std::size_t i = 0; i < value.size(); ++i) {
    const std::string found =
        first_violation(schema["items"], value[i], path + "." + std::to_string(i));
    if (!found.empty()) return found;
  }
  return "";
}

std::string number_violation(const Json& schema, const Json& value, const std::string& path) {
  const double x = value.get<double>();
  const bool is_low = schema.contains("minimum") && x < schema["minimum"].get<double>();
  const bool is_at_limit =
      schema.contains("exclusiveMinimum") && x <= schema["exclusiveMinimum"].get<double>();
  const bool is_high = schema.contains("maximum") && x > schema["maximum"].get<double>();
  return is_low || is_at_limit || is_high ? path + ": out of range" : "";
}

std::string first_violation(const Json& schema, const Json& value, const std::string& path) {
  if (!matches_type(schema, value)) return path + ": type of " + value.dump();
  if (schema.contains("const") && schema["const"] != value) return path + ": const";
  if (schema.contains("enum") &&
      std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end()) {
    return path + ": none of " + schema["enum"].dump();
  }
  for (const char* word : {"anyOf", "oneOf"}) {
    if (!schema.contains(word)) continue;
    const auto count = std::count_if(schema[word].begin(), schema[word].end(), [&](const Json& s) {
      return first_violation(s, value, path).empty();
    });
    if (count == 0 || (word == std::string("oneOf") && count != 1)) {
      return path + ": " + word + " for " + value.dump();
    }
  }
  if (value.is_object()) return object_violation(schema, value, path);
  if (value.is_array() && schema.contains("items")) return array_violation(schema, value, path);
  if (value.is_number()) return number_violation(schema, value, path);
  return "";
}

std::string violation(const std::string& text) {
  static const Json schema = Json::parse(model_schema_json());
  return first_violation(schema, to_json(parse_yaml(text, "t.yaml")), "");
}

TEST(ModelSchema, AcceptsAFileWithEveryKey) { EXPECT_EQ(violation(kSampleModel), ""); }

TEST(ModelSchema, RefusesWhatTheReaderRefuses) {
  using testing::HasSubstr;
  EXPECT_THAT(violation("bodies: {}"), HasSubstr("misses \"buckens\""));
  EXPECT_THAT(violation("buckens: 1\nbodies: {a: {rigd: {}}}"), HasSubstr("bodies.a"));
  EXPECT_THAT(violation("buckens: 1\nbodies: {a: {rigid: {mass: -1}}}"), HasSubstr("mass"));
  EXPECT_THAT(violation("buckens: 1\nbodies: {a: {rigid: {mass: 1, com: [1]}}}"),
              HasSubstr("too short"));
  EXPECT_THAT(violation("buckens: 1\nbodies: {a: {rigid: {mass: 1}, like: b}}"),
              HasSubstr("oneOf"));
  EXPECT_THAT(violation("buckens: 1\nbodies: {a: {rigid: {mass: 1}, coupling: half}}"),
              HasSubstr("anyOf for \"half\""));
  EXPECT_THAT(violation("buckens: 2\nbodies: {}"), HasSubstr("const"));
}

}  // namespace
}  // namespace buckens::model_file
