// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/mesh_model.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "buckens/mesh_io/tagged_mesh.h"

namespace buckens::mesh_io {

namespace {

using Eigen::Vector3d;

/// Text that YAML reads as a string whatever is in it.
std::string yaml_text(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out + '"';
}

/// A name as model files take it: letters, digits, _ and -.
std::string plain_name(const std::string& text) {
  std::string out;
  for (const char c : text) {
    out += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' ? c : '_';
  }
  return out.empty() ? "material" : out;
}

std::string vector_text(const Vector3d& v) {
  return fmt::format("[{}, {}, {}]", v.x(), v.y(), v.z());
}

struct SectionText {
  std::string operator()(const fem::CircleSpec& s) const {
    return fmt::format("{{circle: {{diameter: {}}}}}", s.diameter);
  }
  std::string operator()(const fem::TubeSpec& s) const {
    return fmt::format("{{tube: {{outer-diameter: {}, inner-diameter: {}}}}}", s.outer_diameter,
                       s.inner());
  }
  std::string operator()(const fem::RectangleSpec& s) const {
    return fmt::format("{{rectangle: {{width: {}, height: {}}}}}", s.width, s.height);
  }
  std::string operator()(const fem::BoxSpec& s) const {
    return fmt::format("{{box: {{width: {}, height: {}, thickness: {}}}}}", s.width, s.height,
                       s.thickness);
  }
  std::string operator()(const fem::GeneralSectionSpec& s) const {
    std::string points;
    for (const auto& point : s.stress_points) {
      points += fmt::format("{}[{}, {}]", points.empty() ? "" : ", ", point[0], point[1]);
    }
    if (!points.empty()) points = fmt::format(", stress-points: [{}]", points);
    return fmt::format(
        "{{general: {{A: {}, Iy: {}, Iz: {}, J: {}, shear-factor-y: {}, shear-factor-z: {}{}}}}}",
        s.A, s.Iy, s.Iz, s.J, s.shear_factor_y, s.shear_factor_z, points);
  }
};

constexpr std::array<const char*, 6> kLinkVariables = choice_names(fem::NodeVariable{});

/// Which variables a link takes, where it does not take all.
std::string variables_text(const std::array<bool, 6>& taken) {
  std::vector<std::string> which;
  for (std::size_t k = 0; k < 6; ++k) {
    if (taken[k]) which.emplace_back(kLinkVariables[k]);
  }
  return which.size() == 6 ? "" : fmt::format(", variables: [{}]", fmt::join(which, ", "));
}

class ModelText {
 public:
  explicit ModelText(const fem::ImportedMesh& si) : si_(si), groups_(property_groups(si)) {}

  MeshModel written(const std::string& mesh_file, const char* length) &&;

 private:
  /// Name of a material in the model file; with axes it is a material of its own.
  std::string material(const std::string& name, const fem::ImportedProperty* axes_of = nullptr);
  void add_material(const std::string& key, const fem::MaterialSpec& material,
                    const fem::ImportedProperty* axes_of);
  void add_properties();
  std::string solid_entry(const fem::ImportedProperty& property);
  std::string shell_entry(const fem::ImportedProperty& property);
  std::string line_entry(std::size_t number);
  std::string up_of(std::size_t property);
  void add_masses();
  void add_links();
  void add_springs();
  void note(const std::string& text) { out_.notes.push_back({text, 0, 1}); }
  std::string node(int index) const {
    return fmt::format("n{}", si_.node_ids[static_cast<std::size_t>(index)]);
  }
  std::string nodes(const std::vector<int>& indices) const {
    std::vector<std::string> out;
    for (const int index : indices) out.push_back(node(index));
    return fmt::format("[{}]", fmt::join(out, ", "));
  }

