// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fstream>
#include <string>

namespace buckens::bench {

/// An entry of /proc/self/status in bytes, 0 if there is none: "VmRSS" is the current size, "VmHWM"
/// the peak.
inline double process_memory(const std::string& key) {
  std::ifstream status("/proc/self/status");
  std::string line;
  while (std::getline(status, line)) {
    if (line.rfind(key + ":", 0) == 0) return 1024.0 * std::stod(line.substr(key.size() + 1));
  }
  return 0.0;
}

/// Lets the peak "VmHWM" begin anew, where the system permits it. @return the current size
inline double restart_peak() {
  std::ofstream("/proc/self/clear_refs") << 5;
  return process_memory("VmRSS");
}

}  // namespace buckens::bench
