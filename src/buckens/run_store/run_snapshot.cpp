// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/run_snapshot.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::run_store {

namespace {

constexpr std::size_t kPoseSize = 7;   // position and quaternion
constexpr Eigen::Index kNodeSize = 6;  // translations and rotations

/// Every instant that may be taken.
std::vector<Instant> all_instants(const RunReader& run) {
  std::vector<Instant> out;
  if (run.field_times().empty()) {
    for (std::size_t k = 0; k < run.num_records(); ++k) out.push_back({run.times()[k], k, {}});
  }
  for (std::size_t row = 0; row < run.field_times().size(); ++row) {
    out.push_back({run.field_times()[row], run.record_of_field(row), row});
  }
  return out;
}

}  // namespace

std::vector<Instant> choose_instants(const RunReader& run, const InstantChoice& choice) {
  const std::vector<Instant> all = all_instants(run);
  if (all.empty()) throw IoError("the run has no records yet, there is nothing to export.");
  std::vector<std::size_t> taken;
  for (const double t : choice.times) {
    const double reach = 1e-9 * std::max(std::abs(all.back().t), std::abs(all.front().t));
    if (!(t >= all.front().t - reach && t <= all.back().t + reach)) {
      throw InputError(fmt::format("there is no instant {:g} s; the run goes from {:g} s to {:g} s",
                                   t, all.front().t, all.back().t));
    }
    const auto nearest = std::min_element(
        all.begin(), all.end(),
        [t](const auto& a, const auto& b) { return std::abs(a.t - t) < std::abs(b.t - t); });
    taken.push_back(static_cast<std::size_t>(nearest - all.begin()));
  }
  if (choice.times.empty()) {
    const std::size_t count = choice.count == 0 ? all.size() : std::min(choice.count, all.size());
    for (std::size_t k = 0; k < count; ++k) {
      taken.push_back(count == 1 ? all.size() - 1 : k * (all.size() - 1) / (count - 1));
    }
  }
  std::sort(taken.begin(), taken.end());
  taken.erase(std::unique(taken.begin(), taken.end()), taken.end());
  std::vector<Instant> out;
  for (const std::size_t k : taken) out.push_back(all[k]);
  return out;
}

std::vector<spatial::Pose> poses_of(const RunReader& run, const std::string& body,
                                    std::span<const std::size_t> records) {
  std::vector<spatial::Pose> out(records.size());
  const std::string path = fmt::format("bodies/{}/pose", body);
  if (!run.find(path)) return out;
  const std::vector<double> all = run.read(path, records);
  for (std::size_t k = 0; k < out.size(); ++k) {
    const double* v = all.data() + k * kPoseSize;
    out[k] = {{v[0], v[1], v[2]}, Eigen::Quaterniond(v[3], v[4], v[5], v[6])};
  }
  return out;
}

spatial::Pose pose_of(const RunReader& run, const std::string& body, std::size_t record) {
  return poses_of(run, body, std::array{record}).front();
}

Eigen::Matrix3Xd displacements_of(const RunReader& run, const results::GeometryBody& body,
                                  std::size_t record) {
  const std::string path = fmt::format("bodies/{}/displacement", body.name);
  const results::Channel* channel = find_channel(run.layout(), path);
  const Eigen::Index count = body.nodes.rows();
  if (channel == nullptr || count == 0) return Eigen::Matrix3Xd::Zero(3, count);
  const std::vector<double> values = run.read(path, std::array{record});
  if (static_cast<Eigen::Index>(values.size()) != kNodeSize * count) {
    throw IoError(fmt::format("the displacements of body \"{}\" do not fit its nodes.", body.name));
  }
  return Eigen::Map<const Eigen::Matrix<double, kNodeSize, Eigen::Dynamic>>(values.data(),
                                                                            kNodeSize, count)
      .topRows<3>();
}

std::vector<int> shells_of(const results::GeometryBody& body) {
  std::vector<int> out;
  for (std::size_t e = 0; e < body.cell_kinds.size(); ++e) {
    if (fem::dimension_of(body.cell_kinds[e]) == 2) out.push_back(static_cast<int>(e));
  }
  return out;
}

std::vector<std::string> field_names(const RunReader& run, const std::string& body,
                                     const std::string& location) {
  const std::string group = fmt::format("fields/bodies/{}/{}/", body, location);
  std::vector<std::string> out;
  for (const results::Channel& channel : run.field_layout().channels()) {
    if (channel.path.starts_with(group)) out.push_back(channel.path.substr(group.size()));
  }
  return out;
}

const results::Channel* find_channel(const results::RecordLayout& layout, const std::string& path) {
  const int index = layout.find(path);
  return index < 0 ? nullptr : &layout.channel(static_cast<std::size_t>(index));
}

}  // namespace buckens::run_store
