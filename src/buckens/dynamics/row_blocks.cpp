// SPDX-License-Identifier: Apache-2.0
#include "buckens/dynamics/row_blocks.h"

#include <algorithm>
#include <map>

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

bool acts_on_nothing(const SystemRow& row) {
  return row.first.body == model::kGround && row.second.body == model::kGround &&
         std::all_of(row.more.begin(), row.more.end(),
                     [](const BodyRow& part) { return part.body == model::kGround; });
}

/// What rows of one block have in common.
std::vector<int> kind_of(const SystemRow& row) {
  std::vector<int> out = {row.travelling};
  for (const BodyRow* part : row.parts()) {
    out.insert(out.end(), {part->body, part->translation_row, part->rotation_row});
  }
  return out;
}

}  // namespace

RowBlocks::RowBlocks(const std::vector<SystemRow>& pattern, int num_behind) {
  const std::size_t first_behind = pattern.size() - static_cast<std::size_t>(num_behind);
  std::map<std::vector<int>, int> known;  // the last block of each kind
  for (std::size_t r = 0; r < pattern.size(); ++r) {
    const SystemRow& row = pattern[r];
    const auto fits = [&](const RowBlock& block) {
      return block.count < kMostRows && row.travelling == block.travelling &&
             touch_the_same(row, sides(block));
    };
    int index = static_cast<int>(blocks_.size()) - 1;
    const bool is_like_last = index >= 0 && r != first_behind && fits(blocks_.back());
    if (!is_like_last) {
      int* before = r < first_behind ? &known.try_emplace(kind_of(row), -1).first->second : nullptr;
      index = before != nullptr ? *before : -1;
      if (index < 0 || !fits(blocks_[static_cast<std::size_t>(index)])) {
        index = static_cast<int>(blocks_.size());
        add_block(row);
      }
      if (before != nullptr) *before = index;
    }
    RowBlock& block = blocks_[static_cast<std::size_t>(index)];
    places_.push_back({index, block.count, false});
    block.rows[static_cast<std::size_t>(block.count++)] = static_cast<int>(r);
  }
  lay_out();
}

void RowBlocks::add_block(const SystemRow& row) {
  RowBlock& block = blocks_.emplace_back();
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

void RowBlocks::lay_out() {
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
  Place& place = places_[static_cast<std::size_t>(row)];
  place.is_empty = acts_on_nothing(values);
  const RowBlock& block = blocks_[static_cast<std::size_t>(place.block)];
  const auto offset = static_cast<std::size_t>(6 * place.number);
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

void RowBlocks::clear(int row) {
  Place& place = places_[static_cast<std::size_t>(row)];
  place.is_empty = true;
  const auto offset = static_cast<std::size_t>(6 * place.number);
  for (const RowBlock::Side& side : sides(blocks_[static_cast<std::size_t>(place.block)])) {
    if (side.body == model::kGround) continue;
    std::fill_n(&values_[side.frame + offset], 6, 0.0);
    if (side.follows_mesh()) std::fill_n(&values_[side.interface + offset], 6, 0.0);
  }
}

void RowBlocks::gather(const linalg::Vector& x, std::vector<BodyResponse>& responses) const {
  for (BodyResponse& response : responses) {
    response.frame_load.setZero();
    response.interface_load.setZero();
  }
  for (const RowBlock& block : blocks_) {
    std::array<double, kMostRows> forces;
    for (std::size_t k = 0; k < static_cast<std::size_t>(block.count); ++k) {
      forces[k] = x[block.rows[k]];
    }
    for (const RowBlock::Side& side : sides(block)) {
      if (side.body == model::kGround) continue;
      BodyResponse& out = responses[static_cast<std::size_t>(side.body)];
      Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
      for (int k = 0; k < block.count; ++k) {
        sum += forces[static_cast<std::size_t>(k)] *
               Eigen::Map<const Eigen::Matrix<double, 6, 1>>(frame(side, k));
      }
      out.frame_load += sum;
      if (!side.follows_mesh()) continue;
      sum.setZero();
      for (int k = 0; k < block.count; ++k) {
        sum += forces[static_cast<std::size_t>(k)] *
               Eigen::Map<const Eigen::Matrix<double, 6, 1>>(interface(side, k));
      }
      out.interface_load.segment<3>(side.translation_row) += sum.head<3>();
      if (side.rotation_row >= 0) out.interface_load.segment<3>(side.rotation_row) += sum.tail<3>();
    }
  }
}

}  // namespace buckens::dynamics
