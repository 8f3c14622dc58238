// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/abaqus/deck.h"

#include <algorithm>
#include <numbers>
#include <set>
#include <string_view>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/base/nearest.h"
#include "buckens/mesh_io/abaqus/cards.h"
#include "buckens/mesh_io/abaqus/keywords.h"
#include "buckens/mesh_io/abaqus/mesh.h"

namespace buckens::mesh_io {

using Eigen::Vector3d;

namespace {

struct NamedCard {
  std::string_view name;
  AbaqusCard read;
};

constexpr NamedCard kCards[] = {
    {"NODE", read_nodes},
    {"ELEMENT", read_elements},
    {"NGEN", read_ngen},
    {"NFILL", read_nfill},
    {"NCOPY", read_ncopy},
    {"ELGEN", read_elgen},
    {"ELCOPY", read_elcopy},
    {"NSET", read_node_set},
    {"ELSET", read_element_set},
    {"SURFACE", read_surface},
    {"SOLIDSECTION", read_solid_section},
    {"SHELLSECTION", read_shell_section},
    {"SHELLGENERALSECTION", read_shell_section},
    {"BEAMSECTION", read_beam_section},
    {"BEAMGENERALSECTION", read_beam_general_section},
    {"MASS", read_mass},
    {"ROTARYINERTIA", read_rotary_inertia},
    {"ORIENTATION", read_orientation},
    {"TRANSFORM", read_transform},
    {"SYSTEM", read_system},
    {"SPRING", read_spring},
    {"MATERIAL", read_material},
    {"ELASTIC", read_elastic},
    {"DENSITY", read_density},
    {"DAMPING", read_damping},
    {"COUPLING", read_coupling},
    {"KINEMATIC", read_kinematic},
    {"DISTRIBUTING", read_distributing},
    {"KINEMATICCOUPLING", read_kinematic_coupling},
    {"RIGIDBODY", read_rigid_body},
    {"MPC", read_mpc},
    {"EQUATION", read_equation},
    {"TIE", read_tie},
    {"SURFACEINTERACTION", read_surface_interaction},
    {"SURFACEBEHAVIOR", read_surface_behavior},
    {"CONTACTPAIR", read_contact_pair},
    {"NODALTHICKNESS", read_nodal_thickness},
    {"DISTRIBUTION", read_distribution},
    {"DISTRIBUTINGCOUPLING", read_distributing_coupling},
};

/// Reads keyword by keyword and keeps track of parts, instances and steps.
class DeckReader {
 public:
  DeckReader(const std::filesystem::path& path, SkipList& skip) : in_(path, skip) {}

  fem::ImportedMesh run() {
    DeckKeyword keyword;
    check_beginning();
    while (in_.lines.next_keyword(keyword)) read(keyword);
    if (!open_.name.empty()) {
      in_.lines.fail(open_.place, fmt::format("{0} has no {1}; the file seems to be truncated (if "
                                              "it is whole, add {1} as its last line)",
                                              open_.written, end_of(open_.name)));
    }
    finish();
    return AbaqusMesh(in_.deck, in_.lines).run();
  }

 private:
  /// Some decks have a stray line before the first keyword; files that are not decks have many.
  void check_beginning() {
    DeckRow row;
    if (in_.lines.next_row(row)) before_keywords_ = row.place;
  }

  static std::string end_of(const std::string& name) { return "*END " + name; }

  void read(const DeckKeyword& keyword) {
    const std::string& name = keyword.name;
    const bool is_below_coupling = name == "KINEMATIC" || name == "DISTRIBUTING";
    if (in_.coupling != nullptr && !is_below_coupling) {
      in_.lines.fail(in_.coupling->place,
                     "*COUPLING must be followed by *KINEMATIC or "
                     "*DISTRIBUTING");
    }
    if (name.empty()) return in_.note(keyword.place, "a lone star is taken as a comment");
    if (in_.skip.takes(name, line_in_main(keyword.place))) return;
    if (is_below_coupling && in_.skip.has("COUPLING")) return;
    if (ends_part(name)) close_part(keyword);
    if (name == "STEP") return skip_step(keyword);
    if (name == "PART" || name == "INSTANCE") return open(keyword);
    if (name == "ENDPART" || name == "ENDINSTANCE") return close(keyword);
    if (name == "ASSEMBLY") {
      if (!open_.name.empty()) refuse_nested(keyword);
      return;
    }
    const auto* card = std::find_if(std::begin(kCards), std::end(kCards),
                                    [&](const NamedCard& known) { return known.name == name; });
    if (card != std::end(kCards)) return card->read(in_, keyword);
    pass_over(keyword);
  }

  /// Whether a *PART that is open must have ended before this keyword.
  bool ends_part(const std::string& name) const {
    return open_.name == "PART" &&
           (name == "STEP" || name == "PART" || name == "INSTANCE" || name == "ASSEMBLY");
  }

