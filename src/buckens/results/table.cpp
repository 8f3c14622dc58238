// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/table.h"

#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::results {

namespace {

std::size_t index_of(const RecordLayout& layout, std::string_view path) {
  const int found = layout.find(path);
  if (found < 0) throw ModelError(fmt::format("nothing is recorded under \"{}\".", path));
  return static_cast<std::size_t>(found);
}

/// One channel of records that follow one another.
Eigen::MatrixXd channel_values(const RecordLayout& layout, std::string_view path,
                               const std::vector<double>& values, std::size_t records) {
  const std::size_t index = index_of(layout, path);
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Map<const Rows> all(values.data(), static_cast<Eigen::Index>(records),
                                   static_cast<Eigen::Index>(layout.num_values()));
  return all.middleCols(static_cast<Eigen::Index>(layout.offset(index)),
                        static_cast<Eigen::Index>(layout.channel(index).size()));
}

}  // namespace

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

void Table::begin_fields(const FieldLayout& layout) {
  field_layout_ = layout;
  field_times_.clear();
  field_values_.clear();
  extremes_.clear();
}

void Table::write_fields(const Record& fields) {
  field_times_.push_back(fields.t);
  field_values_.insert(field_values_.end(), fields.values.begin(), fields.values.end());
}

Eigen::MatrixXd Table::values(std::string_view path) const {
  return channel_values(layout_, path, values_, times_.size());
}

Eigen::MatrixXd Table::field_values(std::string_view path) const {
  return channel_values(field_layout_.fields, path, field_values_, field_times_.size());
}

Eigen::VectorXd Table::extremes(std::string_view path) const {
  return channel_values(field_layout_.extremes, path, extremes_, extremes_.empty() ? 0 : 1)
      .transpose();
}

}  // namespace buckens::results
