// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>

#include "buckens/base/field.h"
#include "buckens/base/source_location.h"

namespace buckens::body {

/// Whether deformation has inertia.
enum class Flexibility { elastic, quasi_static };

constexpr std::array<const char*, 2> choice_names(Flexibility) {
  return {"elastic", "quasi-static"};
}

/// Basis of free modes of the whole body.
struct FreeFreeSpec {
  SourceLocation where;
  int modes = 0;
  bool static_correction = true;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("modes", modes, "number of free vibrations, lowest first")
              .required()
              .positive()
              .shorthand()
              .like("8"));
    visit(base::field(
              "static-correction", static_correction,
              "adds the deformations by unit loads of joints and forces beyond these vibrations")
              .on_off());
  }
};

/// Basis of fixed-interface modes and constraint modes.
struct CraigBamptonSpec {
  SourceLocation where;
  std::optional<int> modes;
  std::optional<double> cutoff;  ///< [Hz]
  bool static_correction = true;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("modes", modes, "number of vibrations with held interfaces, lowest first")
              .non_negative()
              .shorthand()
              .like("12")
              .otherwise("give this or `cutoff`"));
    visit(base::field("cutoff", cutoff, "all vibrations with held interfaces up to this frequency")
              .in(base::kFrequency)
              .positive()
              .like("2 kHz")
              .otherwise("give this or `modes`"));
    visit(base::field("static-correction", static_correction,
                      "adds the deformations by centrifugal loads beyond these shapes")
              .on_off());
  }
};

/// Reduced basis of a flexible body. At most one of the three is given.
struct ReductionSpec {
  SourceLocation where;
  double tolerance = 0;  ///< of the choice by trial runs; 0: no trial runs
  std::optional<FreeFreeSpec> free_free;
  std::optional<CraigBamptonSpec> craig_bampton;
  std::string file;  ///< stores the basis between runs, empty: none

  bool is_none() const { return !free_free && !craig_bampton && !is_automatic(); }
  bool is_automatic() const { return tolerance > 0.0; }

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("auto", tolerance,
                      "`craig-bampton` with as many modes as needed for all markers to move as on "
                      "the full mesh in a trial run, within this fraction of the largest motion")
              .positive()
              .or_word("none")
              .shorthand()
              .like("1 %")
              .otherwise("`none`"));
    visit(base::field("free-free", free_free, "free vibrations of the whole body").like("8"));
    visit(base::field("craig-bampton", craig_bampton,
                      "vibrations with held interfaces, and deformations by displaced interfaces")
              .like("{cutoff: 2 kHz}"));
    visit(base::field("file", file,
                      "HDF5 file that stores the basis between runs, relative to the model file")
              .like("rod.basis.h5")
              .otherwise("none"));
  }
};

}  // namespace buckens::body
