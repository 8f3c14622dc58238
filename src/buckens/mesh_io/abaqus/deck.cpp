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
};

/// Keywords that change the mesh in ways that are not read: without them the body would be another.
constexpr std::string_view kRefused[] = {"NGEN",  "NCOPY",  "NFILL",  "NMAP",
                                         "ELGEN", "ELCOPY", "SYSTEM", "MODELCHANGE"};

/// Keywords that are passed over without a word.
constexpr std::string_view kSilent[] = {"HEADING", "PREPRINT", "ENDASSEMBLY"};

template <std::size_t n>
bool is_among(const std::string_view (&list)[n], const std::string& name) {
  return std::find(std::begin(list), std::end(list), name) != std::end(list);
}

/// Reads keyword by keyword and keeps track of parts, instances and steps.
class DeckReader {
 public:
  explicit DeckReader(const std::filesystem::path& path) : in_(path) {}

  fem::ImportedMesh run() {
    DeckKeyword keyword;
    check_beginning();
    while (in_.lines.next_keyword(keyword)) read(keyword);
    if (!open_.name.empty()) {
      in_.lines.fail(open_.place, fmt::format("{} has no {}; the file seems to be truncated",
                                              open_.written, end_of(open_.name)));
    }
    finish();
    return AbaqusMesh(in_.deck, in_.lines).run();
  }

 private:
  void check_beginning() {
    DeckRow row;
    if (!in_.lines.next_row(row)) return;
    in_.lines.fail(row.place,
                   "this line comes before any keyword; a deck of Abaqus or CalculiX begins with a "
                   "line such as *HEADING or *NODE");
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
    if (name == "STEP") return skip_step(keyword);
    if (name == "PART" || name == "INSTANCE") return open(keyword);
    if (name == "ENDPART" || name == "ENDINSTANCE") return close(keyword);
    if (name == "ASSEMBLY") {
      if (!open_.name.empty()) refuse_nested(keyword);
      return;
    }
    if (is_among(kSilent, name)) return;
    if (is_among(kRefused, name)) {
      in_.lines.fail(keyword.place,
                     fmt::format("{} is not supported; write the deck with all nodes "
                                 "and elements listed",
                                 keyword.written));
    }
    const auto* card = std::find_if(std::begin(kCards), std::end(kCards),
                                    [&](const NamedCard& known) { return known.name == name; });
    if (card != std::end(kCards)) return card->read(in_, keyword);
    in_.note(keyword.place, ignored(keyword));
  }

  static std::string ignored(const DeckKeyword& keyword) {
    static constexpr std::string_view kFromModel[] = {"BOUNDARY", "AMPLITUDE", "INITIALCONDITIONS",
                                                      "CLOAD",    "DLOAD",     "BASEMOTION"};
    static constexpr std::string_view kHolding[] = {"TIE",
                                                    "CONTACTPAIR",
                                                    "CONTACT",
                                                    "DISTRIBUTINGCOUPLING",
                                                    "EMBEDDEDELEMENT",
                                                    "NONSTRUCTURALMASS",
                                                    "SHELLTOSOLIDCOUPLING",
                                                    "FASTENER",
                                                    "RELEASE",
                                                    "NORMAL",
                                                    "BEAMSECTIONOFFSET",
                                                    "CENTROID",
                                                    "SHEARCENTER"};
    if (is_among(kFromModel, keyword.name)) {
      return fmt::format(
          "{} is ignored: loads, supports and initial values come from the model file",
          keyword.written);
    }
    if (is_among(kHolding, keyword.name)) {
      return fmt::format(
          "{} is ignored, although it changes how the parts hold together, how stiff they are or "
          "what they weigh",
          keyword.written);
    }
    return fmt::format("{} is ignored", keyword.written);
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
      in_.lines.fail(keyword.place, fmt::format("the instances have more than {} nodes, nodes of "
                                                "elements and members of sets together",
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
    if (!in_.deck.parts.empty() && in_.deck.instances.empty()) {
      in_.lines.fail({0, 0},
                     "the deck has parts but no *INSTANCE that places them in the *ASSEMBLY");
    }
    const bool has_nodes =
        !in_.deck.root.nodes.ids.empty() ||
        std::any_of(in_.deck.instances.begin(), in_.deck.instances.end(),
                    [](const auto& instance) { return !instance.scope.nodes.ids.empty(); });
    if (!has_nodes) {
      in_.lines.fail({0, 0},
                     "the file has no *NODE and so no mesh; is it a deck of Abaqus or "
                     "CalculiX?");
    }
    for (auto& [text, note] : in_.repeated) in_.deck.notes.push_back(note);
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
    for (const auto& [key, surface] : part.surfaces) count += 1 + surface.items.size();
    for (const AbaqusEquation& equation : part.equations) count += 1 + equation.terms.size();
    return count + part.sections.size() + part.links.size();
  }

  static constexpr std::size_t kMostEntries = 200'000'000;

  AbaqusReading in_;
  DeckKeyword open_;  ///< the *PART or *INSTANCE that has not ended; its name is empty otherwise
  std::set<std::string> instance_names_;
  std::size_t entries_of_instances_ = 0;
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

fem::ImportedMesh read_abaqus_deck(const std::filesystem::path& path) {
  return DeckReader(path).run();
}

}  // namespace buckens::mesh_io
