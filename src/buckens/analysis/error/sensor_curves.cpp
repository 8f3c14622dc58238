// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/error/sensor_curves.h"

#include <algorithm>

#include <fmt/format.h>

namespace buckens::analysis {

namespace {

constexpr const char* kSensorPaths = "sensors/";

/// Unit of a component where the channel has one for each: "N, N m".
std::string unit_of(const results::Channel& channel, std::size_t k) {
  const std::size_t comma = channel.unit.find(", ");
  if (comma == std::string::npos) return channel.unit;
  const bool is_second = 2 * (k % channel.components.size()) >= channel.components.size();
  return is_second ? channel.unit.substr(comma + 2) : channel.unit.substr(0, comma);
}

}  // namespace

void SensorCurves::begin(const results::RecordLayout& layout, const results::Geometry& geometry) {
  places_.clear();
  curves_.clear();
  times_.clear();
  for (std::size_t c = 0; c < layout.channels().size(); ++c) {
    const results::Channel& channel = layout.channel(c);
    if (!channel.path.starts_with(kSensorPaths)) continue;
    const std::string name = channel.path.substr(std::string(kSensorPaths).size());
    for (std::size_t k = 0; k < channel.size(); ++k) {
      const std::string component = channel.size() == 1             ? ""
                                    : k < channel.components.size() ? "." + channel.components[k]
                                                                    : fmt::format(".{}", k + 1);
      curves_.push_back(
          {name + component, channel.components.empty() ? channel.unit : unit_of(channel, k), {}});
      places_.push_back(layout.offset(c) + k);
    }
  }
  deformations_.clear();
  for (const std::string& body : watched_) {
    const int found = layout.find("bodies/" + body + "/displacement");
    if (found < 0) continue;
    const auto index = static_cast<std::size_t>(found);
    deformations_.push_back({body, layout.offset(index), layout.channel(index).size() / 6, 0, {}});
  }
  if (next_ != nullptr) next_->begin(layout, geometry);
}

void SensorCurves::write(const results::Record& record) {
  if (next_ != nullptr) next_->write(record);
  times_.push_back(record.t);
  for (std::size_t k = 0; k < curves_.size(); ++k) {
    curves_[k].values.push_back(record.values[places_[k]]);
  }
  for (Deformation& deformation : deformations_) {
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;
    const Eigen::Map<const Rows> now(record.values.data() + deformation.offset,
                                     static_cast<Eigen::Index>(deformation.nodes), 6);
    const double size = now.leftCols<3>().norm();
    if (size <= deformation.size) continue;
    deformation.size = size;
    deformation.displacements = now;
  }
}

linalg::Matrix SensorCurves::largest_deformation(const std::string& body) const {
  const auto found = std::find_if(deformations_.begin(), deformations_.end(),
                                  [&](const Deformation& d) { return d.body == body; });
  return found == deformations_.end() ? linalg::Matrix() : found->displacements;
}

void SensorCurves::begin_fields(const results::FieldLayout& layout) {
  if (next_ != nullptr) next_->begin_fields(layout);
}

void SensorCurves::write_fields(const results::Record& fields) {
  if (next_ != nullptr) next_->write_fields(fields);
}

void SensorCurves::write_extremes(const std::vector<double>& values) {
  if (next_ != nullptr) next_->write_extremes(values);
}

const SensorCurve* SensorCurves::find(const std::string& name) const {
  const auto found = std::find_if(curves_.begin(), curves_.end(),
                                  [&](const SensorCurve& curve) { return curve.name == name; });
  return found == curves_.end() ? nullptr : &*found;
}

}  // namespace buckens::analysis
