// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/check/plausibility.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "buckens/model/check/body_extent.h"
#include "buckens/model/spec/description_member.h"

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

using Form = base::MemberType::Form;

/// Visits all fields of a description with their paths.
class Doubts {
 public:
  std::vector<Doubt> run(const base::Member& description) {
    visit_fields(description);
    return std::move(out_);
  }

 private:
  void visit_fields(const base::Member& record) {
    for (const base::Field& field : record.fields()) visit_field(field);
  }

  void visit_field(const base::Field& field) {
    const base::Dimension dimension = dimension_;
    dimension_ = field.note.dimension;
    below(field.note.name, [&] { visit(field.member); });
    dimension_ = dimension;
  }

  template <class Work>
  void below(std::string_view key, Work&& work) {
    const std::size_t length = path_.size();
    if (!key.empty() && !path_.empty()) path_ += '.';
    path_ += key;
    work();
    path_.resize(length);
  }

  // ---- members by their form
  void visit(const base::Member& member) {
    switch (member.type->form()) {
      case Form::value:
        return look_at_value(member);
      case Form::choice:
        return;
      case Form::record:
        return visit_record(member);
      case Form::reference:
        if (!member.type->name(member.at)->empty()) return;  // reported where it is defined
        [[fallthrough]];
      case Form::optional:
        for (const base::Member& part : member.parts()) visit(part);
        return;
      case Form::variant:
        return below(member.type->alternatives()[member.type->index(member.at)].key,
                     [&] { visit(member.parts().front()); });
      case Form::array:
      case Form::list:
        return visit_items(member.parts());
    }
  }

  void visit_items(const std::vector<base::Member>& items) {
    for (std::size_t k = 0; k < items.size(); ++k) {
      const std::string* name = items[k].type->name(items[k].at);
      below(name == nullptr ? fmt::to_string(k) : *name, [&] { visit(items[k]); });
    }
  }

  void visit_record(const base::Member& record) {
    if (const auto* material = record.get<fem::MaterialSpec>()) return look_at_material(*material);
    if (const auto* damping = record.get<fem::DampingSpec>()) return look_at_damping(*damping);
    if (const auto* body = record.get<body::BodySpec>()) return visit_body(record, *body);
    const SourceLocation where = where_;
    if (const SourceLocation* own = record.type->where(record.at)) where_ = *own;
    visit_fields(record);
    where_ = where;
    const auto* mesh = record.get<fem::MeshSpec>();
    if (mesh != nullptr && mesh->imported) look_at_file(*mesh);
  }

  void visit_body(const base::Member& record, const body::BodySpec& body) {
    if (body.like.empty()) {
      visit_fields(record);
      look_at_size(body);
      return;
    }
    // The rest is reported for the other body.
    for (const base::Field& field : record.fields()) {
      if (field.note.name == "at") visit_field(field);
    }
  }

  void look_at_value(const base::Member& member) {
    if (dimension_ != base::kAngle) return;
    if (const auto* number = member.get<double>()) look_at_angle(*number);
    if (const auto* law = member.get<base::TimeLaw>()) look_at_law(*law);
    if (const auto* law = member.get<base::SignalLaw>()) {
      if (!law->formula) look_at_law(law->law);
    }
    if (const auto* vector = member.get<Vector3d>()) {
      for (int k = 0; k < 3; ++k) below(fmt::to_string(k), [&] { look_at_angle((*vector)[k]); });
    }
  }

  void look_at_law(const base::TimeLaw& law) {
    if (law.is_constant()) look_at_angle(law.value(0));
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
        fmt::format("an angle of {:.4g} turns, since angles without a unit are in rad",
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

  void look_at_material(const fem::MaterialSpec& material) {
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
  return Doubts().run(description_member(description));
}

}  // namespace buckens::model
