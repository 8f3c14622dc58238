// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "buckens/dynamics/system_kinematics.h"

namespace buckens::dynamics {

/// Sums of row forces on one body.
struct BodyResponse {
  Eigen::Matrix<double, 6, 1> frame_load = Eigen::Matrix<double, 6, 1>::Zero();
  Eigen::VectorXd interface_load;
};

/// Displacement of one body: frame coordinates and interface values.
struct Displacement {
  const Eigen::Matrix<double, 6, 1>* u;
  const Eigen::VectorXd* y;  ///< of bodies with a mesh
};

/// Up to six rows between the same markers: usually a joint, with the laws on its coordinates. A
/// row that couples several joints has a side for each marker of theirs.
struct RowBlock {
  static constexpr int kMostRows = 6;
  /// The rows' derivatives with respect to one body.
  struct Side {
    int body = model::kGround;
    int translation_row = -1, rotation_row = -1;  ///< as in BodyRow
    std::size_t frame = 0;                        ///< first of 6 × count values, row by row
    std::size_t interface = 0;                    ///< the same, if the marker follows a mesh
    bool follows_mesh() const { return translation_row >= 0; }
  };
  std::array<int, kMostRows> rows{};  ///< ascending
  int count = 0;
  std::size_t first_side = 0;
  std::size_t num_sides = 0;
  int travelling = -1;  ///< as in SystemRow
};

/// Derivatives of many rows, stored compactly in the order of the rows.
///
/// A SystemRow holds everything about one row; for a chain of a thousand links that is more than
/// fits into a processor's cache, and a step reads it several times. Here a row is only its
/// numbers, twelve for a rigid pair, and what its block has in common is stored once.
class RowBlocks {
 public:
  static constexpr int kMostRows = RowBlock::kMostRows;

  /// @param pattern one entry per row with body numbers and marker rows set; values are not read
  /// @param num_behind rows at the end that never share a block with those before them; theirs are
  /// side by side
  explicit RowBlocks(const std::vector<SystemRow>& pattern, int num_behind = 0);

  const std::vector<RowBlock>& blocks() const { return blocks_; }
  std::span<const RowBlock::Side> sides(const RowBlock& block) const {
    return {&sides_[block.first_side], block.num_sides};
  }
  int num_rows() const { return static_cast<int>(places_.size()); }
  int block_of(int row) const { return places_[static_cast<std::size_t>(row)].block; }
  /// Number of a row within its block.
  int number_in_block(int row) const { return places_[static_cast<std::size_t>(row)].number; }

  /// Stores the numbers of a row. Its bodies are those of the pattern, and its marker rows unless
  /// it travels; an empty row is zero.
  void set(int row, const SystemRow& values);
  /// Sets a row to nothing.
  void clear(int row);
  /// Whether the row was set to nothing.
  bool is_empty(int row) const { return places_[static_cast<std::size_t>(row)].is_empty; }

  /// Derivatives of row `k` of a block on one side: six of the frame, six of the interface.
  const double* frame(const RowBlock::Side& side, int k) const {
    return &values_[side.frame + static_cast<std::size_t>(6 * k)];
  }
  const double* interface(const RowBlock::Side& side, int k) const {
    return &values_[side.interface + static_cast<std::size_t>(6 * k)];
  }

  /// Sums the row forces x on each body. @param responses interface loads have their sizes
  void gather(const linalg::Vector& x, std::vector<BodyResponse>& responses) const;

  /// Change of every row by displacements of the bodies.
  /// @param displacement returns the Displacement of a body by its number
  template <class F>
  void changes(linalg::Vector& out, F&& displacement) const {
    out.setZero(num_rows());
    for (const RowBlock& block : blocks_) {
      for (const RowBlock::Side& side : sides(block)) {
        if (side.body == model::kGround) continue;
        const Displacement moved = displacement(side.body);
        for (int k = 0; k < block.count; ++k) {
          const int row = block.rows[static_cast<std::size_t>(k)];
          if (!is_empty(row)) out[row] += change(side, k, moved);
        }
      }
    }
  }

 private:
  /// Begins a block like a row of the pattern.
  void add_block(const SystemRow& row);
  /// Gives the blocks room for their numbers.
  void lay_out();
  double change(const RowBlock::Side& side, int k, const Displacement& moved) const {
    using Vector6 = Eigen::Matrix<double, 6, 1>;
    double out = Eigen::Map<const Vector6>(frame(side, k)).dot(*moved.u);
    if (!side.follows_mesh()) return out;
    const double* const derivative = interface(side, k);
    for (int i = 0; i < 3; ++i) out += derivative[i] * (*moved.y)[side.translation_row + i];
    if (side.rotation_row < 0) return out;
    for (int i = 0; i < 3; ++i) out += derivative[3 + i] * (*moved.y)[side.rotation_row + i];
    return out;
  }

  std::vector<RowBlock> blocks_;
  std::vector<RowBlock::Side> sides_;  // block by block
  struct Place {
    int block, number;
    bool is_empty = false;
  };
  std::vector<Place> places_;  // of each row
  std::vector<double> values_;
};

}  // namespace buckens::dynamics
