// SPDX-License-Identifier: Apache-2.0
#include "buckens/dynamics/multiplier_condensation.h"

#include <algorithm>
#include <array>

namespace buckens::dynamics {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Images = std::array<Vector6, RowBlocks::kMostRows>;

/// The blocks that are factorised come first.
std::size_t num_blocks_before(const RowBlocks& rows, int end) {
  std::size_t k = 0;
  while (k < rows.blocks().size() && rows.blocks()[k].rows[0] < end) ++k;
  return k;
}

std::vector<int> sizes_of(const RowBlocks& rows, std::size_t count) {
  std::vector<int> sizes;
  for (std::size_t k = 0; k < count; ++k) sizes.push_back(rows.blocks()[k].count);
  return sizes;
}

/// The rows of these blocks one after the other.
std::vector<int> rows_of(const RowBlocks& rows, std::size_t count) {
  std::vector<int> out;
  for (std::size_t k = 0; k < count; ++k) {
    const RowBlock& block = rows.blocks()[k];
    out.insert(out.end(), block.rows.begin(), block.rows.begin() + block.count);
  }
  return out;
}

/// Pairs of blocks that act on the same body, each once.
std::vector<std::pair<int, int>> couples_of(const RowBlocks& rows, std::size_t count,
                                            int num_bodies) {
  std::vector<std::vector<int>> on_body(static_cast<std::size_t>(num_bodies));
  std::vector<std::pair<int, int>> out;
  for (std::size_t k = 0; k < count; ++k) {
    out.emplace_back(static_cast<int>(k), static_cast<int>(k));
    for (const RowBlock::Side& side : rows.sides(rows.blocks()[k])) {
      if (side.body == model::kGround) continue;
      on_body[static_cast<std::size_t>(side.body)].push_back(static_cast<int>(k));
    }
  }
  for (const auto& list : on_body) {
    for (const int i : list) {
      for (const int j : list) out.emplace_back(i, j);
    }
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

Eigen::Map<const Vector6> six(const double* values) { return Eigen::Map<const Vector6>(values); }

/// Values at the interface rows of `at` by row forces along `force` of another block's side.
Vector6 interface_image(const linalg::Matrix& compliance, const RowBlock::Side& at,
                        const RowBlock::Side& from, const double* force) {
  // Written out: products of blocks are not inlined.
  const auto part = [&](int row) -> Eigen::Vector3d {
    Eigen::Vector3d out = Eigen::Vector3d::Zero();
    const auto add = [&](int first, const double* f) {
      for (int k = 0; k < 3; ++k) {
        const double* const column = &compliance(row, first + k);
        for (int i = 0; i < 3; ++i) out[i] += column[i] * f[k];
      }
    };
    add(from.translation_row, force);
    if (from.rotation_row >= 0) add(from.rotation_row, force + 3);
    return out;
  };
  Vector6 image = Vector6::Zero();
  image.head<3>() = part(at.translation_row);
  if (at.rotation_row >= 0) image.tail<3>() = part(at.rotation_row);
  return image;
}

}  // namespace

MultiplierCondensation::MultiplierCondensation(int num_bodies, const std::vector<SystemRow>& rows,
                                               int num_loose)
    : num_loose_(num_loose),
      force_(rows, num_loose),
      num_direct_blocks_(num_blocks_before(force_, force_.num_rows() - num_loose)),
      blocks_on_body_(static_cast<std::size_t>(num_bodies)),
      couples_(couples_of(force_, num_direct_blocks_, num_bodies)),
      block_lu_(sizes_of(force_, num_direct_blocks_), couples_,
                rows_of(force_, num_direct_blocks_)) {
  const auto& blocks = force_.blocks();
  for (std::size_t k = 0; k < num_direct_blocks_; ++k) {
    const auto sides = force_.sides(blocks[k]);
    for (std::size_t side = 0; side < sides.size(); ++side) {
      const int b = sides[side].body;
      if (b == model::kGround) continue;
      blocks_on_body_[static_cast<std::size_t>(b)].push_back(
          {static_cast<int>(k), static_cast<int>(side)});
    }
  }
  for (const auto& list : blocks_on_body_) {
    std::vector<int>& places = places_.emplace_back();
    places.reserve(list.size() * list.size());
    for (const BlockOnBody& j : list) {
      for (const BlockOnBody& i : list) places.push_back(block_lu_.place(i.block, j.block));
    }
  }
}

void MultiplierCondensation::set_row(int row, const SystemRow& values) {
  force_.set(row, values);
  if (test_) test_->set(row, values);
}

void MultiplierCondensation::set_row(int row, const SystemRow& test, const SystemRow& force) {
  if (!test_) test_ = force_;
  force_.set(row, force);
  test_->set(row, test);
}

void MultiplierCondensation::set_acting_row(int row, const SystemRow& force) {
  if (!test_) test_ = force_;
  force_.set(row, force);
  test_->clear(row);
}

void MultiplierCondensation::clear_row(int row) {
  force_.clear(row);
  if (test_) test_->clear(row);
}

void MultiplierCondensation::add_body(std::size_t b, const BodyCompliance& compliance,
                                      linalg::BlockLu& into) const {
  const auto& list = blocks_on_body_[b];
  const Eigen::Matrix3d rotation = compliance.frame.topLeftCorner<3, 3>();
  const Eigen::Matrix3d translation = compliance.frame.bottomRightCorner<3, 3>();
  const RowBlocks& test = test_rows();
  // Both have the same layout, but a row that travels may act elsewhere than it is closed.
  const auto side_of = [](const RowBlocks& rows, const BlockOnBody& k) -> const RowBlock::Side& {
    return rows.sides(
        rows.blocks()[static_cast<std::size_t>(k.block)])[static_cast<std::size_t>(k.side)];
  };
  const auto count_of = [&](const BlockOnBody& k) {
    return force_.blocks()[static_cast<std::size_t>(k.block)].count;
  };
  const int* place = places_[b].data();
  Images images;
  const auto is_idle = [&](const BlockOnBody& k) {
    return is_idle_[static_cast<std::size_t>(k.block)] != 0;
  };
  for (const BlockOnBody& j : list) {
    if (is_idle(j)) {
      place += list.size();
      continue;
    }
    const RowBlock::Side& acting = side_of(force_, j);
    const int columns = count_of(j);
    for (int m = 0; m < columns; ++m) {
      Vector6& image = images[static_cast<std::size_t>(m)];
      const double* const f = force_.frame(acting, m);
      for (int i = 0; i < 3; ++i) {
        image[i] = rotation(i, 0) * f[0] + rotation(i, 1) * f[1] + rotation(i, 2) * f[2];
        image[3 + i] =
            translation(i, 0) * f[3] + translation(i, 1) * f[4] + translation(i, 2) * f[5];
      }
    }
    const bool on_interface = compliance.interface != nullptr && acting.follows_mesh();
    for (const BlockOnBody& i : list) {
      if (is_idle(i)) {
        ++place;
        continue;
      }
      const RowBlock::Side& closing = side_of(test, i);
      const int rows = count_of(i);
      double* const S = into.block(*place);
      const int stride = into.stride(*place);
      ++place;
      for (int m = 0; m < columns; ++m) {
        double* const column = S + static_cast<std::ptrdiff_t>(m) * stride;
        const Vector6& image = images[static_cast<std::size_t>(m)];
        for (int k = 0; k < rows; ++k) column[k] += six(test.frame(closing, k)).dot(image);
        if (!on_interface || !closing.follows_mesh()) continue;
        const Vector6 seen =
            interface_image(*compliance.interface, closing, acting, force_.interface(acting, m));
        for (int k = 0; k < rows; ++k) column[k] += six(test.interface(closing, k)).dot(seen);
      }
    }
  }
}

void MultiplierCondensation::find_idle_blocks() {
  is_idle_.assign(num_direct_blocks_, 1);
  for (std::size_t k = 0; k < num_direct_blocks_; ++k) {
    const RowBlock& block = force_.blocks()[k];
    for (int m = 0; m < block.count && is_idle_[k]; ++m) {
      is_idle_[k] = is_empty(block.rows[static_cast<std::size_t>(m)]);
    }
  }
  for (const MultiplierSlope& slope : slopes_) {
    for (const int row : {slope.soft_row, slope.row}) {
      const auto block = static_cast<std::size_t>(force_.block_of(row));
      if (block < num_direct_blocks_) is_idle_[block] = 0;
    }
  }
}

void MultiplierCondensation::assemble(const std::vector<BodyCompliance>& compliance,
                                      const std::vector<double>& soft_compliance,
                                      linalg::BlockLu& into) {
  into.clear();
  find_idle_blocks();
  into.set_alone(is_idle_);
  for (std::size_t b = 0; b < blocks_on_body_.size(); ++b) {
    if (!blocks_on_body_[b].empty()) add_body(b, compliance[b], into);
  }
  const int first_soft = size() - static_cast<int>(soft_compliance.size());
  const std::size_t num_direct = soft_compliance.size() - static_cast<std::size_t>(num_loose_);
  for (std::size_t k = 0; k < num_direct; ++k) {
    into.diagonal(first_soft + static_cast<int>(k)) += soft_compliance[k];
  }
}

bool MultiplierCondensation::factorise(const std::vector<BodyCompliance>& compliance,
                                       const std::vector<double>& soft_compliance) {
  if (num_loose_ > 0) {
    compliance_ = compliance;
    soft_compliance_ = soft_compliance;
    set_loose_blocks();
    if (num_direct_blocks_ == 0) return true;
  }
  return factorise_direct(compliance, soft_compliance);
}

bool MultiplierCondensation::factorise_direct(const std::vector<BodyCompliance>& compliance,
                                              const std::vector<double>& soft_compliance) {
  assemble(compliance, soft_compliance, block_lu_);
  factorise_with_slopes(soft_compliance);
  exchanges_rows_ = !(block_lu_.factorise() && block_lu_.pivot_ratio() > kPoorPivot);
  if (!exchanges_rows_) return true;
  has_sloped_ = false;
  assemble(compliance, soft_compliance, block_lu_);
  return factorise_with_exchanges();
}

bool MultiplierCondensation::factorise(const std::vector<SystemRow>& test,
                                       const std::vector<SystemRow>& force,
                                       const std::vector<BodyCompliance>& compliance,
                                       const std::vector<double>& soft_compliance) {
  const bool are_one = &test == &force;
  for (int row = 0; row < size(); ++row) {
    const auto r = static_cast<std::size_t>(row);
    if (are_one) {
      set_row(row, force[r]);
    } else {
      set_row(row, test[r], force[r]);
    }
  }
  return factorise(compliance, soft_compliance);
}

void MultiplierCondensation::solve(linalg::Vector& x, Slopes slopes) const {
  if (num_loose_ > 0) {
    iterate(x, slopes);
  } else {
    solve_direct(x, slopes);
  }
}

void MultiplierCondensation::solve_direct(linalg::Vector& x, Slopes slopes) const {
  if (slopes == Slopes::counted && has_sloped_) {
    sloped_->solve_in_place(x);
  } else if (exchanges_rows_) {
    solve_with_exchanges(x);
  } else {
    block_lu_.solve_in_place(x);
  }
}

}  // namespace buckens::dynamics
