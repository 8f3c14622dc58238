// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/table.h"

#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::results {

void Table::begin(const RecordLayout& layout, const Geometry& geometry) {
  layout_ = layout;
  geometry_ = geometry;
  summary_.reset();
  times_.clear();
  values_.clear();
}

void Table::write(const Record& record) {
  if (record.values.size() != layout_.num_values()) {
    throw ModelError(fmt::format("record at t = {} s: {} values for channels that hold {}.",
                                 record.t, record.values.size(), layout_.num_values()));
  }
  times_.push_back(record.t);
  values_.insert(values_.end(), record.values.begin(), record.values.end());
}

void Table::finish(const RunSummary& summary) { summary_ = summary; }

Eigen::MatrixXd Table::values(std::string_view path) const {
  const int found = layout_.find(path);
  if (found < 0) {
    throw ModelError(fmt::format("nothing is recorded under \"{}\".", path));
  }
  const auto index = static_cast<std::size_t>(found);
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Map<const Rows> all(values_.data(), static_cast<Eigen::Index>(times_.size()),
                                   static_cast<Eigen::Index>(layout_.num_values()));
  return all.middleCols(static_cast<Eigen::Index>(layout_.offset(index)),
                        static_cast<Eigen::Index>(layout_.channel(index).size()));
}

}  // namespace buckens::results
