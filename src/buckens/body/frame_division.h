// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace buckens::body {

/// Number of body frames for one mesh.
struct FrameDivision {
  static constexpr const char* kPerElement = "per-element";

  int count = 1;
  bool per_element = false;  ///< one frame per element, whatever `count`

  FrameDivision() = default;
  FrameDivision(int frames) : count(frames) {}  // NOLINT: a number is a division
  static FrameDivision each_element() {
    FrameDivision out;
    out.per_element = true;
    return out;
  }

  bool is_one() const { return !per_element && count == 1; }
  int of(int num_elements) const { return per_element ? num_elements : count; }
};

}  // namespace buckens::body
