// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace buckens::body {

/// The user's choice of inertial coupling terms between frame and nodal variables.
///
/// `full`: all terms, from the exact kinetic energy FM (13). `first_order`: those of a kinetic
/// energy with J₀ + J₁(d). `none`: the frame moves like that of a rigid body and the mesh vibrates
/// as at rest; this follows from a kinetic energy with J₀. `automatic`: starts with the cheapest
/// sufficient level and moves up during a run. The others omit single groups, as in figures 6 and 7
/// of the paper; they do not follow from a kinetic energy.
enum class CouplingLevel { full, first_order, none, automatic, noquad, nocent, nocor, nojvar };

/// A group of terms that can be omitted, docs/theory/08-coupling.md.
enum class CouplingTerm { quad_ref, jvar, cor_ref, cent0, cent1, cor_fe, eul_fe };

/// The included terms.
struct CouplingTerms {
  bool quad_ref = true;  ///< frame equation: everything quadratic in d, i.e. J₂, J̇₂, l, l̇
  bool jvar = true;      ///< frame equation: J(d) − J₀ in J ẇ and w × J w
  bool cor_ref = true;   ///< frame equation: J̇ w
  bool cent0 = true;     ///< mesh: centrifugal load of the undeformed body, FM (24)
  bool cent1 = true;     ///< mesh: centrifugal load of the deformation
  bool cor_fe = true;    ///< mesh: Coriolis load, FM (22)
  bool eul_fe = true;    ///< mesh: Euler load, FM (23)
  /// Mesh: stiffening by axial forces. Not an inertial coupling and not part of any level, but a
  /// similar load: it depends on all of d and is on the right-hand side.
  bool stiffening = false;

  static CouplingTerms none() { return {false, false, false, false, false, false, false}; }
  static CouplingTerms first_order() { return {false, true, true, true, false, false, false}; }

  void drop(CouplingTerm term);

  bool operator==(const CouplingTerms&) const = default;
  /// Whether the six numbers c_ab·d are needed, for J₁ or for loads on the deformed position.
  bool use_patterns() const { return jvar || cor_ref || cent0; }
  bool have_load() const { return cent1 || cor_fe || eul_fe || stiffening; }
  /// Whether terms depend on all of d, so that a step treats them as given and iterates.
  bool are_lagged() const { return quad_ref || have_load(); }
};

/// The coupling terms requested for a body.
struct CouplingChoice {
  CouplingLevel level = CouplingLevel::full;
  CouplingTerms terms;                ///< at the start
  bool is_automatic = false;          ///< may move up during a run
  double tolerance = 0.01;            ///< automatic: neglected relative to kept terms
  std::vector<CouplingTerm> dropped;  ///< in addition to those of the level

  CouplingChoice(CouplingLevel chosen = CouplingLevel::full,  // NOLINT: a level is a choice
                 std::vector<CouplingTerm> drop = {}, double auto_tolerance = 0.01);

  /// Whether c_ab·d may be needed at any time.
  bool may_use_patterns() const { return is_automatic || terms.use_patterns(); }
};

/// Name in the model file.
std::string to_string(CouplingLevel level);
std::string to_string(CouplingTerm term);
/// Name of a set of terms: that of a level, or "drop cent0, cent1".
std::string to_string(const CouplingTerms& terms);

}  // namespace buckens::body
