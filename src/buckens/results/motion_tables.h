// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "buckens/results/channel.h"

namespace buckens::results {

// Rigid models of thousands of parts record the motion of all bodies in one channel, "motions", and
// the forces of all joints in another, "reactions". Everything here is said once, for both layouts.

/// What is recorded of every body, in this order: pose, velocity, angular velocity.
std::vector<Channel> body_channels(const std::string& body);
/// What is recorded of every joint, in this order: force, torque.
std::vector<Channel> joint_channels(const std::string& joint);

inline constexpr const char* kMotionsPath = "motions";
inline constexpr const char* kReactionsPath = "reactions";

/// A row of body_channels() per body.
Channel motions_channel(std::size_t bodies);
/// A row of joint_channels() per joint.
Channel reactions_channel(std::size_t joints);

/// A channel of one body or joint that stands in a table of all of them.
struct TablePart {
  std::size_t table = 0;  ///< index of the channel that holds it
  std::size_t row = 0;    ///< of the table
  std::size_t first = 0;  ///< of its values within the row
  Channel channel;        ///< as if it had been recorded by itself

  /// Place of its first value among those of the table.
  std::size_t offset(const RecordLayout& layout) const;
};

/// Row of a body or joint by its name, −1 if there is none.
using FindRow = std::function<int(const std::string& name)>;

/// The part that is called `path`, "bodies/rod/pose"; nothing if the layout has no such table, or
/// the table no such row or channel.
std::optional<TablePart> find_in_tables(const RecordLayout& layout, std::string_view path,
                                        const FindRow& body, const FindRow& joint);

}  // namespace buckens::results