  void close_part(const DeckKeyword& next) {
    in_.note(open_.place,
             fmt::format("{} has no *END PART; it is assumed to end before {} in line {}",
                         open_.written, next.written, next.place.line));
    open_.name.clear();
    in_.scope = &in_.deck.root;
  }

  /// Lines of included files would mislead.
  static int line_in_main(DeckPlace place) { return place.file == 0 ? place.line : 0; }

  void pass_over(const DeckKeyword& keyword) {
    const auto note = [&](const char* what, bool is_expected) {
      in_.note(keyword.place, fmt::format("{} is ignored{}", keyword.written, what), is_expected);
    };
    switch (role_of_keyword(keyword.name)) {
      case KeywordRole::silent:
        return;
      case KeywordRole::elsewhere:
        return note(": loads, supports and initial values come from the model file", true);
      case KeywordRole::weightless:
        return note(": it has neither mass nor stiffness in a linear elastic body", true);
      case KeywordRole::nonlinear:
        return note(": materials are linear elastic", false);
      case KeywordRole::periodic:
        return note(": the body is the part of the model that the deck contains", false);
      case KeywordRole::holding:
        in_.lines.fail(keyword.place,
                       fmt::format("{} is not supported, and without it the body would have a "
                                   "different mesh, mass or stiffness{}",
                                   keyword.written, SkipList::remedy(keyword.written.substr(1))));
      case KeywordRole::unknown:
        return note(": this keyword is unknown", false);
    }
  }

  void skip_step(const DeckKeyword& step) {
    if (!open_.name.empty()) refuse_nested(step);
    DeckKeyword keyword;
    while (in_.lines.next_keyword(keyword)) {
      if (keyword.name != "ENDSTEP") continue;
      in_.note(step.place,
               "*STEP … *END STEP is ignored: loads, supports and output come from the model file",
               true);
      return;
    }
    in_.lines.fail(step.place, "*STEP has no *END STEP; the file seems to be truncated");
  }

  [[noreturn]] void refuse_nested(const DeckKeyword& keyword) {
    in_.lines.fail(
        keyword.place,
        fmt::format("{} appears within {}, which began at line {}; {} is missing", keyword.written,
                    open_.written, open_.place.line, end_of(open_.name)));
  }

  void open(const DeckKeyword& keyword) {
    if (!open_.name.empty()) refuse_nested(keyword);
    const std::string& name = in_.parameter(keyword, "NAME");
    if (keyword.name == "PART") {
      const auto [entry, is_new] = in_.deck.parts.try_emplace(upper(name));
      if (!is_new) {
        in_.lines.fail(keyword.place, fmt::format("part \"{}\" is defined a second time", name));
      }
      entry->second.name = name;
      in_.scope = &entry->second;
    } else {
      open_instance(keyword, name);
    }
    open_ = keyword;
  }

  void open_instance(const DeckKeyword& keyword, const std::string& name) {
    const std::string& part = in_.parameter(keyword, "PART");
    const auto found = in_.deck.parts.find(upper(part));
    if (found == in_.deck.parts.end()) {
      std::vector<std::string> known;
      for (const auto& [key, scope] : in_.deck.parts) known.push_back(scope.name);
      in_.lines.fail(keyword.place, fmt::format("there is no part \"{}\".{}", part,
                                                base::suggestion(part, known)));
    }
    if (!instance_names_.insert(upper(name)).second) {
      in_.lines.fail(keyword.place, fmt::format("instance \"{}\" is defined a second time", name));
    }
    entries_of_instances_ += entries_of(found->second);
    if (entries_of_instances_ > kMostEntries) {
      in_.lines.fail(
          keyword.place,
          fmt::format(
              "the instances have more than {} nodes, element nodes and set members in total",
              kMostEntries));
    }
    AbaqusInstance instance;
    instance.name = name;
    instance.scope = found->second;
    instance.place = keyword.place;
    DeckRow row;
    if (in_.lines.next_row(row)) {
      instance.translation = read_vector(in_.lines, row, 0, "translation");
      if (in_.lines.next_row(row)) read_rotation(row, instance);
    }
    in_.deck.instances.push_back(std::move(instance));
    in_.scope = &in_.deck.instances.back().scope;
  }

  /// Points a and b of the axis and an angle in degrees.
  void read_rotation(const DeckRow& row, AbaqusInstance& instance) {
    const Vector3d a = read_vector(in_.lines, row, 0, "point a of the axis");
    const Vector3d b = read_vector(in_.lines, row, 3, "point b of the axis");
    const double angle = in_.lines.number(row, 6, "angle of the rotation") * std::numbers::pi / 180;
    if ((b - a).norm() == 0.0) {
      in_.lines.fail(row.place, "the points a and b of the axis of rotation are the same");
    }
    instance.rotation = Eigen::AngleAxisd(angle, (b - a).normalized()).toRotationMatrix();
    instance.centre = a;
  }