  const fem::ImportedMesh& si_;
  std::vector<std::string> groups_;  // by property
  std::map<std::pair<std::string, const fem::ImportedProperty*>, std::string> names_;
  std::set<std::string> taken_;
  std::string materials_, of_properties_, sections_, masses_, links_;
  MeshModel out_;
};

std::string ModelText::material(const std::string& name, const fem::ImportedProperty* axes_of) {
  const auto* found = base::find_named(si_.materials, name);
  if (found == nullptr) return {};
  if (!found->orthotropic) axes_of = nullptr;
  const auto [known, is_new] = names_.try_emplace({name, axes_of});
  if (!is_new) return known->second;
  if (!(found->E > 0) && !found->orthotropic) {
    note(fmt::format("material \"{}\" has no elastic constants and is left out", name));
    return {};
  }
  std::string key = plain_name(name);
  for (int k = 2; !taken_.insert(key).second; ++k) key = fmt::format("{}_{}", plain_name(name), k);
  known->second = key;
  add_material(key, *found, axes_of);
  return key;
}

void ModelText::add_material(const std::string& key, const fem::MaterialSpec& material,
                             const fem::ImportedProperty* axes_of) {
  materials_ += fmt::format("  {}:\n", key);
  if (material.orthotropic) {
    const fem::OrthotropicSpec& o = *material.orthotropic;
    Vector3d axis_1 = o.axis_1, axis_2 = o.axis_2;
    if (axes_of != nullptr) {
      axis_1 = *axes_of->axes * axis_1;
      axis_2 = *axes_of->axes * axis_2;
    }
    materials_ += fmt::format(
        "    orthotropic:\n      {{E1: {}, E2: {}, E3: {}, nu12: {}, nu13: {}, nu23: {}, G12: {}, "
        "G13: {}, G23: {},\n       axis-1: {}, axis-2: {}}}\n",
        o.E1, o.E2, o.E3, o.nu12, o.nu13, o.nu23, o.G12, o.G13, o.G23, vector_text(axis_1),
        vector_text(axis_2));
  } else {
    materials_ += fmt::format("    E: {}\n    nu: {}\n", material.E, material.nu);
    if (material.G) materials_ += fmt::format("    G: {}\n", *material.G);
  }
  materials_ += fmt::format("    rho: {}\n", material.rho);
  if (material.damping) {
    materials_ += fmt::format("    damping: {{mass: {}, stiffness: {}}}\n",
                              material.damping->alpha(), material.damping->beta());
  }
}

std::string ModelText::solid_entry(const fem::ImportedProperty& property) {
  return material(property.material, property.axes ? &property : nullptr);
}

std::string ModelText::shell_entry(const fem::ImportedProperty& property) {
  std::string out;
  if (property.layers.empty()) {
    if (!property.thickness) return {};
    out = fmt::format("thickness: {}", *property.thickness);
  } else {
    std::vector<std::string> layers;
    for (const fem::ImportedLayer& layer : property.layers) {
      const std::string of = material(layer.material);
      layers.push_back(fmt::format("{{thickness: {}, angle: {}{}}}", layer.thickness, layer.angle,
                                   of.empty() ? "" : ", material: " + of));
    }
    out = fmt::format("layers: [{}]", fmt::join(layers, ", "));
  }
  if (property.offset != 0) out += fmt::format(", offset: {}", property.offset);
  if (property.axes) {
    out += ", direction: " + vector_text(property.axes->col(0));
  } else if (property.along_first_side) {
    out += ", along-first-side: on";
  }
  const std::string of = material(property.material);
  if (!of.empty()) out += ", material: " + of;
  return out;
}

/// The direction of the local z axes of all beams of a property, if it is one.
std::string ModelText::up_of(std::size_t property) {
  std::optional<Vector3d> common;
  int others = 0;
  for (const fem::ImportedBlock& block : si_.blocks) {
    if (block.property != static_cast<int>(property)) continue;
    for (const Vector3d& up : block.up) {
      if (!common) common = up;
      // Directions are computed; below 1e-9 they differ by rounding.
      if ((up.normalized() - common->normalized()).norm() > 1e-9) ++others;
    }
  }
  if (others > 0) {
    out_.notes.push_back(
        {fmt::format("the beams of \"{}\" have their sections turned in several ways; `up` is that "
                     "of the first, divide them into groups",
                     groups_[property]),
         0, others});
  }
  return common ? ", up: " + vector_text(*common) : "";
}

std::string ModelText::line_entry(std::size_t number) {
  const fem::ImportedProperty& property = si_.properties[number];
  if (!property.section) return {};
  const bool is_bar = property.kind == fem::PropertyKind::bar;
  std::string out = fmt::format("{}: {}", is_bar ? "bar" : "beam",
                                std::visit(SectionText{}, property.section->shape));
  if (!is_bar && property.shear_flexible.value_or(false)) out += ", theory: timoshenko";
  if (!is_bar) out += up_of(number);
  const std::string of = material(property.material);
  if (!of.empty()) out += ", material: " + of;
  return out;
}

void ModelText::add_properties() {
  for (std::size_t p = 0; p < si_.properties.size(); ++p) {
    const fem::ImportedProperty& property = si_.properties[p];
    const std::string key = yaml_text(groups_[p]);
    if (property.kind == fem::PropertyKind::solid) {
      const std::string of = solid_entry(property);
      if (!of.empty()) of_properties_ += fmt::format("        {}: {}\n", key, of);
      continue;
    }
    const std::string entry =
        property.kind == fem::PropertyKind::shell ? shell_entry(property) : line_entry(p);
    if (!entry.empty()) {
      sections_ += fmt::format("        {}: {{{}}}\n", key, entry);
    } else {
      note(fmt::format("the file gives no section for \"{}\"; add it to `sections`", groups_[p]));
    }
  }
}

void ModelText::add_masses() {
  for (const fem::ImportedMass& point : si_.masses) {
    const Eigen::Matrix3d& J = point.inertia;
    masses_ += fmt::format("        - {{at: {}, mass: {}, inertia: [{}, {}, {}, {}, {}, {}]",
                           node(point.node), point.mass, J(0, 0), J(1, 1), J(2, 2), J(0, 1),
                           J(0, 2), J(1, 2));
    if (!point.offset.isZero(0.0)) masses_ += ", offset: " + vector_text(point.offset);
    masses_ += "}\n";
  }
}

void ModelText::add_links() {
  std::string rigid, averages, equations;
  int partial = 0;
  for (const fem::ImportedRigidLink& link : si_.rigid_links) {
    rigid += fmt::format("          - {{reference: {}, nodes: {}{}}}\n", node(link.reference),
                         nodes(link.nodes), variables_text(link.variables));
  }
  for (const fem::ImportedAverage& average : si_.averages) {
    averages += fmt::format("          - {{reference: {}, nodes: {}", node(average.reference),
                            nodes(average.nodes));
    if (!average.weights.empty()) {
      averages += fmt::format(", weights: [{}]", fmt::join(average.weights, ", "));
    }
    averages += variables_text(average.variables) + "}\n";
    const bool counts_all = std::all_of(average.components.begin(), average.components.end(),
                                        [](const auto& component) {
                                          return std::all_of(component.begin(), component.end(),
                                                             [](bool counts) { return counts; });
                                        });
    if (!counts_all) ++partial;
  }
  for (const fem::ImportedEquation& equation : si_.equations) {
    std::vector<std::string> terms;
    for (const auto& term : equation.terms) {
      terms.push_back(fmt::format("{{node: {}, variable: {}, coefficient: {}}}", node(term.node),
                                  kLinkVariables[static_cast<std::size_t>(term.variable)],
                                  term.coefficient));
    }
    equations += fmt::format("          - terms: [{}]\n", fmt::join(terms, ", "));
  }
  if (partial > 0) {
    out_.notes.push_back(
        {"averages in which only some components of nodes count are written with "
         "all components",
         0, partial});
  }
  if (!rigid.empty()) links_ += "        rigid:\n" + rigid;
  if (!averages.empty()) links_ += "        averages:\n" + averages;
  if (!equations.empty()) links_ += "        equations:\n" + equations;
}

void ModelText::add_springs() {
  std::string springs;
  int oblique = 0, to_ground = 0;
  for (const fem::ImportedSpring& spring : si_.springs) {
    if (spring.nodes[0] < 0 || spring.nodes[1] < 0) {
      ++to_ground;
      continue;
    }
    const Eigen::Matrix<double, 6, 1> k = spring.stiffness.diagonal();
    if (!spring.stiffness.isDiagonal(0.0)) {
      ++oblique;
      continue;
    }
    springs += fmt::format("          - {{between: [{}, {}], translation: {}, rotation: {}}}\n",
                           node(spring.nodes[0]), node(spring.nodes[1]), vector_text(k.head<3>()),
                           vector_text(k.tail<3>()));
  }
  if (!springs.empty()) links_ += "        springs:\n" + springs;
  if (oblique > 0) {
    out_.notes.push_back(
        {"springs whose axes are not those of the mesh cannot be written in a "
         "model file and are left out",
         0, oblique});
  }
  if (to_ground > 0) {
    out_.notes.push_back(
        {"springs to ground hold no free body and are left out; attach them by loads", 0,
         to_ground});
  }
}

MeshModel ModelText::written(const std::string& mesh_file, const char* length) && {
  add_properties();
  add_masses();
  add_links();
  add_springs();
  for (const fem::MaterialSpec& other : si_.materials) {
    const bool is_used = std::any_of(names_.begin(), names_.end(), [&](const auto& entry) {
      return entry.first.first == other.name;
    });
    if (!is_used) material(other.name);
  }
  std::string& out = out_.text;
  out = fmt::format(
      "# Written by `buckens convert` beside {}: what that file does not hold. Numbers are in SI "
      "units.\n# `buckens modes` on this file gives the frequencies of the part.\nbuckens: 1\n",
      mesh_file);
  if (!materials_.empty()) out += "materials:\n" + materials_;
  out += fmt::format("bodies:\n  part:\n    mesh:\n      file: {}\n      length-unit: {}\n",
                     yaml_text(mesh_file), length);
  if (!of_properties_.empty()) out += "      materials:\n" + of_properties_;
  if (!sections_.empty()) out += "      sections:\n" + sections_;
  if (of_properties_.empty() && sections_.empty()) {
    out += "      # material: the mesh file gave none\n";
  }
  if (!masses_.empty()) out += "      masses:\n" + masses_;
  if (!links_.empty()) out += "      links:\n" + links_;
  for (const fem::ImportNote& note : out_.notes) out += "# Note: " + note.text + "\n";
  return std::move(out_);
}

}  // namespace

MeshModel model_of_mesh(const fem::ImportedMesh& mesh, const std::string& mesh_file,
                        fem::LengthUnit length, fem::MassUnit mass) {
  const fem::ImportedMesh si = fem::in_si(mesh, fem::size_of(length), fem::size_of(mass));
  return ModelText(si).written(mesh_file, choice_names(length)[static_cast<std::size_t>(length)]);
}

}  // namespace buckens::mesh_io
