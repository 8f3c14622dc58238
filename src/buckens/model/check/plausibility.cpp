// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/check/plausibility.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "buckens/model/check/body_extent.h"

namespace buckens::model {

using Eigen::Vector3d;

namespace {

constexpr double kFullTurn = 2.0 * std::numbers::pi;
constexpr double kLeastModulus = 1e6, kLargestModulus = 2e12;   // [Pa]: soft rubber to diamond
constexpr double kLeastDensity = 10.0, kLargestDensity = 25e3;  // [kg/m³]: foam to osmium
constexpr double kLeastExtent = 10e-6, kLargestExtent = 100.0;  // [m]
constexpr double kHighestFrequency = 1e6;                       // [Hz]

/// A unit that might have been meant.
struct Candidate {
  const char* name;
  double factor;       // to SI
  double least, most;  // SI values that speak for it
};

/// "7.85 g/cm^3" of the first candidate that makes sense of a number; empty: none does.
template <std::size_t n>
std::string likely_quantity(double value, const Candidate (&candidates)[n]) {
  for (const Candidate& unit : candidates) {
    const double si = std::abs(value) * unit.factor;
    if (si >= unit.least && si <= unit.most) return fmt::format("{:g} {}", value, unit.name);
  }
  return {};
}

constexpr Candidate kModulusUnits[] = {{"GPa", 1e9, 1e9, 1.3e12},
                                       {"MPa", 1e6, 1e8, 1.3e12},
                                       {"kPa", 1e3, 1e8, 1.3e12},
                                       {"MPa", 1e6, kLeastModulus, kLargestModulus}};
constexpr Candidate kDensityUnits[] = {{"g/cm^3", 1e3, 100.0, 23e3},
                                       {"tonne/mm^3", 1e12, 100.0, 23e3},
                                       {"kg/mm^3", 1e9, 100.0, 23e3},
                                       {"g/mm^3", 1e6, 100.0, 23e3}};
constexpr Candidate kLengthUnits[] = {{"mm", 1e-3, 1e-3, 50.0}, {"um", 1e-6, 1e-5, 1.0}};

/// Visits all fields of a description with their paths.
class Doubts {
 public:
  std::vector<Doubt> run(ModelDescription& model) {
    model.fields(*this);
    return std::move(out_);
  }

  template <class T>
  void operator()(const base::Field<T>& field) {
    const base::Dimension dimension = dimension_;
    dimension_ = field.note.dimension;
    below(field.note.name, [&] { visit(field.member); });
    dimension_ = dimension;
  }

 private:
  template <class Work>
  void below(const std::string& key, Work&& work) {
    const std::size_t length = path_.size();
    if (!key.empty()) path_ += (path_.empty() ? "" : ".") + key;
    work();
    path_.resize(length);
  }

  // ---- values by their kind
  void visit(double& value) {
    if (dimension_ == base::kAngle) look_at_angle(value);
  }
  void visit(Vector3d& value) {
    for (int k = 0; k < 3; ++k) below(fmt::to_string(k), [&] { visit(value[k]); });
  }
  void visit(base::TimeLaw& law) {
    double value = law.is_constant() ? law.value(0) : 0.0;
    visit(value);
  }
  void visit(base::SignalLaw& law) {
    if (!law.formula) visit(law.law);
  }
  void visit(base::Characteristic&) {}
  void visit(fem::MaterialSpec& material) { look_at_material(material); }
  void visit(fem::DampingSpec& damping) { look_at_damping(damping); }
  void visit(body::BodySpec& body) {
    if (body.like.empty()) {
      body.fields(*this);
      look_at_size(body);
    } else {
      below("at", [&] { visit(body.at); });  // the rest is reported for the other body
    }
  }
  template <class T>
  void visit(base::Reference<T>& reference) {
    if (reference.name.empty()) visit(reference.value);
  }
  template <class T>
  void visit(std::optional<T>& value) {
    if (value) visit(*value);
  }
  template <class... T>
  void visit(std::variant<T...>& value) {
    std::visit(
        [this]<class One>(One& alternative) { below(One::kKey, [&] { visit(alternative); }); },
        value);
  }
  template <class T, std::size_t n>
  void visit(std::array<T, n>& items) {
    for (std::size_t k = 0; k < n; ++k) below(fmt::to_string(k), [&] { visit(items[k]); });
  }
  template <class T>
  void visit(std::vector<T>& items) {
    for (std::size_t k = 0; k < items.size(); ++k) {
      std::string key = fmt::to_string(k);
      if constexpr (requires { items[k].name; }) key = items[k].name;
      below(key, [&] { visit(items[k]); });
    }
  }
  template <class T>
  void visit(T& value) {
    if constexpr (requires { value.fields(*this); }) {
      const SourceLocation where = where_;
      if constexpr (requires { value.where; }) where_ = value.where;
      value.fields(*this);
      where_ = where;
    }
    if constexpr (std::is_same_v<T, fem::MeshSpec>) {
      if (value.imported) look_at_file(value);
    }
  }

