// SPDX-License-Identifier: Apache-2.0
#include "buckens/dynamics/multiplier_condensation.h"

#include <algorithm>

namespace buckens::dynamics {

namespace {

const BodyRow& share(const SystemRow& row, bool is_first) {
  return is_first ? row.first : row.second;
}

/// Position of entry (row, column) among the values of a compressed matrix with sorted columns.
int value_position(const linalg::SparseMatrix& A, int row, int column) {
  const int* begin = A.innerIndexPtr() + A.outerIndexPtr()[column];
  const int* end = A.innerIndexPtr() + A.outerIndexPtr()[column + 1];
  return static_cast<int>(std::lower_bound(begin, end, row) - A.innerIndexPtr());
}

}  // namespace

MultiplierCondensation::MultiplierCondensation(int num_bodies, const std::vector<SystemRow>& rows)
    : size_(static_cast<int>(rows.size())), rows_on_body_(static_cast<std::size_t>(num_bodies)) {
  for (int r = 0; r < size_; ++r) {
    const SystemRow& row = rows[static_cast<std::size_t>(r)];
    for (const bool is_first : {true, false}) {
      const int b = share(row, is_first).body;
      if (b != model::kGround) rows_on_body_[static_cast<std::size_t>(b)].push_back({r, is_first});
    }
  }
  std::vector<linalg::Triplet> entries;
  for (int r = 0; r < size_; ++r) entries.emplace_back(r, r, 0.0);
  for (const auto& list : rows_on_body_) {
    for (const RowOnBody& i : list) {
      for (const RowOnBody& j : list) entries.emplace_back(i.row, j.row, 0.0);
    }
  }
  S_.resize(size_, size_);
  S_.setFromTriplets(entries.begin(), entries.end());
  S_.makeCompressed();
  for (int r = 0; r < size_; ++r) diagonal_.push_back(value_position(S_, r, r));
  for (const auto& list : rows_on_body_) {
    std::vector<int> positions;
    positions.reserve(list.size() * list.size());
    for (const RowOnBody& j : list) {
      for (const RowOnBody& i : list) positions.push_back(value_position(S_, i.row, j.row));
    }
    positions_.push_back(std::move(positions));
  }
  lu_.emplace(S_);
}

void MultiplierCondensation::add_body(std::size_t b, const std::vector<SystemRow>& test,
                                      const std::vector<SystemRow>& force,
                                      const BodyCompliance& compliance) {
  const auto& list = rows_on_body_[b];
  std::size_t position = 0;
  for (const RowOnBody& j : list) {
    const BodyRow& acting = share(force[static_cast<std::size_t>(j.row)], j.is_first);
    const Eigen::Matrix<double, 6, 1> frame_image = compliance.frame * acting.frame.transpose();
    const bool on_interface = compliance.interface != nullptr && acting.translation_row >= 0;
    if (on_interface) {
      image_.resize(compliance.interface->rows());
      image_.noalias() = compliance.interface->middleCols<3>(acting.translation_row) *
                         acting.interface.head<3>().transpose();
      if (acting.rotation_row >= 0) {
        image_.noalias() += compliance.interface->middleCols<3>(acting.rotation_row) *
                            acting.interface.tail<3>().transpose();
      }
    }
    for (const RowOnBody& i : list) {
      const BodyRow& closing = share(test[static_cast<std::size_t>(i.row)], i.is_first);
      double value = closing.frame.dot(frame_image);
      if (on_interface && closing.translation_row >= 0) {
        value += closing.interface.head<3>().dot(image_.segment<3>(closing.translation_row));
        if (closing.rotation_row >= 0) {
          value += closing.interface.tail<3>().dot(image_.segment<3>(closing.rotation_row));
        }
      }
      S_.valuePtr()[positions_[b][position++]] += value;
    }
  }
}

bool MultiplierCondensation::factorise(const std::vector<SystemRow>& test,
                                       const std::vector<SystemRow>& force,
                                       const std::vector<BodyCompliance>& compliance,
                                       const std::vector<double>& soft_compliance) {
  std::fill(S_.valuePtr(), S_.valuePtr() + S_.nonZeros(), 0.0);
  for (std::size_t b = 0; b < rows_on_body_.size(); ++b) {
    if (!rows_on_body_[b].empty()) add_body(b, test, force, compliance[b]);
  }
  const std::size_t first_soft = diagonal_.size() - soft_compliance.size();
  for (std::size_t k = 0; k < soft_compliance.size(); ++k) {
    S_.valuePtr()[diagonal_[first_soft + k]] += soft_compliance[k];
  }
  return lu_->factorise(S_);
}

void MultiplierCondensation::gather(const std::vector<SystemRow>& force, const linalg::Vector& x,
                                    std::vector<BodyResponse>& responses) const {
  for (std::size_t b = 0; b < rows_on_body_.size(); ++b) {
    BodyResponse& out = responses[b];
    out.frame_load.setZero();
    out.interface_load.setZero();
    for (const RowOnBody& entry : rows_on_body_[b]) {
      const BodyRow& row = share(force[static_cast<std::size_t>(entry.row)], entry.is_first);
      const double value = x[entry.row];
      out.frame_load += value * row.frame.transpose();
      if (row.translation_row >= 0) {
        out.interface_load.segment<3>(row.translation_row) +=
            value * row.interface.head<3>().transpose();
      }
      if (row.rotation_row >= 0) {
        out.interface_load.segment<3>(row.rotation_row) +=
            value * row.interface.tail<3>().transpose();
      }
    }
  }
}

}  // namespace buckens::dynamics
