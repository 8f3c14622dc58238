// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/motion_tables.h"

#include <utility>

namespace buckens::results {

namespace {

constexpr std::string_view kBodies = "bodies/";
constexpr std::string_view kJoints = "joints/";

Channel table_of(const char* path, const char* unit, std::size_t rows,
                 const std::vector<Channel>& columns, const char* description,
                 std::vector<std::string> components) {
  int width = 0;
  for (const Channel& column : columns) width += static_cast<int>(column.size());
  return {path, unit, {static_cast<int>(rows), width}, description, std::move(components)};
}

}  // namespace

std::vector<Channel> body_channels(const std::string& body) {
  const std::vector<std::string> xyz = {"x", "y", "z"};
  const std::string group = std::string(kBodies) + body;
  return {{group + "/pose",
           "m, 1",
           {7},
           "origin of the body frame and its quaternion",
           {"x", "y", "z", "qw", "qx", "qy", "qz"}},
          {group + "/velocity", "m/s", {3}, "of the body frame's origin, world axes", xyz},
          {group + "/angular_velocity", "rad/s", {3}, "of the body frame, body axes", xyz}};
}

std::vector<Channel> joint_channels(const std::string& joint) {
  const std::vector<std::string> xyz = {"x", "y", "z"};
  const std::string group = std::string(kJoints) + joint;
  return {
      {group + "/force", "N", {3}, "on the second marker, world axes", xyz},
      {group + "/torque", "N m", {3}, "on the second marker about its origin, world axes", xyz}};
}

Channel motions_channel(std::size_t bodies) {
  return table_of(
      kMotionsPath, "m, 1, m/s, rad/s", bodies, body_channels(""),
      "of all bodies in the order of the model file: pose, velocity and angular velocity",
      {"x", "y", "z", "qw", "qx", "qy", "qz", "vx", "vy", "vz", "wx", "wy", "wz"});
}

Channel reactions_channel(std::size_t joints) {
  return table_of(kReactionsPath, "N, N m", joints, joint_channels(""),
                  "of all joints in the order of the model: force and torque on the second "
                  "marker, world axes",
                  {"Fx", "Fy", "Fz", "Mx", "My", "Mz"});
}

std::size_t TablePart::offset(const RecordLayout& layout) const {
  if (row == 0) return first;
  return row * static_cast<std::size_t>(layout.channel(table).shape.back()) + first;
}

std::optional<TablePart> find_in_tables(const RecordLayout& layout, std::string_view path,
                                        const FindRow& body, const FindRow& joint) {
  const bool is_body = path.starts_with(kBodies);
  if (!is_body && !path.starts_with(kJoints)) return std::nullopt;
  const int table = layout.find(is_body ? kMotionsPath : kReactionsPath);
  if (table < 0) return std::nullopt;
  const std::size_t begin = (is_body ? kBodies : kJoints).size();
  const std::size_t end = path.rfind('/');
  if (end <= begin) return std::nullopt;
  const std::string name(path.substr(begin, end - begin));
  const int row = is_body ? body(name) : joint(name);
  TablePart out{static_cast<std::size_t>(table), 0, 0, {}};
  if (row < 0 || row >= layout.channel(out.table).shape.front()) return std::nullopt;
  out.row = static_cast<std::size_t>(row);
  for (Channel& channel : is_body ? body_channels(name) : joint_channels(name)) {
    if (channel.path == path) {
      out.channel = std::move(channel);
      return out;
    }
    out.first += channel.size();
  }
  return std::nullopt;
}

}  // namespace buckens::results
