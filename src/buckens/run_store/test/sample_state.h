// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/files/output_file.h"
#include "buckens/run_store/state_file.h"

namespace buckens::run_store {

inline base::SavedValues some_state() {
  base::SavedValues out;
  out.numbers["state/t"] = {0.1};
  out.numbers["state/bodies/0/d"] = {1.0 / 3.0, -0.0, 1e-308, 5e-324};
  out.numbers["none"] = {};
  out.counts["ticks"] = {1L << 55, -7};
  out.texts["model"] = {"bodies.rod.mass: 1", "", "läuft"};
  out.texts["version"] = {};
  return out;
}

/// A state with lists of which each is longer than the pieces in which files are read.
inline base::SavedValues long_state() {
  base::SavedValues out = some_state();
  for (const int list : {0, 1, 2}) {
    std::vector<double>& values = out.numbers["pairs/" + std::to_string(list)];
    for (int k = 0; k < 20000; ++k) values.push_back(list + k / 16384.0);
  }
  return out;
}

inline std::filesystem::path some_path() {
  return std::filesystem::path(testing::TempDir()) / "buckens_state_file_test.h5";
}

/// The contents of its file.
inline std::string state_bytes(const base::SavedValues& state) {
  write_state(state, some_path());
  std::string bytes = files::read_text_file(some_path());
  std::filesystem::remove(some_path());
  return bytes;
}

/// A file with these bytes.
inline std::filesystem::path file_of(std::string_view bytes) {
  files::OutputFile(some_path(), files::OutputFile::Start::empty).write(bytes);
  return some_path();
}

/// All of the state in such a file, in memory.
inline base::SavedValues state_in(std::string_view bytes) {
  base::SavedValues out = read_state(file_of(bytes)).part("");
  std::filesystem::remove(some_path());
  return out;
}

/// Saves some pairs, each number of which is its number.
inline void visit_pairs(const base::SaveVisit& visit, int pairs, Eigen::Index size) {
  for (int k = 0; k < pairs; ++k) {
    visit.inside("pairs").inside(static_cast<std::size_t>(k)).save_singles("load", size, [=] {
      return Eigen::VectorXf(Eigen::VectorXf::Constant(size, static_cast<float>(k)));
    });
  }
}

}  // namespace buckens::run_store
