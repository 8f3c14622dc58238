// SPDX-License-Identifier: Apache-2.0
#include "buckens/model_file/names.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/nearest.h"
#include "buckens/model/check/marker_names.h"
#include "buckens/model/check/spec_findings.h"
#include "buckens/model_file/body_mesh.h"
#include "buckens/model_file/contact_files.h"
#include "buckens/model_file/wishes.h"

namespace buckens::model_file {

namespace {

bool is_name(const std::string& name) {
  const auto is_allowed = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-' || c >= 0x80;
  };
  return !name.empty() && std::all_of(name.begin(), name.end(), is_allowed);
}

/// {ground: [x, y, z]}
base::MarkerRef read_ground_point(const ReadPlace& place, const ReadContext& context) {
  check_keys(place, {"ground"});
  const YamlNode* point = place.node.find("ground");
  base::MarkerRef out;
  out.body = "ground";
  out.where = place.node.where;
  base::FieldNote note;
  note.dimension = base::kLength;
  if (point == nullptr || !point->is_list() || point->items.size() != 3) {
    fail(place, "a point of the ground needs three coordinates, such as {ground: [100 mm, 0, 0]}");
  }
  out.point.emplace();
  for (int i = 0; i < 3; ++i) {
    const YamlNode& item = point->items[static_cast<std::size_t>(i)];
    (*out.point)[i] =
        read_quantity({item, fmt::format("{}.ground.{}", place.path, i)}, note, context);
  }
  out.text =
      fmt::format("ground [{:g}, {:g}, {:g}]", out.point->x(), out.point->y(), out.point->z());
  return out;
}

}  // namespace

namespace {

/// Within braces a comma ends a value, and what follows it is taken for a key.
bool is_cut_at_comma(const YamlEntry& entry) {
  const bool begins_like_number =
      !entry.key.empty() && std::isdigit(static_cast<unsigned char>(entry.key[0])) != 0;
  return entry.value.kind == YamlNode::Kind::null &&
         (begins_like_number || entry.key.find(')') != std::string::npos);
}

}  // namespace

void check_keys(const ReadPlace& place, const std::vector<std::string_view>& known) {
  for (const YamlEntry& entry : place.node.entries) {
    if (std::find(known.begin(), known.end(), entry.key) != known.end()) continue;
    const std::string what = fmt::format("unknown key \"{}\"{}", entry.key,
                                         place.path.empty() ? "" : " in " + place.path);
    if (is_cut_at_comma(entry)) {
      throw InputError(entry.where,
                       what +
                           ": within braces a comma ends a value; write decimals with a point "
                           "(1.5) and put expressions with commas in quotes (\"max(1, 2)\")");
    }
    if (const auto advice = advice_on_key(entry.key, place.path)) {
      throw InputError(entry.where, what + ": " + *advice);
    }
    throw InputError(entry.where,
                     what + "." + base::suggestion(entry.key, {known.begin(), known.end()}));
  }
}

void check_name(const YamlEntry& entry, const std::string& path) {
  if (is_name(entry.key)) return;
  throw InputError(entry.where, fmt::format("{}: \"{}\" cannot be a name; use letters, digits, _ "
                                            "and -",
                                            path, entry.key));
}

namespace {

/// Rounded constants of the materials that models name most often, to be shown in an example.
struct CommonMaterial {
  const char* name;
  const char* constants;
};
constexpr CommonMaterial kCommonMaterials[] = {
    {"steel", "{E: 210 GPa, nu: 0.3, rho: 7850 kg/m^3}"},
    {"aluminium", "{E: 70 GPa, nu: 0.33, rho: 2700 kg/m^3}"},
    {"aluminum", "{E: 70 GPa, nu: 0.33, rho: 2700 kg/m^3}"},
    {"titanium", "{E: 110 GPa, nu: 0.34, rho: 4500 kg/m^3}"},
    {"magnesium", "{E: 45 GPa, nu: 0.35, rho: 1750 kg/m^3}"},
    {"brass", "{E: 100 GPa, nu: 0.35, rho: 8500 kg/m^3}"},
    {"copper", "{E: 120 GPa, nu: 0.34, rho: 8900 kg/m^3}"},
};

/// How an entry that a model lacks is written: two lines of the model file.
std::string example_of(std::string_view kind, const std::string& name) {
  std::string key = is_name(name) ? name : fmt::format("my-{}", kind);
  if (kind == "section")
    return fmt::format("sections:\n  {}: {{circle: {{diameter: 20 mm}}}}", key);
  if (kind != "material") return "";
  const auto* common = std::find_if(
      std::begin(kCommonMaterials), std::end(kCommonMaterials),
      [&](const CommonMaterial& known) { return base::edit_distance(name, known.name) == 0; });
  const bool is_common = common != std::end(kCommonMaterials);
  return fmt::format("materials:\n  {}: {}{}", key,
                     is_common ? common->constants : kCommonMaterials[0].constants,
                     is_common ? "" : "  # those of steel");
}

}  // namespace

