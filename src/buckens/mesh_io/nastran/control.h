// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "buckens/mesh_io/nastran/source.h"

namespace buckens::mesh_io {

/// Numbers `first` to `last`; a single number is a range of one.
struct NastranRange {
  std::int64_t first = 0;
  std::int64_t last = 0;
};

/// `SET n = …` of the case control.
struct NastranControlSet {
  std::int64_t id = 0;
  bool all = false;
  std::vector<NastranRange> members;
  std::vector<NastranRange> except;  ///< excluded from the preceding ranges
  const NastranFile* file = nullptr;
  int line = 0;
};

/// `K2GG = name` and the like of the case control: a matrix that takes part in the structure.
struct NastranMatrixChoice {
  std::string keyword, name;
  const NastranFile* file = nullptr;
  int line = 0;
};

/// What a mesh needs from the executive and case control sections.
struct NastranControl {
  bool present = false;
  int num_lines = 0;
  std::optional<std::int64_t> mpc_set;  ///< MPC = n
  std::optional<std::int64_t> nsm_set;  ///< NSM = n
  std::vector<NastranMatrixChoice> matrices;
  std::optional<double> weight_to_mass;  ///< PARAM,WTMASS
  std::vector<NastranControlSet> sets;
};

/// Whether a text is a deck of Nastran, whatever its file name: it contains BEGIN BULK.
bool has_nastran_bulk_data(std::string_view text);

/// Reads the part before BEGIN BULK, if the deck has one: if its main file has a line BEGIN BULK or
/// starts with an executive or case control statement.
/// @param first_bulk_line set to a line that was taken from the source but belongs to the bulk data
/// @throws InputError if BEGIN BULK is missing, or if subcases request different MPC or NSM
NastranControl read_nastran_control(NastranSource& source,
                                    std::optional<NastranLine>& first_bulk_line);

}  // namespace buckens::mesh_io
