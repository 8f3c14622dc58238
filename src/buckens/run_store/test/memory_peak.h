// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fstream>
#include <string>

namespace buckens::run_store {

/// An entry of the status of this process [bytes].
inline double memory(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(key + ":")) return 1024.0 * std::stod(line.substr(key.size() + 1));
  }
  return 0;
}

/// Largest memory while a function runs, beyond what there was before [bytes].
template <class Function>
double peak_of(Function&& function) {
  std::ofstream("/proc/self/clear_refs") << 5;  // the peak begins anew
  const double before = memory("VmRSS");
  function();
  return memory("VmHWM") - before;
}

}  // namespace buckens::run_store