void fail_unknown(const ReadPlace& place, std::string_view kind, const std::string& name,
                  const std::vector<std::string>& known) {
  std::string rest = base::suggestion(name, known);
  if (known.empty()) {
    rest = fmt::format(" The model has no {}", kind);
    const std::string example = example_of(kind, name);
    rest += example.empty() ? "."
                            : fmt::format(
                                  "; nothing is built in. Write at the left margin, with "
                                  "your own values:\n{}",
                                  example);
  }
  fail(place, fmt::format("unknown {} \"{}\".{}", kind, shortened(name), rest));
}

void fail_if_found(const model::Found& found, const ReadPlace& place) {
  if (!found) return;
  fail({place.node.deepest(found->field_path), join_path(place.path, found->field_path)},
       found->text);
}

base::MarkerRef read_marker(const ReadPlace& place, const ReadContext& context) {
  if (place.node.is_map()) return read_ground_point(place, context);
  if (!place.node.is_scalar() || place.node.text.empty()) {
    fail(place, fmt::format("expected a marker such as ground, rod, rod/end or {{ground: [100 mm, "
                            "0, 0]}}, found {}",
                            place.node.description()));
  }
  base::MarkerRef out;
  out.where = place.node.where;
  out.text = place.node.text;
  const std::size_t slash = out.text.find('/');
  out.body = out.text.substr(0, slash);
  if (slash != std::string::npos) out.marker = out.text.substr(slash + 1);
  if (slash != std::string::npos && out.marker.empty()) {
    fail(place, fmt::format("\"{}\": the name of a marker is missing after the slash", out.text));
  }
  if (const model::Found found = model::marker_problem(out, *context.model, context.bodies)) {
    fail(place, found->text);
  }
  return out;
}

model::DeflectionBase read_deflection_base(const ReadPlace& place, const ReadContext& context) {
  using model::DeflectionBase;
  if (place.node.is_scalar() && place.node.text == "chord") return DeflectionBase::chord;
  if (place.node.is_scalar() && place.node.text == "frame") return DeflectionBase::frame;
  DeflectionBase out(DeflectionBase::other);
  out.marker = read_marker(place, context);
  return out;
}

namespace {

/// Puts those of another body before one's own; those of the same name are replaced.
template <class Named>
void take_over(const std::vector<Named>& others, std::vector<Named>& own) {
  std::vector<Named> all = others;
  for (const Named& entry : own) {
    std::erase_if(all, [&](const auto& m) { return m.name == entry.name; });
    all.push_back(entry);
  }
  own = std::move(all);
}

}  // namespace

void finish_entry(model::ParameterSpec& parameter, const ReadPlace& place, ReadContext& context) {
  const auto& reserved = base::reserved_names();
  if (!base::is_identifier(parameter.name)) {
    fail(place, fmt::format("\"{}\" cannot be used in expressions; use letters, digits and _",
                            parameter.name));
  }
  if (std::find(reserved.begin(), reserved.end(), parameter.name) != reserved.end()) {
    fail(place, fmt::format("\"{}\" already has a meaning in expressions; choose another name",
                            parameter.name));
  }
  context.parameters[parameter.name] = parameter.value;
}

void finish_entry(body::BodySpec& body, const ReadPlace& place, ReadContext& context) {
  if (const auto* like = std::get_if<body::LikeSpec>(&body.kind)) {
    const auto& bodies = context.model->bodies;
    const body::BodySpec* other = context.bodies.find(bodies, like->body);
    if (other == nullptr) {
      fail({*place.node.find("like"), place.path + ".like"},
           fmt::format("unknown body \"{}\" (only bodies listed above this one can be named).{}",
                       like->body, base::suggestion(like->body, model::names_of(bodies))));
    }
    body.like = other->like.empty() ? other->name : other->like;
    take_over(other->markers, body.markers);
    take_over(other->interfaces, body.interfaces);
    if (!body.damping) body.damping = other->damping;
    // The variant's old content is destroyed here; nothing of it is used from now on.
    body.kind = std::variant(other->kind);
    // The keys of this body were checked before it was known what it is made of.
    fail_if_found(model::problem(body, *context.model), place);
  }
  load_body_mesh(body, context);
  fail_if_found(model::problem_when_complete(body, *context.model), place);
}

void finish_entry(loads::LoadSpec& load, const ReadPlace& /*place*/, ReadContext& context) {
  load_contact_files(load, context);
}

void finish_entry(model::InitialBodySpec& initial, const ReadPlace& place, ReadContext& context) {
  fail_if_found(model::problem_when_complete(initial, *context.model), place);
}

}  // namespace buckens::model_file
