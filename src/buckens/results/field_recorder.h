// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "buckens/base/saved_values.h"
#include "buckens/model/build/build_model.h"
#include "buckens/results/body_fields.h"
#include "buckens/results/interface_loads.h"
#include "buckens/results/record_sink.h"
#include "buckens/results/shell_fields.h"

namespace buckens::results {

/// What a record of fields needs besides the state.
struct FieldInstant {
  std::optional<double> stamp;             ///< time stamp of the record; default: the state's time
  const linalg::Vector* lambda = nullptr;  ///< multipliers of the joints; null: those of the state
  double load_factor = 1.0;                ///< of applied loads
};

/// Turns states into records of the fields requested in the model file, and keeps the largest von
/// Mises stress of every place.
class FieldRecorder {
 public:
  /// @param built outlives the object
  /// @throws InputError if nothing of what is requested exists: stresses need solids or shells,
  /// loads a place where something acts
  /// @param pool shares the work, or null; outlives the object. No bit depends on it
  explicit FieldRecorder(const model::BuiltModel& built, TaskPool* pool = nullptr);

  /// Nothing is requested.
  bool is_empty() const { return bodies_.empty() && shells_.empty() && loads_.empty(); }
  /// Whether the largest stresses are to be updated at every step.
  bool watches_steps() const;
  bool has_extremes() const { return !layout_.extremes.channels().empty(); }

  const FieldLayout& layout() const { return layout_; }
  void add_places(Geometry& geometry) const;

  /// Fields of a state; its stresses are included in the largest.
  Record record(const model::State& state, const FieldInstant& at = {});
  /// Updates the largest stresses with a state. Cost: as for record().
  void watch(const model::State& state);
  /// The largest so far, values of FieldLayout::extremes. @pre a state was seen
  std::vector<double> extremes() const;

  /// Saves or restores what later values depend on.
  /// @throws InputError where it does not fit
  void visit_saved(const base::SaveVisit& visit);

 private:
  const model::BuiltModel& built_;
  std::vector<BodyFields> bodies_;
  std::vector<ShellFields> shells_;
  std::vector<InterfaceLoads> loads_;
  FieldLayout layout_;
};

}  // namespace buckens::results
