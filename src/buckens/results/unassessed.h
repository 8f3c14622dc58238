// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "buckens/results/error_statement.h"

namespace buckens::results {

/// What no uncertainty of a statement contains, such as "mesh of \"plate\"": the beginnings of its
/// notes, "<what>: <why>". If there is any, uncertainties are lower bounds.
inline std::vector<std::string> unassessed(const ErrorStatement& errors) {
  std::vector<std::string> out;
  for (const std::string& note : errors.notes) {
    std::string what = note.substr(0, note.find(": "));
    if (std::find(out.begin(), out.end(), what) == out.end()) out.push_back(std::move(what));
  }
  return out;
}

}  // namespace buckens::results
