// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/dynamics/constraints.h"
#include "buckens/model/build/build_model.h"

namespace buckens::analysis {

/// Rows that hold joint coordinates at their start values or start rates. They follow the rows of
/// the joints, only while a start is being found.
class StartRows {
 public:
  enum class Held { values, rates };

  StartRows(const model::Model& model, const std::vector<model::StartCoordinate>& starts, Held held,
            const std::vector<dynamics::BodyMotion>& as_placed);

  bool empty() const { return starts_.empty(); }
  /// Number of steps in which the values are approached, so that assembly follows the branch of a
  /// loop and screws count their turns.
  int stages() const;
  /// Appends the rows. @param share fraction of the way to the values, 0 … 1
  /// @param memory with which the rows of joints before them were evaluated
  void append(const std::vector<dynamics::BodyMotion>& motions, double share,
              const model::RowMemory& memory, dynamics::Constraints& out) const;
  /// Appends a reference length per row: that of the model for displacements.
  void append_lengths(linalg::Vector& out) const;

  /// What is missing, for a message: `"elbow" at 0.3 rad where 0.5 rad is asked for`.
  std::string describe(const std::vector<dynamics::BodyMotion>& motions) const;
  /// Of the first of them.
  const SourceLocation& where() const { return starts_.front().where; }

 private:
  struct Seen {
    double value = 0, rate = 0;
    dynamics::SystemRow row;
  };
  /// @param memory of sliders; null: they are sought along their whole beam
  Seen look(const model::StartCoordinate& start, const std::vector<dynamics::BodyMotion>& motions,
            const model::RowMemory* memory = nullptr) const;
  bool is_angle(const model::StartCoordinate& start) const;
  double asked(const model::StartCoordinate& start) const {
    return held_ == Held::values ? *start.value : *start.rate;
  }

  const model::Model& model_;
  Held held_;
  std::vector<model::StartCoordinate> starts_;
  std::vector<double> from_;  // values as placed
};

/// Counts the turns with which angles start.
void count_start_turns(const std::vector<model::StartCoordinate>& starts, const model::Model& model,
                       model::RowMemory& memory);

}  // namespace buckens::analysis
