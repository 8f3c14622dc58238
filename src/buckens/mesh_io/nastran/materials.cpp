// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/nastran/materials.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/mesh_io/symmetry_axes.h"

namespace buckens::mesh_io {

namespace {

/// E, G and ν of MAT1 as written, blank ones found from the others.
struct Moduli {
  double E = 0, G = 0, nu = 0;

  double usual_G() const { return E / (2.0 * (1.0 + nu)); }
  /// Whether G is that of E and ν but for rounding of the sum, or to five digits.
  bool is_exact() const { return std::abs(G - usual_G()) <= 1e-12 * usual_G(); }
  bool is_rounded() const { return std::abs(G - usual_G()) <= 1e-4 * usual_G(); }
};

Moduli read_moduli(const NastranCard& card) {
  const bool has_E = !card.blank(1), has_G = !card.blank(2), has_nu = !card.blank(3);
  if (!has_E && !has_G) card.fail("give two of E, G and NU");
  Moduli out;
  out.E = has_E ? card.real(1) : 0.0;
  out.G = has_G ? card.real(2) : 0.0;
  out.nu = has_nu ? card.real(3) : 0.0;  // of E or G alone Nastran takes 0
  if (!(out.E >= 0.0) || !(out.G >= 0.0) || !(out.E > 0.0 || out.G > 0.0)) {
    card.fail(fmt::format("E = {:g} and G = {:g} must not be negative, and one must be positive",
                          out.E, out.G));
  }
  if (out.E == 0.0) out.E = 2.0 * (1.0 + out.nu) * out.G;
  if (out.G > 0.0 && !has_nu) out.nu = out.E / (2.0 * out.G) - 1.0;
  if (out.G == 0.0) out.G = out.usual_G();
  return out;
}

bool is_possible(double nu) { return nu > -1.0 && nu < 0.5; }

fem::OrthotropicSpec read_mat8(const NastranCard& card) {
  fem::OrthotropicSpec out;
  out.E1 = card.positive(1);
  out.E2 = card.positive(2);
  out.E3 = out.E2;
  out.nu12 = card.real(3, 0.0);
  if (!(out.nu12 * out.nu12 * out.E2 < out.E1)) {
    card.fail(
        3,
        fmt::format("NU12 = {:g} is too large for E1/E2 = {:g}: the material would generate energy",
                    out.nu12, out.E1 / out.E2));
  }
  out.G12 = card.positive(4);
  out.G13 = card.real(5, 0.0);
  out.G23 = card.real(6, 0.0);
  // Blank or zero means rigid in shear across the shell, which no shell here is.
  for (double* G : {&out.G13, &out.G23}) {
    if (*G == 0.0) *G = out.G12;
    if (*G < 0.0) card.fail("G1Z and G2Z must be greater than zero");
  }
  return out;
}

/// Order of stresses in MAT9: xx, yy, zz, xy, yz, zx.
StiffnessMatrix read_stiffness(const NastranCard& card) {
  StiffnessMatrix C;
  int field = 1;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) {
      C(row, column) = C(column, row) = card.real(field++, 0.0);
    }
  }
  return C;
}

fem::OrthotropicSpec read_mat9(const NastranCard& card) {
  StiffnessMatrix C = read_stiffness(card);
  // Eight digits of a small field: what is below is rounding of a turned matrix.
  constexpr double kUncoupled = 1e-7, kTurnedDigits = 1e-4;
  std::optional<Eigen::Matrix3d> axes;
  if (C.cwiseAbs().maxCoeff() > 0 && !(coupling_of(C) <= kUncoupled)) {
    axes = symmetry_axes(C, kTurnedDigits);
    if (!axes) {
      card.fail(
          fmt::format("it couples tension and shear in all axes (in those given, by {:.2g} of its "
                      "largest constant); only materials with three planes of symmetry, in any "
                      "orientation, are supported. Remove the coupling terms",
                      coupling_of(C)));
    }
    C = in_axes(C, *axes);
  }
  auto out = orthotropic_constants(C);
  if (!out) card.fail("its stiffness is not positive definite");
  if (axes) {
    out->axis_1 = axes->col(0);
    out->axis_2 = axes->col(1);
  }
  for (const double value : {out->E1, out->E2, out->E3}) {
    if (!(value > 0) || !std::isfinite(value)) card.fail("its stiffness is nearly singular");
  }
  return *out;
}

