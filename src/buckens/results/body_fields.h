// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/base/saved_values.h"
#include "buckens/model/build/field_places.h"
#include "buckens/results/field_layout.h"
#include "buckens/results/geometry.h"
#include "buckens/results/part_fields.h"

namespace buckens::results {

/// Fields over one body of the model file: strains, stresses and motion of its mesh at the places
/// requested in the model file.
///
/// Nodes of shells have the stresses of the side that the normal points to, and the larger von
/// Mises stress of both sides. Tensors are in the axes of the whole body's frame. The parts of a
/// divided body have separate places: nothing is averaged across a cut.
class BodyFields {
 public:
  /// @param model outlives the object, and so does the pool, which shares the work, or null
  BodyFields(const model::Model& model, const model::FieldPlaces& places,
             const model::FieldOutputSpec& spec, TaskPool* pool = nullptr);

  /// Whether nothing is recorded: bodies without solids and shells only have motion.
  bool is_empty() const { return at_nodes_.empty() && at_elements_.empty(); }
  bool has_extremes() const { return has_extremes_; }
  int whole() const { return whole_; }

  void add_channels(FieldLayout& layout) const;
  void add_places(GeometryBody& shape) const;

  /// Computes strains and stresses of a state. Cost: full meshes as fem::SolidStrains, reduced ones
  /// six numbers per place and mode.
  void evaluate_stresses(const model::State& state);
  /// Appends all fields of the state that was evaluated last.
  void append(const model::State& state, std::vector<double>& values) const;
  /// Compares the stresses evaluated last with the largest so far. @param t [s]
  void update_extremes(double t);
  void append_extremes(std::vector<double>& values) const;
  /// Saves or restores the largest so far. @throws InputError if it does not fit
  void visit_saved(const base::SaveVisit& visit);

 private:
  struct Largest {
    std::vector<double> nodes, node_times, elements, element_times;
  };

  void choose_quantities(const model::FieldOutputSpec& spec, bool has_solids, bool has_shells);
  void add_part(int body, const std::vector<bool>& wanted);
  void add_shell_places(const fem::FeModel& mesh, const std::vector<int>& nodes, PartFields& part);
  /// Puts strains and stresses of the surfaces of shells in their places.
  void add_shells(const PartFields& part, const linalg::Vector& d, fem::TensorColumns& strain,
                  fem::TensorColumns& stress);
  /// Von Mises stress of a column; at nodes of shells the larger one of both sides.
  double mises_at(const fem::TensorColumns& stress, Eigen::Index column) const;
  void append_motion(const model::State& state, model::FieldQuantity quantity,
                     std::vector<double>& values) const;
  void append_tensors(model::FieldQuantity quantity, const fem::TensorColumns& strain,
                      const fem::TensorColumns& stress, const std::vector<bool>& known,
                      std::vector<double>& values) const;

  const model::Model& model_;
  TaskPool* pool_;
  int whole_;
  std::vector<model::FieldQuantity> at_nodes_, at_elements_;
  bool has_stresses_ = false;
  bool has_extremes_ = false;
  std::vector<PartFields> parts_;
  std::vector<int> nodes_;        // of the whole mesh, one per place
  std::vector<int> elements_;     // of the whole mesh, ascending
  std::vector<bool> has_stress_;  // one per place: a solid or shell is there
  std::vector<bool> is_element_;  // all true, one per element
  fem::TensorColumns node_strain_, node_stress_, element_strain_, element_stress_;
  std::vector<double> shell_mises_;  // one per place, zero without shells
  Largest largest_;
};

}  // namespace buckens::results