  void close(const DeckKeyword& keyword) {
    if (keyword.name != "END" + open_.name) {
      in_.lines.fail(keyword.place, fmt::format("{} has no beginning", keyword.written));
    }
    open_.name.clear();
    in_.scope = &in_.deck.root;
  }

  void finish() {
    if (in_.coupling != nullptr) {
      in_.lines.fail(in_.coupling->place,
                     "*COUPLING must be followed by *KINEMATIC or "
                     "*DISTRIBUTING");
    }
    if (in_.deck.instances.empty()) place_parts();
    add_tied_contacts(in_);
    const bool has_nodes =
        !in_.deck.root.nodes.ids.empty() ||
        std::any_of(in_.deck.instances.begin(), in_.deck.instances.end(),
                    [](const auto& instance) { return !instance.scope.nodes.ids.empty(); });
    if (!has_nodes) refuse_without_nodes();
    if (before_keywords_) {
      in_.note(*before_keywords_, "lines before the first keyword are taken as comments");
    }
    for (auto& [text, note] : in_.repeated) in_.deck.notes.push_back(note);
  }

  [[noreturn]] void refuse_without_nodes() {
    if (before_keywords_) {
      in_.lines.fail(*before_keywords_,
                     "this line comes before any keyword, and there is no *NODE; a deck of Abaqus "
                     "or CalculiX begins with a line such as *HEADING or *NODE");
    }
    in_.lines.fail({0, 0},
                   "the file has no *NODE and so no mesh; is it a deck of Abaqus or CalculiX?");
  }

  /// Without an *ASSEMBLY parts are where they were drawn.
  void place_parts() {
    for (const auto& [key, part] : in_.deck.parts) {
      AbaqusInstance& instance = in_.deck.instances.emplace_back();
      instance.name = part.name;
      instance.scope = part;
    }
    if (in_.deck.parts.empty()) return;
    in_.deck.notes.push_back(
        {"the deck has parts but no *INSTANCE that places them; each is used once, where it was "
         "drawn",
         0, static_cast<int>(in_.deck.parts.size())});
  }

  /// What a copy of a part costs.
  static std::size_t entries_of(const AbaqusScope& part) {
    std::size_t count = 1 + part.nodes.ids.size();
    for (const AbaqusElements& block : part.elements)
      count += block.ids.size() + block.nodes.size();
    for (const auto* sets : {&part.node_sets, &part.element_sets}) {
      for (const auto& [key, set] : *sets) {
        for (const AbaqusSetPart& own : set.parts) {
          count += 1 + own.ids.size() + own.ranges.size() + own.names.size();
        }
      }
    }
    for (const auto* all : {&part.surfaces, &part.node_surfaces}) {
      for (const auto& [key, surface] : *all) count += 1 + surface.items.size();
    }
    for (const AbaqusEquation& equation : part.equations) count += 1 + equation.terms.size();
    return count + part.sections.size() + part.links.size();
  }

  static constexpr std::size_t kMostEntries = 200'000'000;

  AbaqusReading in_;
  DeckKeyword open_;  ///< the *PART or *INSTANCE that has not ended; its name is empty otherwise
  std::set<std::string> instance_names_;
  std::size_t entries_of_instances_ = 0;
  std::optional<DeckPlace> before_keywords_;  ///< the first line, if it is no keyword
};

}  // namespace

void AbaqusReading::note(DeckPlace place, const std::string& text, bool is_expected) {
  fem::ImportNote& entry = repeated[text];
  if (entry.text.empty()) {
    entry.text = text;
    if (place.file > 0) entry.text += fmt::format(" (in {})", lines.where(place).file);
    entry.line = place.line;
    entry.count = 0;
    entry.is_expected = is_expected;
  }
  ++entry.count;
}

const std::string& AbaqusReading::parameter(const DeckKeyword& keyword, const char* key) const {
  const std::string* value = keyword.find(key);
  if (value != nullptr && !value->empty()) return *value;
  lines.fail(keyword.place, fmt::format("{} needs the parameter {}=", keyword.written, key));
}

std::string AbaqusReading::optional_parameter(const DeckKeyword& keyword, const char* key) const {
  const std::string* value = keyword.find(key);
  return value == nullptr ? "" : *value;
}

fem::ImportedMesh read_abaqus_deck(const std::filesystem::path& path, SkipList& skip) {
  return DeckReader(path, skip).run();
}

fem::ImportedMesh read_abaqus_deck(const std::filesystem::path& path) {
  SkipList skip;
  return read_abaqus_deck(path, skip);
}

}  // namespace buckens::mesh_io