/// MAT2 has the stiffness of plane stress: 11, 12, 13, 22, 23, 33. @return none if it is not
/// orthotropic in its axes
std::optional<fem::OrthotropicSpec> read_mat2(const NastranCard& card) {
  const double C11 = card.real(1, 0.0), C12 = card.real(2, 0.0), C22 = card.real(4, 0.0);
  const double C33 = card.real(6, 0.0);
  const double coupling = std::max(std::abs(card.real(3, 0.0)), std::abs(card.real(5, 0.0)));
  // Eight digits of a small field, as for MAT9.
  if (!(C11 > 0.0 && C22 > 0.0 && C33 > 0.0 && C11 * C22 > C12 * C12) ||
      coupling > 1e-7 * std::max(C11, C22)) {
    return std::nullopt;
  }
  fem::OrthotropicSpec out;
  out.E1 = C11 - C12 * C12 / C22;
  out.E2 = C22 - C12 * C12 / C11;
  out.E3 = out.E2;
  out.nu12 = C12 / C22;
  out.G12 = out.G13 = out.G23 = C33;
  return out;
}

double density(const NastranCard& card) {
  const int field = card.name == "MAT1"   ? 4
                    : card.name == "MAT2" ? 7
                    : card.name == "MAT8" ? 7
                                          : 22;
  const double rho = card.real(field, 0.0);
  if (rho < 0) card.fail(field, fmt::format("the density {:g} is negative", rho));
  return rho;
}

bool has_damping(const NastranCard& card) {
  const int field = card.name == "MAT1"   ? 7
                    : card.name == "MAT2" ? 12
                    : card.name == "MAT8" ? 16
                                          : 30;
  return !card.blank(field) && card.real(field) != 0.0;
}

}  // namespace

NastranMaterials::NastranMaterials(const NastranBulk& bulk, const NastranNames& names,
                                   NastranNotes& notes)
    : names_(&names), notes_(&notes), weight_to_mass_(bulk.weight_to_mass) {
  for (const char* type : {"MAT1", "MAT8", "MAT9", "MAT2", "MAT3", "MAT10"}) {
    for (const NastranCard& card : bulk.cards_named(type)) {
      const auto [entry, is_new] = cards_.try_emplace(card.id(0), &card);
      if (is_new) continue;
      card.fail(fmt::format("there is another material with this number: {} in {}:{}",
                            entry->second->name, entry->second->file->name, entry->second->line));
    }
  }
}

bool NastranMaterials::is_turned(const fem::MaterialSpec& material) {
  return material.orthotropic && (material.orthotropic->axis_1 != Eigen::Vector3d::UnitX() ||
                                  material.orthotropic->axis_2 != Eigen::Vector3d::UnitY());
}

bool NastranMaterials::is_turned(const std::string& name) const {
  const auto* found = base::find_named(specs_, name);
  return found != nullptr && is_turned(*found);
}

bool NastranMaterials::has_directions(std::int64_t id) const {
  const auto entry = cards_.find(id);
  return entry != cards_.end() && entry->second->name != "MAT1";
}

std::string NastranMaterials::lack(std::int64_t id, Use use, const std::string& user) const {
  const auto entry = cards_.find(id);
  if (entry == cards_.end()) return fmt::format("{}: the deck has no material {}", user, id);
  const NastranCard& card = *entry->second;
  const bool is_plane = card.name == "MAT8" || (card.name == "MAT2" && read_mat2(card));
  const bool fits = card.name == "MAT1" || (is_plane && use == Use::shell) ||
                    (card.name == "MAT9" && use == Use::solid);
  if (fits) return "";
  return fmt::format("{}: material {} is a {}{}, which is not supported here", user, id, card.name,
                     card.name == "MAT2" && use == Use::shell ? " that is not orthotropic" : "");
}

