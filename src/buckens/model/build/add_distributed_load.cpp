// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/add_distributed_load.h"

#include <cmath>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/nearest.h"
#include "buckens/fem/assembly/uniform_shares.h"
#include "buckens/loads/distributed_load.h"
#include "buckens/loads/pressure_load.h"
#include "buckens/model/build/find_factor.h"
#include "buckens/model/build/load_place.h"

namespace buckens::model {

using Eigen::Vector3d;
using linalg::Triplet;
using loads::LoadSpec;

namespace {

// Share of the area by which faces across the plane may be off it by rounding.
constexpr double kAcross = 1e-9;

constexpr const char* kArea = "m^2";
constexpr const char* kLength = "m";
constexpr const char* kMass = "kg";
constexpr const char* kVolume = "m^3";

template <class Kind>
constexpr bool kIsDistributed =
    std::is_same_v<Kind, loads::PressureSpec> || std::is_same_v<Kind, loads::TractionSpec> ||
    std::is_same_v<Kind, loads::LineLoadSpec> || std::is_same_v<Kind, loads::BodyForceSpec> ||
    std::is_same_v<Kind, loads::BaseAccelerationSpec>;

void add_faces(const LoadedFaces& faces, LoadShares& shares) {
  for (const fem::ElementFace& face : faces.solids) shares.add_face(face);
  for (const fem::ShellSide& side : faces.shells) shares.add_side(side);
}

std::vector<Triplet> scaled(const std::vector<Triplet>& entries, double factor) {
  std::vector<Triplet> out;
  out.reserve(entries.size());
  for (const Triplet& entry : entries) {
    out.emplace_back(entry.row(), entry.col(), factor * entry.value());
  }
  return out;
}

}  // namespace

bool DistributedLoads::takes(const LoadSpec& spec) {
  return std::visit([]<class Kind>(const Kind&) { return kIsDistributed<Kind>; }, spec.kind);
}

void DistributedLoads::add(const LoadSpec& spec) {
  std::visit(
      [&]<class Kind>(const Kind& kind) {
        if constexpr (kIsDistributed<Kind>) add_kind(spec, kind);
      },
      spec.kind);
}

DistributedLoads::Place DistributedLoads::place(const LoadSpec& spec,
                                                const loads::BodyPart& on) const {
  const std::string body = on.body();
  const int whole = model_.find_whole(body);
  if (whole >= 0) return {static_cast<std::size_t>(whole), &on};
  std::vector<std::string> names;
  for (const WholeBody& known : model_.wholes) names.push_back(known.name);
  throw InputError(on.where, fmt::format("load \"{}\": there is no body \"{}\".{}", spec.name, body,
                                         base::suggestion(body, names)));
}

DistributedLoads::Place DistributedLoads::place_on_mesh(const LoadSpec& spec,
                                                        const loads::BodyPart& on) const {
  const Place found = place(spec, on);
  if (meshes_[found.whole]) return found;
  throw InputError(
      on.where, fmt::format("load \"{}\": body \"{}\" is rigid and has no mesh to take a {}; put "
                            "a `force` or `torque` on a marker, or a `body-force` per mass",
                            spec.name, on.body(), spec.kind_name()));
}

LoadShares DistributedLoads::shares_of(const Place& place) const {
  return {model_, model_.wholes[place.whole], *meshes_[place.whole], divisions_[place.whole].get()};
}

void DistributedLoads::require_in_plane(const LoadSpec& spec,
                                        const std::array<base::TimeLaw, 3>& value) const {
  if (!model_.planar) return;
  const int normal = spatial::normal_index(*model_.planar);
  const base::TimeLaw& law = value[static_cast<std::size_t>(normal)];
  if (law.is_constant() && law.value(0) == 0.0) return;
  throw InputError(spec.where, fmt::format("load \"{}\": in a planar model loads act in the plane; "
                                           "set component {} to zero, or leave `planar` out",
                                           spec.name, "xyz"[normal]));
}

void DistributedLoads::require_in_plane(const LoadSpec& spec, const LoadShares& shares) const {
  if (!model_.planar) return;
  const int normal = spatial::normal_index(*model_.planar);
  double across = 0, area = 0;
  for (const auto& [b, share] : shares.shares()) {
    across += share.normals[normal];
    area += share.extent;
  }
  if (std::abs(across) <= kAcross * area) return;
  throw InputError(
      spec.where,
      fmt::format("load \"{}\": in a planar model loads act in the plane, and this pressure has a "
                  "resultant along {}; apply it to faces normal to the plane, or remove `planar`",
                  spec.name, "xyz"[normal]));
}

void DistributedLoads::require_extent(const LoadSpec& spec, const Place& place,
                                      const LoadShares& shares, const char* what) const {
  for (const auto& [b, share] : shares.shares()) {
    if (share.extent > 0.0) return;
  }
  throw InputError(
      place.on->where,
      fmt::format("load \"{}\" on \"{}\": there is no {} to take it; name elements that have "
                  "some, or give a `force` on a marker or a `body-force` `per-mass` on the whole "
                  "body",
                  spec.name, place.on->text, what));
}

void DistributedLoads::add_uniform(const LoadSpec& spec, const Place& place,
                                   const LoadShares& shares, const Uniform& load) {
  require_in_plane(spec, *load.value);
  require_extent(spec, place, shares, load.extent);
  for (const auto& [b, share] : shares.shares()) {
    if (!(share.extent > 0.0)) continue;
    Load out;
    out.name = spec.name;
    out.kind = spec.kind_name();
    const Vector3d at = share.middle();
    out.first.body = b;
    out.first.text = place.on->text;
    out.first.marker = tables_[static_cast<std::size_t>(b)]->add_region(
        "#load " + spec.name, at, scaled(share.rows, 1.0 / share.extent));
    out.region = {place.on->text, share.extent, load.extent_unit,
                  at - model_.bodies[static_cast<std::size_t>(b)].com, share.feet};
    out.unit = load.unit;
    out.element =
        std::make_unique<loads::DistributedLoad>(load.axes, *load.value, share.extent, load.factor);
    model_.loads.push_back(std::move(out));
  }
}

void DistributedLoads::add_to_frame(const LoadSpec& spec, int body, const std::string& text,
                                    const Uniform& load, double extent) {
  Load out;
  out.name = spec.name;
  out.kind = spec.kind_name();
  out.first.body = body;
  out.first.text = text;
  out.first.marker =
      tables_[static_cast<std::size_t>(body)]->add_region("#load " + spec.name, std::nullopt, {});
  out.region = {text, std::abs(extent), load.extent_unit, Vector3d::Zero(), {}};
  out.unit = load.unit;
  out.element =
      std::make_unique<loads::DistributedLoad>(load.axes, *load.value, extent, load.factor);
  model_.loads.push_back(std::move(out));
}

loads::SignalFactor DistributedLoads::factor_of(const LoadSpec& spec,
                                                const std::string& signal) const {
  return find_factor(model_, signal, spec.name, spec.where);
}

void DistributedLoads::add_kind(const LoadSpec& spec, const loads::PressureSpec& kind) {
  const Place on = place_on_mesh(spec, kind.on);
  const LoadPlaceFinder find(spec.name, kind.on, description_.bodies[on.whole], *meshes_[on.whole]);
  LoadShares shares = shares_of(on);
  add_faces(find.faces(), shares);
  require_in_plane(spec, shares);
  for (const auto& [b, share] : shares.shares()) {
    MarkerTable& table = *tables_[static_cast<std::size_t>(b)];
    const Vector3d& com = model_.bodies[static_cast<std::size_t>(b)].com;
    Load out;
    out.name = spec.name;
    out.kind = spec.kind_name();
    out.first.body = b;
    out.first.text = kind.on.text;
    out.first.marker = table.add_region("#load " + spec.name, std::nullopt, {});
    out.pattern_row = table.add_pattern(scaled(share.normal_row, -1.0 / share.extent));
    out.region = {kind.on.text, share.extent, kArea, share.middle() - com, share.feet};
    out.unit = "Pa";
    out.element = std::make_unique<loads::PressureLoad>(kind.value, share.extent, -share.normals,
                                                        com.cross(share.normals) - share.moments,
                                                        factor_of(spec, kind.factor));
    model_.loads.push_back(std::move(out));
  }
}

void DistributedLoads::add_kind(const LoadSpec& spec, const loads::TractionSpec& kind) {
  const Place on = place_on_mesh(spec, kind.on);
  const LoadPlaceFinder find(spec.name, kind.on, description_.bodies[on.whole], *meshes_[on.whole]);
  LoadShares shares = shares_of(on);
  add_faces(find.faces(), shares);
  add_uniform(spec, on, shares,
              {kind.axes, &kind.value, factor_of(spec, kind.factor), "area", kArea, "Pa"});
}

void DistributedLoads::add_kind(const LoadSpec& spec, const loads::LineLoadSpec& kind) {
  const Place on = place_on_mesh(spec, kind.on);
  const LoadPlaceFinder find(spec.name, kind.on, description_.bodies[on.whole], *meshes_[on.whole]);
  LoadShares shares = shares_of(on);
  for (const int line : find.lines().lines) {
    shares.add_line(line, fem::constant_quartic(1.0));
  }
  add_uniform(spec, on, shares,
              {kind.axes, &kind.value, factor_of(spec, kind.factor), "length", kLength, "N/m"});
}

void DistributedLoads::add_kind(const LoadSpec& spec, const loads::BodyForceSpec& kind) {
  const bool is_per_mass = kind.per_mass.has_value();
  const Uniform load{kind.axes,
                     is_per_mass ? &*kind.per_mass : &*kind.per_volume,
                     factor_of(spec, kind.factor),
                     is_per_mass ? "mass" : "volume",
                     is_per_mass ? kMass : kVolume,
                     is_per_mass ? "m/s^2" : "N/m^3"};
  if (is_per_mass && kind.on.part().empty()) {
    require_in_plane(spec, *load.value);
    const WholeBody& whole = model_.wholes[place(spec, kind.on).whole];
    for (int b = whole.first; b < whole.first + whole.count; ++b) {
      add_to_frame(spec, b, kind.on.text, load, model_.bodies[static_cast<std::size_t>(b)].mass);
    }
    return;
  }
  const Place on = place_on_mesh(spec, kind.on);
  const NamedStructure& mesh = *meshes_[on.whole];
  const LoadPlaceFinder find(spec.name, kind.on, description_.bodies[on.whole], mesh);
  LoadShares shares = shares_of(on);
  const LoadedElements elements = find.elements();
  for (const int line : elements.lines) {
    const fem::LineSection section = fem::line_section(mesh.structure, line);
    shares.add_line(line, is_per_mass ? section.mass_per_length : section.area);
  }
  for (const int solid : elements.solids) {
    shares.add_solid(solid, is_per_mass ? mesh.structure.solids.material(solid)->rho : 1.0);
  }
  for (const int shell : elements.shells) shares.add_shell(shell, is_per_mass);
  add_uniform(spec, on, shares, load);
}

void DistributedLoads::add_kind(const LoadSpec& spec, const loads::BaseAccelerationSpec& kind) {
  require_in_plane(spec, kind.value);
  const Uniform load{
      loads::LoadAxes::fixed, &kind.value, loads::SignalFactor(), "mass", kMass, "m/s^2"};
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    const int body = static_cast<int>(b);
    const WholeBody& whole = model_.wholes[static_cast<std::size_t>(model_.whole_of(body))];
    add_to_frame(spec, body, whole.name, load, -model_.bodies[b].mass);
  }
}

}  // namespace buckens::model
