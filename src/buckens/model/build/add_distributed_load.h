// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "buckens/loads/load_spec.h"
#include "buckens/loads/signal_factor.h"
#include "buckens/model/build/load_share.h"
#include "buckens/model/build/marker_table.h"
#include "buckens/model/spec/model_description.h"

namespace buckens::model {

/// Adds loads on parts of bodies to the model under construction: pressure, traction, line loads,
/// body forces, base acceleration.
///
/// A load that is uniform over its part becomes one on a marker at the mean position, whose three
/// rows give the mean displacement; pressure becomes one row. A load per mass on a whole body or on
/// the whole world accelerates the frames only and needs no rows. A body with several frames gets
/// one load for each frame with a share.
class DistributedLoads {
 public:
  using Meshes = std::vector<std::unique_ptr<NamedStructure>>;
  using Divisions = std::vector<std::unique_ptr<MeshDivision>>;
  using Tables = std::vector<std::unique_ptr<MarkerTable>>;

  /// @param meshes null for rigid bodies
  /// @param divisions null for bodies with one frame
  /// @param tables one per body of the model
  DistributedLoads(Model& model, const ModelDescription& description, const Meshes& meshes,
                   const Divisions& divisions, const Tables& tables)
      : model_(model),
        description_(description),
        meshes_(meshes),
        divisions_(divisions),
        tables_(tables) {}

  /// Whether the load is handled here; the others act on markers.
  static bool takes(const loads::LoadSpec& spec);

  /// @throws InputError or ModelError naming the load and its place in the file
  void add(const loads::LoadSpec& spec);

 private:
  void add_kind(const loads::LoadSpec& spec, const loads::PressureSpec& kind);
  void add_kind(const loads::LoadSpec& spec, const loads::TractionSpec& kind);
  void add_kind(const loads::LoadSpec& spec, const loads::LineLoadSpec& kind);
  void add_kind(const loads::LoadSpec& spec, const loads::BodyForceSpec& kind);
  void add_kind(const loads::LoadSpec& spec, const loads::BaseAccelerationSpec& kind);

  struct Place {
    std::size_t whole = 0;
    const loads::BodyPart* on = nullptr;
  };
  struct Uniform {
    loads::LoadAxes axes = loads::LoadAxes::fixed;
    const std::array<base::TimeLaw, 3>* value = nullptr;
    loads::SignalFactor factor;
    const char* extent = "";  ///< what it is: "area"
    const char* extent_unit = "";
    const char* unit = "";  ///< of the value
  };

  loads::SignalFactor factor_of(const loads::LoadSpec& spec, const std::string& signal) const;
  Place place(const loads::LoadSpec& spec, const loads::BodyPart& on) const;
  /// @throws InputError if the body is rigid
  Place place_on_mesh(const loads::LoadSpec& spec, const loads::BodyPart& on) const;
  LoadShares shares_of(const Place& place) const;
  void require_in_plane(const loads::LoadSpec& spec,
                        const std::array<base::TimeLaw, 3>& value) const;
  /// @throws InputError if a pressure has a resultant normal to the plane of the model
  void require_in_plane(const loads::LoadSpec& spec, const LoadShares& shares) const;
  /// @throws InputError if nothing there has area, length, mass or volume
  void require_extent(const loads::LoadSpec& spec, const Place& place, const LoadShares& shares,
                      const char* what) const;
  void add_uniform(const loads::LoadSpec& spec, const Place& place, const LoadShares& shares,
                   const Uniform& load);
  /// A uniform acceleration of all mass of a body.
  void add_to_frame(const loads::LoadSpec& spec, int body, const std::string& text,
                    const Uniform& load, double extent);

  Model& model_;
  const ModelDescription& description_;
  const Meshes& meshes_;
  const Divisions& divisions_;
  const Tables& tables_;
};

}  // namespace buckens::model