std::string NastranMaterials::name(std::int64_t id, Use use, const std::string& user,
                                   const NastranPlace& place) {
  const std::string reason = lack(id, use, user);
  if (!reason.empty()) throw InputError(place.where(), reason);
  const NastranCard& card = *cards_.at(id);
  const auto [taken, is_new] = taken_.try_emplace({id, variant(card, use)}, specs_.size());
  if (is_new) specs_.push_back(convert(card, use));
  return specs_[taken->second].name;
}

NastranMaterials::Variant NastranMaterials::variant(const NastranCard& card, Use use) const {
  if (card.name != "MAT1" || (use != Use::beam && use != Use::bar)) return Variant::usual;
  const Moduli moduli = read_moduli(card);
  if (!is_possible(moduli.nu)) return Variant::without_nu;
  return use == Use::beam && !moduli.is_exact() ? Variant::own_G : Variant::usual;
}

/// Nastran takes E and NU for solids and the plane stresses of shells, E and G for beams.
void NastranMaterials::set_moduli(const NastranCard& card, Use use, fem::MaterialSpec& out) {
  const Moduli moduli = read_moduli(card);
  out.E = moduli.E;
  out.nu = moduli.nu;
  const NastranPlace place{card.file, card.line};
  switch (variant(card, use)) {
    case Variant::own_G:
      out.G = moduli.G;
      return;
    case Variant::without_nu:
      notes_->add(
          "MAT1: Poisson's ratios that are not possible are left out; beams and bars do "
          "not need them",
          place);
      out.nu = 0.0;
      out.G = moduli.G;
      return;
    case Variant::usual:
      break;
  }
  if (!is_possible(moduli.nu)) {
    card.fail(3, fmt::format("Poisson's ratio {:g} must lie between -1 and 0.5", moduli.nu));
  }
  if (!moduli.is_rounded() && (use == Use::solid || use == Use::shell)) {
    notes_->add("MAT1: a G that does not follow from E and NU is left out for solids and shells",
                place);
  }
}

fem::MaterialSpec NastranMaterials::convert(const NastranCard& card, Use use) {
  fem::MaterialSpec out;
  out.where = card.where();
  out.name = unique_name(card);
  if (card.name == "MAT1") set_moduli(card, use, out);
  if (card.name == "MAT2") out.orthotropic = read_mat2(card);
  if (card.name == "MAT8") {
    out.orthotropic = read_mat8(card);
    if (card.real(5, 0.0) == 0.0 || card.real(6, 0.0) == 0.0) {
      notes_->add("MAT8: G1Z or G2Z is blank (rigid across the shell); G12 is taken for it",
                  {card.file, card.line});
    }
  }
  if (card.name == "MAT9") {
    out.orthotropic = read_mat9(card);
    if (is_turned(out)) {
      notes_->add(
          "MAT9: the coupling of tension and shear vanishes in other axes; the material is taken "
          "as orthotropic in those axes",
          {card.file, card.line});
    }
  }
  out.rho = density(card) * weight_to_mass_;
  if (has_damping(card)) {
    notes_->add(fmt::format("{}: structural damping GE is left out; give `damping` of a material "
                            "in the model file",
                            card.name),
                {card.file, card.line});
  }
  return out;
}

std::string NastranMaterials::unique_name(const NastranCard& card) {
  const std::string given = names_->material(card.id(0));
  std::string name = given.empty() || used_names_.contains(given) ? card.label() : given;
  if (!used_names_.insert(name).second) {
    name += " with other constants";
    used_names_.insert(name);
  }
  return name;
}

}  // namespace buckens::mesh_io
