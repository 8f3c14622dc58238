// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "buckens/run_store/run_reader.h"
#include "buckens/spatial/pose.h"

namespace buckens::run_store {

/// One instant of a run: a record, and the corresponding record of fields.
struct Instant {
  double t = 0;  ///< [s]
  std::size_t record = 0;
  std::optional<std::size_t> field_row;
};

/// Which instants of a run are taken.
struct InstantChoice {
  std::vector<double> times;  ///< the nearest instants to these [s]; empty: `count` of them
  std::size_t count = 100;    ///< maximum, evenly spread from first to last; 0: all
};

/// The chosen instants, increasing. Of runs with fields only those that have them.
/// @throws InputError if a time is outside the run, IoError if the run has no records
std::vector<Instant> choose_instants(const RunReader& run, const InstantChoice& choice);

/// Poses of a body's frame in some records, given by their increasing indices. Bodies that were not
/// recorded are at the origin.
std::vector<spatial::Pose> poses_of(const RunReader& run, const std::string& body,
                                    std::span<const std::size_t> records);
/// The same in one record.
spatial::Pose pose_of(const RunReader& run, const std::string& body, std::size_t record);

/// Displacements of all nodes in body axes [m]; zero if none were recorded.
Eigen::Matrix3Xd displacements_of(const RunReader& run, const results::GeometryBody& body,
                                  std::size_t record);

/// The shells of a body, numbered after its solids.
std::vector<int> shells_of(const results::GeometryBody& body);

/// The quantities recorded of a body at "nodes", "elements" or "shells": the last parts of their
/// paths.
std::vector<std::string> field_names(const RunReader& run, const std::string& body,
                                     const std::string& location);

/// A recorded channel by its path, null if there is none.
const results::Channel* find_channel(const results::RecordLayout& layout, const std::string& path);

}  // namespace buckens::run_store
