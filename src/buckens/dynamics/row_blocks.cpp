// SPDX-License-Identifier: Apache-2.0
#include "buckens/dynamics/row_blocks.h"

#include <algorithm>

namespace buckens::dynamics {

namespace {

bool touch_the_same(const BodyRow& row, const RowBlock::Side& side) {
  return row.body == side.body && row.translation_row == side.translation_row &&
         row.rotation_row == side.rotation_row;
}

bool touch_the_same(const SystemRow& row, std::span<const RowBlock::Side> sides) {
  if (row.num_parts() != sides.size()) return false;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    if (!touch_the_same(row.part(s), sides[s])) return false;
  }
  return true;
}

}  // namespace

RowBlocks::RowBlocks(const std::vector<SystemRow>& pattern, int num_behind) {
  const std::size_t first_behind = pattern.size() - static_cast<std::size_t>(num_behind);
  for (std::size_t r = 0; r < pattern.size(); ++r) {
    const SystemRow& row = pattern[r];
    const bool fits = !blocks_.empty() && blocks_.back().count < kMostRows && r != first_behind &&
                      row.travelling == blocks_.back().travelling &&
                      touch_the_same(row, sides(blocks_.back()));
    if (!fits) {
      RowBlock& block = blocks_.emplace_back();
      block.first_row = static_cast<int>(r);
      block.first_side = sides_.size();
      block.num_sides = row.num_parts();
      block.travelling = row.travelling;
      for (const BodyRow* part : row.parts()) {
        RowBlock::Side& side = sides_.emplace_back();
        side.body = part->body;
        side.translation_row = part->translation_row;
        side.rotation_row = part->rotation_row;
      }
    }
    ++blocks_.back().count;
    block_of_row_.push_back(static_cast<int>(blocks_.size()) - 1);
  }
  std::size_t next = 0;
  for (const RowBlock& block : blocks_) {
    const auto numbers = static_cast<std::size_t>(6 * block.count);
    for (std::size_t s = 0; s < block.num_sides; ++s) {
      RowBlock::Side& side = sides_[block.first_side + s];
      if (side.body == model::kGround) continue;
      side.frame = next;
      next += numbers;
      if (!side.follows_mesh()) continue;
      side.interface = next;
      next += numbers;
    }
  }
  values_.assign(next, 0.0);
}

void RowBlocks::set(int row, const SystemRow& values) {
  const RowBlock& block =
      blocks_[static_cast<std::size_t>(block_of_row_[static_cast<std::size_t>(row)])];
  const auto offset = static_cast<std::size_t>(6 * (row - block.first_row));
  static const BodyRow nothing;
  for (std::size_t s = 0; s < block.num_sides; ++s) {
    RowBlock::Side& side = sides_[block.first_side + s];
    if (side.body == model::kGround) continue;
    // A law that is switched off gives an empty row.
    const BodyRow& part = s < values.num_parts() ? values.part(s) : nothing;
    if (block.travelling >= 0 && values.travelling >= 0) {
      side.translation_row = part.translation_row;
      side.rotation_row = part.rotation_row;
    }
    std::copy_n(part.frame.data(), 6, &values_[side.frame + offset]);
    if (side.follows_mesh())
      std::copy_n(part.interface.data(), 6, &values_[side.interface + offset]);
  }
}

void RowBlocks::gather(const linalg::Vector& x, std::vector<BodyResponse>& responses) const {
  for (BodyResponse& response : responses) {
    response.frame_load.setZero();
    response.interface_load.setZero();
  }
  for (const RowBlock& block : blocks_) {
    const double* const forces = x.data() + block.first_row;
    for (const RowBlock::Side& side : sides(block)) {
      if (side.body == model::kGround) continue;
      BodyResponse& out = responses[static_cast<std::size_t>(side.body)];
      Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
      for (int k = 0; k < block.count; ++k) {
        sum += forces[k] * Eigen::Map<const Eigen::Matrix<double, 6, 1>>(frame(side, k));
      }
      out.frame_load += sum;
      if (!side.follows_mesh()) continue;
      sum.setZero();
      for (int k = 0; k < block.count; ++k) {
        sum += forces[k] * Eigen::Map<const Eigen::Matrix<double, 6, 1>>(interface(side, k));
      }
      out.interface_load.segment<3>(side.translation_row) += sum.head<3>();
      if (side.rotation_row >= 0) out.interface_load.segment<3>(side.rotation_row) += sum.tail<3>();
    }
  }
}

}  // namespace buckens::dynamics
