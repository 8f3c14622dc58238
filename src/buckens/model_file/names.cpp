// SPDX-License-Identifier: Apache-2.0
#include "buckens/model_file/names.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/nearest.h"
#include "buckens/fem/generate_mesh.h"
#include "buckens/model_file/body_mesh.h"
#include "buckens/model_file/checks.h"
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

void check_markers(const body::BodySpec& body, const ReadPlace& place) {
  std::vector<std::string> places = marker_names(body);
  for (const auto& marker : body.markers) {
    if (std::count(places.begin(), places.end(), marker.name) > 1) {
      throw InputError(marker.where,
                       fmt::format("{}.markers: the name \"{}\" is taken by a node or "
                                   "predefined marker; choose another",
                                   place.path, marker.name));
    }
  }
  for (const auto& interface : body.interfaces) {
    if (std::count(places.begin(), places.end(), interface.name) == 1) continue;
    throw InputError(interface.where,
                     fmt::format("{}.interfaces: the name \"{}\" is taken by a node or "
                                 "predefined marker; choose another",
                                 place.path, interface.name));
  }
  for (const auto& marker : body.markers) {
    std::erase(places, marker.name);
  }
  for (const auto& marker : body.markers) {
    if (marker.at.empty() || is_numbered_node(body, marker.at) ||
        std::find(places.begin(), places.end(), marker.at) != places.end()) {
      continue;
    }
    throw InputError(
        marker.where,
        fmt::format("{}.markers.{}.at: body \"{}\" has no place \"{}\".{}", place.path, marker.name,
                    body.name, marker.at, base::suggestion(marker.at, places)));
  }
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

void check_keys(const ReadPlace& place, const std::vector<std::string>& known) {
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
    throw InputError(entry.where, what + "." + base::suggestion(entry.key, known));
  }
}

void check_name(const YamlEntry& entry, const std::string& path) {
  if (is_name(entry.key)) return;
  throw InputError(entry.where, fmt::format("{}: \"{}\" cannot be a name; use letters, digits, _ "
                                            "and -",
                                            path, entry.key));
}

void fail_unknown(const ReadPlace& place, const std::string& kind, const std::string& name,
                  const std::vector<std::string>& known) {
  const std::string rest =
      known.empty() ? fmt::format(" The model has no {}.", kind) : base::suggestion(name, known);
  fail(place, fmt::format("unknown {} \"{}\".{}", kind, shortened(name), rest));
}

std::vector<std::string> marker_names(const body::BodySpec& body) {
  std::vector<std::string> out = {"origin", "com"};
  if (std::holds_alternative<fem::BeamSpec>(body.kind)) {
    out.insert(out.end(), {"start", "mid", "end"});
  }
  if (const auto* structure = std::get_if<fem::StructureSpec>(&body.kind)) {
    for (const auto& node : structure->nodes) out.push_back(node.name);
  }
  if (const auto* mesh = std::get_if<fem::MeshSpec>(&body.kind)) {
    const auto names = fem::named_nodes(*mesh);
    out.insert(out.end(), names.begin(), names.end());
  }
  for (const auto& interface : body.interfaces) out.push_back(interface.name);
  for (const auto& marker : body.markers) out.push_back(marker.name);
  return out;
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
  if (out.is_ground()) {
    if (slash == std::string::npos) return out;
    fail(place,
         fmt::format("\"{}\": the ground has no markers; write {{ground: [x, y, z]}}", out.text));
  }
  const auto& bodies = context.model->bodies;
  const body::BodySpec* body = base::find_named(bodies, out.body);
  if (body == nullptr) {
    std::vector<std::string> known = names_of(bodies);
    known.push_back("ground");
    // "rod.start" where a slash is meant.
    const std::size_t mark = out.body.find_first_of(".:");
    const std::string head = out.body.substr(0, mark);
    if (mark != std::string::npos && base::find_named(bodies, head) != nullptr) {
      fail(place,
           fmt::format("unknown body \"{}\". Did you mean \"{}/{}\"? A slash stands before the "
                       "name of a marker",
                       out.text, head, out.text.substr(mark + 1)));
    }
    fail_unknown(place, "body", out.body, known);
  }
  if (slash == std::string::npos) return out;
  const std::vector<std::string> markers = marker_names(*body);
  if (std::find(markers.begin(), markers.end(), out.marker) == markers.end() &&
      !is_numbered_node(*body, out.marker)) {
    fail(place, fmt::format("body \"{}\" has no marker \"{}\".{}", out.body, out.marker,
                            base::suggestion(out.marker, markers)));
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
  if (body.name == "ground") fail(place, "\"ground\" means the world itself; choose another name");
  if (const auto* like = std::get_if<body::LikeSpec>(&body.kind)) {
    const auto& bodies = context.model->bodies;
    const body::BodySpec* other = base::find_named(bodies, like->body);
    if (other == nullptr) {
      fail({*place.node.find("like"), place.path + ".like"},
           fmt::format("unknown body \"{}\" (only bodies listed above this one can be named).{}",
                       like->body, base::suggestion(like->body, names_of(bodies))));
    }
    body.like = other->like.empty() ? other->name : other->like;
    take_over(other->markers, body.markers);
    take_over(other->interfaces, body.interfaces);
    if (!body.damping) body.damping = other->damping;
    // The variant's old content is destroyed here; nothing of it is used from now on.
    body.kind = std::variant(other->kind);
    // What the keys of this body ask for was judged before it was known what it is made of.
    if (const Finding found = problem(body, context)) {
      fail({place.node.deepest(found->key), join_path(place.path, found->key)}, found->text);
    }
  }
  load_body_mesh(body, context);
  if (body.is_rigid() && body.damping) {
    fail(place, "a rigid body has no damping of its own; remove the key \"damping\"");
  }
  if (body.is_rigid() && !body.interfaces.empty()) {
    fail(place, "a rigid body has no mesh and no interfaces; use `markers`");
  }
  check_markers(body, place);
}

void finish_entry(model::InitialBodySpec& initial, const ReadPlace& place, ReadContext& context) {
  const auto& bodies = context.model->bodies;
  const body::BodySpec* body = base::find_named(bodies, initial.name);
  if (body == nullptr) {
    throw InputError(initial.where,
                     fmt::format("{}: unknown body \"{}\".{}", place.path, initial.name,
                                 base::suggestion(initial.name, names_of(bodies))));
  }
  if (body->is_rigid() && initial.nodal_displacement) {
    throw InputError(initial.where, fmt::format("{}: body \"{}\" is rigid and has no nodes to "
                                                "displace; remove the key \"nodal-displacement\"",
                                                place.path, initial.name));
  }
  if (body->is_rigid() && initial.nodal_velocity) {
    throw InputError(initial.where, fmt::format("{}: body \"{}\" is rigid and has no nodal "
                                                "velocity; remove the key \"nodal-velocity\"",
                                                place.path, initial.name));
  }
}

}  // namespace buckens::model_file
