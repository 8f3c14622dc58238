// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/reduce_bodies.h"

#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/body/of_body.h"
#include "buckens/body/reduction.h"
#include "buckens/body/reduction_conflict.h"

namespace buckens::model {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// The choice of a basis in words: part of the key under which it is kept. It includes everything
/// that a basis depends on, including changed rules.
std::string describe(const body::BodySpec& spec) {
  const body::ReductionSpec& r = spec.reduction;
  std::string out =
      spec.flexibility == body::Flexibility::quasi_static ? "quasi-static" : "elastic";
  out += " whole-groups";
  if (r.free_free) {
    out += fmt::format(" free-free {} {}", r.free_free->modes, r.free_free->static_correction);
  }
  if (r.craig_bampton) {
    const body::CraigBamptonSpec& c = *r.craig_bampton;
    out += fmt::format(" craig-bampton {} {} {}", c.modes.value_or(-1), c.cutoff.value_or(0.0),
                       c.static_correction);
  }
  return out;
}

body::ReducedBasis make_basis(const body::BodySpec& spec, const body::Body& body) {
  const body::FlexiblePart& part = *body.flexible;
  const double length = body.length_scale();
  const body::ReductionSpec& r = spec.reduction;
  if (part.is_quasi_static) {
    return body::quasi_static_basis(body.name, part, r.free_free ? r.free_free->modes : 0, length);
  }
  if (r.free_free) {
    return body::free_free_basis(body.name, part, r.free_free->modes,
                                 r.free_free->static_correction, length);
  }
  const body::CraigBamptonSpec& c = *r.craig_bampton;
  body::CraigBamptonChoice choice;
  choice.modes = c.modes;
  choice.cutoff = kTurn * c.cutoff.value_or(0.0);
  choice.static_correction = c.static_correction;
  return body::craig_bampton_basis(body.name, part, choice, length);
}

std::string basis_name(const body::BodySpec& spec) {
  if (spec.flexibility == body::Flexibility::quasi_static) return "quasi-static";
  return spec.reduction.free_free ? "free-free" : "craig-bampton";
}

/// A basis kept before; files that cannot be used are errors, told with the place of the body.
std::optional<body::ReducedBasis> find_kept(const body::BodySpec& spec, std::uint64_t key,
                                            body::BasisStore& store) {
  const auto told = [&](const Error& error) {
    return fmt::format("body \"{}\": {}", spec.name, error.text());
  };
  try {
    return store.find(spec.reduction.file, key);
  } catch (const InputError& error) {
    throw InputError(spec.where, told(error));
  } catch (const IoError& error) {
    throw IoError(spec.where, told(error));
  }
}

/// Modes that are asked for, 0: as many as there are below a frequency.
int asked_modes(const body::ReductionSpec& reduction) {
  if (reduction.free_free) return reduction.free_free->modes;
  return reduction.craig_bampton ? reduction.craig_bampton->modes.value_or(0) : 0;
}

void reduce_body(const body::BodySpec& spec, body::Body& body, body::BasisStore* store) {
  body.flexible->is_quasi_static = spec.flexibility == body::Flexibility::quasi_static;
  const bool is_kept = store != nullptr && !spec.reduction.file.empty();
  const std::uint64_t key = is_kept ? body::basis_key(*body.flexible, describe(spec)) : 0;
  std::optional<body::ReducedBasis> basis;
  if (is_kept) basis = find_kept(spec, key, *store);
  if (basis && basis->Z.rows() != body.flexible->fe.dofs.num_dofs) {
    throw IoError(spec.where, fmt::format("body \"{}\": {}: the reduced basis in it has {} rows, "
                                          "but the body has {} nodal variables; remove the file",
                                          spec.name, spec.reduction.file, basis->Z.rows(),
                                          body.flexible->fe.dofs.num_dofs));
  }
  if (!basis) {
    basis = body::of_body(body.name, [&] { return make_basis(spec, body); });
    if (is_kept) store->keep(spec.reduction.file, key, *basis);
  }
  if (basis->Z.cols() == 0) {
    throw ModelError(
        spec.where,
        fmt::format("body \"{}\" has no deformation that a reduction could keep; make it rigid",
                    body.name));
  }
  body.flexible = body::reduce(body.name, *body.flexible, *basis);
  body.flexible->reduction.basis = basis_name(spec);
}

/// Says where a basis has fewer or more vibrations than were asked for.
void note_other_count(const body::BodySpec& spec, const body::ReductionFigures& found,
                      std::vector<std::string>& notes) {
  const int asked = asked_modes(spec.reduction);
  if (found.modes < asked) {
    notes.push_back(
        fmt::format("body \"{}\": {} modes were requested; its mesh has only {}, and all of them "
                    "are in the basis",
                    spec.name, asked, found.modes));
  }
  if (asked > 0 && found.modes > asked) {
    notes.push_back(
        fmt::format("body \"{}\": {} modes were requested; {} are in the basis, because those at "
                    "{:.6g} Hz share one frequency and must be kept together",
                    spec.name, asked, found.modes, found.highest_mode / kTurn));
  }
}

}  // namespace

void reduce_bodies(const ModelDescription& description, Model& model, body::BasisStore* store) {
  for (std::size_t w = 0; w < model.wholes.size(); ++w) {
    const body::BodySpec& spec = description.bodies[w];
    if (const auto conflict = body::reduction_conflict(spec)) {
      throw InputError(spec.where, fmt::format("body \"{}\": {}", spec.name, conflict->text));
    }
    const bool is_quasi_static = spec.flexibility == body::Flexibility::quasi_static;
    if (spec.reduction.is_none() && !is_quasi_static) continue;
    if (spec.reduction.is_automatic()) {
      throw InputError(spec.where, fmt::format("body \"{}\": `reduction: auto` is chosen by trial "
                                               "runs before the model is built; give the number of "
                                               "modes",
                                               spec.name));
    }
    body::Body& body = model.bodies[static_cast<std::size_t>(model.wholes[w].first)];
    reduce_body(spec, body, store);
    note_other_count(spec, body.flexible->reduction, model.notes);
    if (!is_quasi_static) continue;
    model.notes.push_back(
        fmt::format("body \"{}\" is quasi-static: it does not vibrate, and work done on its "
                    "deformation is not part of the energy balance",
                    spec.name));
  }
}

}  // namespace buckens::model
