// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace buckens::results {

/// One recorded quantity: a scalar, vector or table of numbers per record.
///
/// Paths with a meaning for readers (the viewer page, sensors.csv):
///
///     bodies/<body>/pose           {7}     p_WB [m], then q_WB as w, x, y, z
///     bodies/<body>/displacement   {N, 6}  nodal translations [m] and rotations [rad], body axes
///     bodies/<body>/stress         {E, …}  stresses per element [Pa]; the page shows the largest
///     sensors/<sensor>             {} or {k}
///     loads/<load>/value           {} or {3}  pressure, or components of the load
///     energies/<name>              {}
struct Channel {
  std::string path;         ///< "bodies/rod/pose": names joined by '/', no leading '/'
  std::string unit;         ///< "m", "N m"; "1" for pure numbers
  std::vector<int> shape;   ///< extents of one record's value; empty: a scalar
  std::string description;  ///< one sentence for whoever opens the file
  std::vector<std::string>
      components;  ///< names along the last extent ("x", "y", "z"); may be empty

  /// Number of values per record: the product of the extents.
  std::size_t size() const;
};

/// The channels of a run and their positions in the flat list of values of a record.
class RecordLayout {
 public:
  /// Appends a channel and returns its index.
  /// @throws ModelError if the path is in use, empty, or contains an empty part, "." or "..", if a
  ///   parent of it is itself a channel, if an extent is below 1, or if the number of component
  ///   names differs from the last extent
  std::size_t add(Channel channel);

  const std::vector<Channel>& channels() const { return channels_; }
  const Channel& channel(std::size_t index) const { return channels_.at(index); }
  /// Position of the channel's first value in Record::values.
  std::size_t offset(std::size_t index) const { return offsets_.at(index); }
  /// Length of Record::values.
  std::size_t num_values() const { return num_values_; }
  /// Index of the channel with this path, −1 if there is none.
  int find(std::string_view path) const;

 private:
  std::vector<Channel> channels_;
  std::vector<std::size_t> offsets_;
  std::unordered_map<std::string, std::size_t> index_;
  std::unordered_set<std::string> parents_;  ///< every proper prefix of a path
  std::size_t num_values_ = 0;
};

}  // namespace buckens::results
