// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/nastran/materials.h"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::mesh_io {

namespace {

/// E, G and ν of MAT1, of which two are enough.
void read_moduli(const NastranCard& card, fem::MaterialSpec& out) {
  const bool has_E = !card.blank(1), has_G = !card.blank(2), has_nu = !card.blank(3);
  if ((has_E ? 1 : 0) + (has_G ? 1 : 0) + (has_nu ? 1 : 0) < 2 || (!has_E && !has_G)) {
    card.fail("give two of E, G and NU");
  }
  const double G = has_G ? card.positive(2) : 0.0;
  if (has_nu) out.nu = card.real(3);
  out.E = has_E ? card.positive(1) : 2.0 * (1.0 + out.nu) * G;
  if (!has_nu) out.nu = out.E / (2.0 * G) - 1.0;
  if (!(out.nu > -1.0 && out.nu < 0.5)) {
    card.fail(3, fmt::format("Poisson's ratio {:g} must lie between -1 and 0.5", out.nu));
  }
  if (has_E && has_G && has_nu) out.G = G;
}

fem::OrthotropicSpec read_mat8(const NastranCard& card) {
  fem::OrthotropicSpec out;
  out.E1 = card.positive(1);
  out.E2 = card.positive(2);
  out.E3 = out.E2;
  out.nu12 = card.real(3, 0.0);
  if (!(out.nu12 * out.nu12 * out.E2 < out.E1)) {
    card.fail(3, fmt::format("NU12 = {:g} is too large for E1/E2 = {:g}: the material would give "
                             "energy",
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
Eigen::Matrix<double, 6, 6> read_stiffness(const NastranCard& card) {
  Eigen::Matrix<double, 6, 6> C;
  int field = 1;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) {
      C(row, column) = C(column, row) = card.real(field++, 0.0);
    }
  }
  return C;
}

fem::OrthotropicSpec read_mat9(const NastranCard& card) {
  const Eigen::Matrix<double, 6, 6> C = read_stiffness(card);
  const double size = C.diagonal().cwiseAbs().maxCoeff();
  Eigen::Matrix<double, 6, 6> coupling = C;
  coupling.topLeftCorner<3, 3>().setZero();
  coupling.diagonal().setZero();
  // Eight digits of a small field: what is below is rounding of a turned matrix.
  if (!(coupling.cwiseAbs().maxCoeff() <= 1e-7 * size)) {
    card.fail(
        "it couples tension and shear; only materials with three planes of symmetry are "
        "supported, given in their axes (CORDM of PSOLID turns them)");
  }
  Eigen::Matrix3d normal = C.topLeftCorner<3, 3>();
  if (!(size > 0) || Eigen::LLT<Eigen::Matrix3d>(normal).info() != Eigen::Success ||
      !(C.diagonal().tail<3>().minCoeff() > 0)) {
    card.fail("its stiffness is not positive definite");
  }
  const Eigen::Matrix3d S = normal.inverse();
  fem::OrthotropicSpec out;
  out.E1 = 1.0 / S(0, 0);
  out.E2 = 1.0 / S(1, 1);
  out.E3 = 1.0 / S(2, 2);
  out.nu12 = -S(1, 0) / S(0, 0);
  out.nu13 = -S(2, 0) / S(0, 0);
  out.nu23 = -S(2, 1) / S(1, 1);
  out.G12 = C(3, 3);
  out.G23 = C(4, 4);
  out.G13 = C(5, 5);
  for (const double value : {out.E1, out.E2, out.E3}) {
    if (!(value > 0) || !std::isfinite(value)) card.fail("its stiffness is nearly singular");
  }
  return out;
}

double density(const NastranCard& card) {
  const int field = card.name == "MAT1" ? 4 : card.name == "MAT8" ? 7 : 22;
  const double rho = card.real(field, 0.0);
  if (rho < 0) card.fail(field, fmt::format("the density {:g} is negative", rho));
  return rho;
}

bool has_damping(const NastranCard& card) {
  const int field = card.name == "MAT1" ? 7 : card.name == "MAT8" ? 16 : 30;
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

bool NastranMaterials::has_directions(std::int64_t id) const {
  const auto entry = cards_.find(id);
  return entry != cards_.end() && entry->second->name != "MAT1";
}

std::string NastranMaterials::name(std::int64_t id, Use use, const std::string& user,
                                   const NastranPlace& place) {
  const auto entry = cards_.find(id);
  if (entry == cards_.end()) {
    throw InputError(place.where(), fmt::format("{}: there is no material {}", user, id));
  }
  const NastranCard& card = *entry->second;
  const bool fits = card.name == "MAT1" || (card.name == "MAT8" && use == Use::shell) ||
                    (card.name == "MAT9" && use == Use::solid);
  if (!fits) {
    throw InputError(
        place.where(),
        fmt::format("{}: material {} is a {}, which is not supported here; {}", user, id, card.name,
                    use == Use::solid   ? "use MAT1 or MAT9"
                    : use == Use::shell ? "use MAT1 or MAT8"
                                        : "use MAT1"));
  }
  const auto [taken, is_new] = taken_.try_emplace(id, specs_.size());
  if (is_new) specs_.push_back(convert(card));
  return specs_[taken->second].name;
}

fem::MaterialSpec NastranMaterials::convert(const NastranCard& card) {
  fem::MaterialSpec out;
  out.where = card.where();
  out.name = unique_name(card);
  if (card.name == "MAT1") read_moduli(card, out);
  if (card.name == "MAT8") {
    out.orthotropic = read_mat8(card);
    if (card.real(5, 0.0) == 0.0 || card.real(6, 0.0) == 0.0) {
      notes_->add("MAT8: G1Z or G2Z is blank (rigid across the shell); G12 is taken for it",
                  {card.file, card.line});
    }
  }
  if (card.name == "MAT9") out.orthotropic = read_mat9(card);
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
  const std::string name = given.empty() || used_names_.contains(given) ? card.label() : given;
  used_names_.insert(name);
  return name;
}

}  // namespace buckens::mesh_io
