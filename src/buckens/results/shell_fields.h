// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "buckens/base/saved_values.h"
#include "buckens/fem/shell/recovery.h"
#include "buckens/model/build/field_places.h"
#include "buckens/results/field_layout.h"

namespace buckens::results {

/// Stresses and forces of the shells of one body of the model file, at their centres and in the
/// axes of each shell.
///
///     fields/bodies/<body>/shells/von_mises     {n}        larger one of both sides
///     fields/bodies/<body>/shells/stress        {n, 2L, 3} bottom and top of each layer, upwards
///     fields/bodies/<body>/shells/section_force {n, 8}     forces and moments per length
///
/// Rows are all n shells of the body in order: places on it only select bodies. L is the largest
/// number of layers; entries an element does not have are NaN.
class ShellFields {
 public:
  /// @param model outlives the object
  ShellFields(const model::Model& model, const model::FieldPlaces& places,
              const model::FieldOutputSpec& spec);

  bool is_empty() const { return quantities_.empty(); }
  bool has_extremes() const { return has_extremes_; }
  int whole() const { return whole_; }

  void add_channels(FieldLayout& layout) const;

  /// Cost: a sparse product with the rows of all shells of the body.
  void evaluate(const model::State& state);
  /// Appends the fields of the state that was evaluated last.
  void append(std::vector<double>& values) const;
  /// Compares the stresses evaluated last with the largest so far. @param t [s]
  void update_extremes(double t);
  void append_extremes(std::vector<double>& values) const;
  /// Saves or restores the largest so far. @throws InputError if it does not fit
  void visit_saved(const base::SaveVisit& visit);

 private:
  /// One body of the model with its shells among those that are recorded.
  struct Part {
    int body = 0;
    std::unique_ptr<fem::ShellRecovery> recovery;
    std::vector<int> shells;  // of the part
    std::vector<std::size_t> rows;
    linalg::Matrix strains;
  };

  template <class Visitor>
  void visit(Visitor&& visitor) const;
  double mises(const Part& part, int shell) const;

  const model::Model& model_;
  int whole_;
  enum class Quantity { von_mises, stress, section_force };
  std::vector<Quantity> quantities_;
  bool has_extremes_ = false;
  std::size_t most_layers_ = 1;
  std::vector<int> shells_;  // of the whole mesh, numbered after its solids: all
  std::vector<Part> parts_;
  std::vector<double> largest_, times_;
};

}  // namespace buckens::results
