// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/basis_files.h"

#include <array>
#include <fstream>
#include <span>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/run_store/hdf5_reading.h"
#include "buckens/run_store/hdf5_texts.h"
#include "buckens/run_store/hdf5_values.h"

namespace buckens::run_store {

namespace fs = std::filesystem;

namespace {

constexpr char kBasisFormat[] = "buckens reduced basis 2";

std::string text_of(std::uint64_t key) { return fmt::format("{:016x}", key); }

/// A file with a basis, not open for files of other programs. All its texts have been read.
Hdf5File open_basis(const fs::path& path, const std::shared_ptr<Hdf5Texts>& texts) {
  try {
    Hdf5File in = Hdf5File::open_for_reading(path, texts);
    if (read_string(in, "/", "format") != kBasisFormat) return {};
    read_string(in, "/", "key");
    return in;
  } catch (const IoError&) {
    if (std::ifstream(path).good()) return {};
    throw;
  }
}

body::ReducedBasis read_basis(const Hdf5File& in) {
  const std::vector<int> counts = read_ints(in, "/", "counts");
  const std::vector<double> figures = read_doubles(in, "/", "figures");
  const std::vector<double> omega = read_double_dataset(in, "/omega");
  const std::vector<double> Z = read_any_double_dataset(in, "/Z");
  const auto columns = static_cast<Eigen::Index>(omega.size());
  if (counts.size() != 3 || figures.size() != 2 || columns == 0 || counts[2] < 1 ||
      Z.size() != static_cast<std::size_t>(counts[2]) * omega.size()) {
    throw IoError(fmt::format("{}: the reduced basis in it is not complete; remove the file",
                              in.path().string()));
  }
  body::ReducedBasis out;
  out.omega = Eigen::Map<const linalg::Vector>(omega.data(), columns);
  // Column after column, as in memory.
  out.Z = Eigen::Map<const linalg::Matrix>(Z.data(), counts[2], columns);
  if (!out.omega.allFinite() || !out.Z.allFinite()) {
    throw IoError(
        fmt::format("{}: the reduced basis in it holds values that are no numbers; "
                    "remove the file",
                    in.path().string()));
  }
  out.num_modes = counts[0];
  out.num_residuals = counts[1];
  out.highest_mode = figures[0];
  out.static_share = figures[1];
  return out;
}

}  // namespace

std::optional<body::ReducedBasis> BasisFiles::find(const std::string& file, std::uint64_t key) {
  const fs::path path = directory_ / file;
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return std::nullopt;
  const auto texts = read_texts_apart(path, [&path](const std::shared_ptr<Hdf5Texts>& notes) {
    const Hdf5File trial = open_basis(path, notes);
    if (trial.is_open()) read_basis(trial);
  });
  const Hdf5File in = open_basis(path, texts);
  if (!in.is_open()) {
    throw InputError(
        fmt::format("{}: is not a reduced basis of this version of Buckens; name another file "
                    "(`reduction.file`) or remove it",
                    path.string()));
  }
  if (read_string(in, "/", "key") != text_of(key)) {
    if (others_ == Others::leave) return std::nullopt;
    throw InputError(fmt::format(
        "{}: this reduced basis belongs to another mesh, material, interface or choice of modes; "
        "remove the file to have it made anew, or name another one (`reduction.file`)",
        path.string()));
  }
  return read_basis(in);
}

void BasisFiles::keep(const std::string& file, std::uint64_t key, const body::ReducedBasis& basis) {
  const fs::path path = directory_ / file;
  std::error_code error;
  if (others_ == Others::leave && fs::exists(path, error)) return;
  fs::path part = path;
  part += ".part";
  files::WriteProcess writer;
  Hdf5File out = Hdf5File::create(part, writer);
  write_attribute(out, "/", "format", std::string(kBasisFormat));
  write_attribute(out, "/", "key", text_of(key));
  const std::array<int, 3> counts = {basis.num_modes, basis.num_residuals,
                                     static_cast<int>(basis.Z.rows())};
  const std::array<double, 2> figures = {basis.highest_mode, basis.static_share};
  write_attribute(out, "/", "counts", std::span<const int>(counts));
  write_attribute(out, "/", "figures", std::span<const double>(figures));
  const auto rows = static_cast<hsize_t>(basis.Z.rows());
  const auto columns = static_cast<hsize_t>(basis.Z.cols());
  write_dataset(out, "/omega", {columns},
                std::span<const double>(basis.omega.data(), basis.omega.size()));
  write_dataset(out, "/Z", {columns, rows},
                std::span<const double>(basis.Z.data(), basis.Z.size()));
  out.close();
  fs::rename(part, path, error);
  if (error) {
    throw IoError(
        fmt::format("{}: cannot write the reduced basis: {}; name a file that can be "
                    "written (`reduction.file`)",
                    path.string(), error.message()));
  }
}

}  // namespace buckens::run_store
