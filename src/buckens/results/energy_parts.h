// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "buckens/dynamics/forces.h"
#include "buckens/linalg/matrix_types.h"
#include "buckens/model/model.h"
#include "buckens/model/spec/sensor_spec.h"

namespace buckens::results {

/// A part of the work done on a model, of what is dissipated, or of what force laws hold.
struct EnergyPart {
  model::EnergyKind kind;
  std::string of;          ///< load, joint or body; empty for events
  std::string joint = {};  ///< on which a law acts
};

/// Which parts the energy account of a model has: all that can bring, take or hold energy. Loads
/// with one name share theirs, as the rows of a contact do.
class EnergyParts {
 public:
  explicit EnergyParts(const model::Model& model);

  /// To be called when Model::pair_loads have changed. Their parts are those of their group, which
  /// are there already.
  void follow_pairs(const model::Model& model);

  std::size_t size() const { return all_.size(); }
  const EnergyPart& operator[](std::size_t k) const { return all_[k]; }

  /// Parts of one load.
  struct OfLoad {
    std::size_t supplied, lost, rubbed, struck, stored;
  };
  const OfLoad& of_load(std::size_t load) const { return loads_[load]; }
  std::size_t of_body(std::size_t body) const { return bodies_[body]; }
  /// A joint whose rows may depend on time, with its part.
  struct OfDrive {
    int first_row, num_rows;
    std::size_t part;
  };
  const std::vector<OfDrive>& of_drives() const { return drives_; }
  std::size_t of_events() const { return events_; }
  std::size_t of_locks() const { return locks_; }

  /// Parts of this kind and name; `work` and `dissipated` are all of their parts.
  /// @param of load, joint or body; empty: all
  std::vector<std::size_t> find(model::EnergyKind kind, const std::string& of) const;
  /// Names that parts of this kind have.
  std::vector<std::string> names(model::EnergyKind kind) const;

  /// Writes what each load holds now into the parts of that. @pre `parts` has size()
  void set_stored(std::span<const dynamics::LoadPower> loads, linalg::Vector& parts) const;

 private:
  std::size_t add(model::EnergyKind kind, const std::string& of, const std::string& joint = {});
  OfLoad add_load(const model::Model& model, const model::Load& load);

  std::vector<EnergyPart> all_;
  std::map<std::pair<model::EnergyKind, std::string>, std::size_t> places_;
  std::vector<OfLoad> loads_;
  std::vector<std::size_t> bodies_;
  std::vector<OfDrive> drives_;
  std::size_t events_ = 0, locks_ = 0;
};

/// Whether a kind is one of energy that comes in, is dissipated, or is held by force laws.
bool is_work(model::EnergyKind kind);
bool is_dissipated(model::EnergyKind kind);
bool is_held(model::EnergyKind kind);

}  // namespace buckens::results