  // ---- what is implausible
  void add(const std::string& key, std::string text, std::string likely,
           bool only_without_unit = false) {
    below(key, [&] {
      out_.push_back({path_, where_, std::move(text), std::move(likely), only_without_unit});
    });
  }

  void look_at_modulus(const char* key, double E) {
    if (E == 0.0 || (E >= kLeastModulus && E <= kLargestModulus)) return;
    add(key, fmt::format("a modulus of {:.6g} Pa; solids have between 1 MPa and 2 TPa", E),
        likely_quantity(E, kModulusUnits));
  }

  void look_at_density(const char* key, double rho) {
    if (rho == 0.0 || (rho >= kLeastDensity && rho <= kLargestDensity)) return;
    add(key,
        fmt::format("a density of {:.6g} kg/m^3; solids have between 10 and 25000 kg/m^3", rho),
        likely_quantity(rho, kDensityUnits));
  }

  /// Angles are radians unless a unit is written.
  void look_at_angle(double angle) {
    if (std::abs(angle) <= kFullTurn * (1.0 + 1e-9)) return;
    add("",
        fmt::format("an angle of {:.4g} turns, since angles without unit are in rad",
                    angle / kFullTurn),
        fmt::format("{:g} deg", angle), true);
  }

  void look_at_damping(const fem::DampingSpec& damping) {
    for (std::size_t k = 0; k < damping.at.size(); ++k) {
      const double f = damping.at[k];
      if (f > kHighestFrequency) {
        add(fmt::format("at.{}", k), fmt::format("a frequency of {:g} Hz, above 1 MHz", f), "");
      }
    }
  }

  void look_at_material(fem::MaterialSpec& material) {
    const SourceLocation where = where_;
    where_ = material.where;
    look_at_modulus("E", material.E);
    if (material.G) look_at_modulus("G", *material.G);
    if (material.orthotropic) {
      const fem::OrthotropicSpec& o = *material.orthotropic;
      look_at_modulus("orthotropic.E1", o.E1);
      look_at_modulus("orthotropic.E2", o.E2);
      look_at_modulus("orthotropic.E3", o.E3);
      look_at_modulus("orthotropic.G12", o.G12);
      look_at_modulus("orthotropic.G13", o.G13);
      look_at_modulus("orthotropic.G23", o.G23);
    }
    look_at_density("rho", material.rho);
    if (material.damping) below("damping", [&] { look_at_damping(*material.damping); });
    where_ = where;
  }

  /// Constants of a file are in its units, which it does not state.
  void look_at_file(const fem::MeshSpec& mesh) {
    for (const fem::MaterialSpec& material : mesh.imported->materials) {
      const std::size_t before = out_.size();
      // Without elastic constants it takes those of the model file.
      if (material.E > 0.0) look_at_modulus("", material.E);
      look_at_density("", material.rho);
      for (std::size_t k = before; k < out_.size(); ++k) {
        out_[k].text = fmt::format("material \"{}\" of {} has {}", material.name,
                                   mesh.imported->file, out_[k].text);
        out_[k].likely = mesh.length_unit ? "" : "length-unit: mm";
      }
    }
  }

  void look_at_size(const body::BodySpec& body) {
    where_ = body.where;
    const double extent = body_extent(body);
    if (extent == 0.0) return;
    const auto* part = std::get_if<fem::GeometrySpec>(&body.kind);
    if (part != nullptr && part->size && *part->size > extent) {
      add("geometry.size",
          fmt::format("elements of {:g} m in a part of {:.4g} m", *part->size, extent),
          *part->size * 1e-3 < extent ? fmt::format("{:g} mm", *part->size) : "");
    }
    if (extent >= kLeastExtent && extent <= kLargestExtent) return;
    const bool is_large = extent > kLargestExtent;
    const auto* mesh = std::get_if<fem::MeshSpec>(&body.kind);
    std::string likely;
    if (mesh != nullptr && mesh->is_file()) {
      if (!mesh->length_unit && is_large) likely = "length-unit: mm";
    } else if (part == nullptr && is_large) {
      likely = likely_quantity(extent, kLengthUnits);
    }
    std::string key = std::visit([]<class T>(const T&) { return std::string(T::kKey); }, body.kind);
    if (key == fem::BeamSpec::kKey) key += ".to";
    if (key == fem::StructureSpec::kKey) key += ".nodes";
    add(key,
        fmt::format("a body of {:.4g} m, {}", extent,
                    is_large ? "more than 100 m" : "less than 10 um"),
        likely);
  }

  std::vector<Doubt> out_;
  std::string path_;
  SourceLocation where_;
  base::Dimension dimension_;
};

}  // namespace

std::vector<Doubt> doubtful_values(const ModelDescription& description) {
  ModelDescription copy = description;  // field lists return mutable members
  return Doubts().run(copy);
}

}  // namespace buckens::model
