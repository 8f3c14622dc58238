// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/coupling_level.h"

#include <array>
#include <utility>

namespace buckens::body {

namespace {

constexpr std::array kNamedLevels = {
    CouplingLevel::full,   CouplingLevel::first_order, CouplingLevel::none,  CouplingLevel::noquad,
    CouplingLevel::nocent, CouplingLevel::nocor,       CouplingLevel::nojvar};
/// In the order of CouplingTerm.
constexpr std::array<bool CouplingTerms::*, 7> kMembers = {
    &CouplingTerms::quad_ref, &CouplingTerms::jvar,  &CouplingTerms::cor_ref,
    &CouplingTerms::cent0,    &CouplingTerms::cent1, &CouplingTerms::cor_fe,
    &CouplingTerms::eul_fe};

CouplingTerms terms_of(CouplingLevel level) {
  CouplingTerms terms;
  switch (level) {
    case CouplingLevel::full:
      break;
    case CouplingLevel::first_order:
      return CouplingTerms::first_order();
    case CouplingLevel::none:
    case CouplingLevel::automatic:
      return CouplingTerms::none();
    case CouplingLevel::noquad:
      terms.quad_ref = false;
      break;
    case CouplingLevel::nocent:
      terms.cent0 = terms.cent1 = false;
      break;
    case CouplingLevel::nocor:
      terms.cor_ref = terms.cor_fe = false;
      break;
    case CouplingLevel::nojvar:
      terms.jvar = false;
      break;
  }
  return terms;
}

}  // namespace

void CouplingTerms::drop(CouplingTerm term) {
  this->*kMembers[static_cast<std::size_t>(term)] = false;
}

CouplingChoice::CouplingChoice(CouplingLevel chosen, std::vector<CouplingTerm> drop,
                               double auto_tolerance)
    : level(chosen),
      terms(terms_of(chosen)),
      is_automatic(chosen == CouplingLevel::automatic),
      tolerance(auto_tolerance),
      dropped(std::move(drop)) {
  for (const CouplingTerm term : dropped) terms.drop(term);
}

std::string to_string(CouplingLevel level) {
  switch (level) {
    case CouplingLevel::full:
      return "full";
    case CouplingLevel::first_order:
      return "first-order";
    case CouplingLevel::none:
      return "none";
    case CouplingLevel::automatic:
      return "auto";
    case CouplingLevel::noquad:
      return "noquad";
    case CouplingLevel::nocent:
      return "nocent";
    case CouplingLevel::nocor:
      return "nocor";
    case CouplingLevel::nojvar:
      break;
  }
  return "nojvar";
}

std::string to_string(CouplingTerm term) {
  constexpr std::array<const char*, 7> kNames = {"quad-ref", "jvar",   "cor-ref", "cent0",
                                                 "cent1",    "cor-fe", "eul-fe"};
  return kNames[static_cast<std::size_t>(term)];
}

std::string to_string(const CouplingTerms& terms) {
  if (terms.stiffening) {
    CouplingTerms inertial = terms;
    inertial.stiffening = false;
    return to_string(inertial) + ", geometric stiffness";
  }
  for (const CouplingLevel level : kNamedLevels) {
    if (terms_of(level) == terms) return to_string(level);
  }
  std::string out;
  for (std::size_t k = 0; k < kMembers.size(); ++k) {
    if (terms.*kMembers[k]) continue;
    out += (out.empty() ? "drop " : ", ") + to_string(static_cast<CouplingTerm>(k));
  }
  return out;
}

}  // namespace buckens::body
