// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/panel_file.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include "buckens/base/log.h"
#include "buckens/linalg/content_hash.h"

namespace buckens::linalg {

namespace fs = std::filesystem;

namespace {

// Changes whenever the layout of panels or of this file changes.
constexpr char kMagic[16] = "Buckens panel 3";
constexpr std::uint64_t kByteOrder = 0x0102030405060708U;
constexpr std::size_t kKeyLength = 32;

template <class T>
void add_run(ContentHash& hash, const T* values, std::size_t count) {
  hash.add(values, count * sizeof(T));
}

/// Of all entries, from hashes of some columns each, so that threads may share the columns.
/// @param visit calls a function that it gets as entry(row, value) for the entries of a column
template <class VisitColumn>
std::string key_of(Eigen::Index size, VisitColumn&& visit, TaskPool* pool) {
  constexpr Eigen::Index kColumns = 256;
  std::vector<std::array<std::uint64_t, 2>> parts(
      static_cast<std::size_t>((size + kColumns - 1) / kColumns));
  run_ranges(pool, static_cast<int>(parts.size()), [&](int begin, int end) {
    std::vector<int> rows, starts;
    std::vector<double> values;
    for (int part = begin; part < end; ++part) {
      rows.clear();
      starts.clear();
      values.clear();
      const Eigen::Index first = kColumns * part;
      for (Eigen::Index column = first; column < std::min(first + kColumns, size); ++column) {
        starts.push_back(static_cast<int>(rows.size()));
        visit(column, [&](Eigen::Index row, double value) {
          rows.push_back(static_cast<int>(row));
          values.push_back(value);
        });
      }
      ContentHash hash;
      add_run(hash, starts.data(), starts.size());
      add_run(hash, rows.data(), rows.size());
      add_run(hash, values.data(), values.size());
      parts[static_cast<std::size_t>(part)] = hash.value();
    }
  });
  ContentHash hash;
  hash.add(kMagic, sizeof kMagic);
  hash.add(static_cast<std::uint64_t>(size));
  hash.add(kPanelColumns);
  add_run(hash, parts.data(), parts.size());
  return hash.text();
}

std::string key_of(const SparseMatrix& A, TaskPool* pool) {
  const auto visit = [&A](Eigen::Index column, auto&& entry) {
    for (SparseMatrix::InnerIterator it(A, column); it; ++it) entry(it.row(), it.value());
  };
  return key_of(A.rows(), visit, pool);
}

std::string key_of(const MatrixSum& A, TaskPool* pool) {
  A.form_terms();
  const auto visit = [&A](Eigen::Index column, auto&& entry) {
    thread_local std::vector<MatrixSum::Entry> entries;
    A.read_column(column, entries);
    for (const MatrixSum::Entry& at : entries) entry(at.row, at.value);
  };
  return key_of(A.size(), visit, pool);
}

void warn(const fs::path& path, const std::string& what) {
  base::log(base::LogLevel::warning, fmt::format("stored factor {}: {}", path.string(), what));
}

// A file that its writer has not touched for so long, and does not hold, is left over.
constexpr std::chrono::minutes kLeftAlone{10};

/// Tells other processes that a file is being written, as long as it lives.
class WriteMark {
 public:
  explicit WriteMark(const fs::path& path)
      : descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    holds_ = descriptor_ >= 0 && ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0;
  }
  ~WriteMark() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  WriteMark(const WriteMark&) = delete;
  WriteMark& operator=(const WriteMark&) = delete;

  /// Nobody else does, then.
  bool holds() const { return holds_; }

 private:
  int descriptor_;
  bool holds_;
};

/// Removes what processes have left that were killed while they wrote.
void remove_left_over(const fs::path& folder) {
  std::error_code problem;
  std::vector<fs::path> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, problem)) {
    const std::string name = entry.path().filename().string();
    if (name.find(".factor.") == kKeyLength) found.push_back(entry.path());
  }
  for (const fs::path& path : found) {
    const fs::file_time_type touched = fs::last_write_time(path, problem);
    if (problem || fs::file_time_type::clock::now() - touched < kLeftAlone) continue;
    if (WriteMark(path).holds()) fs::remove(path, problem);
  }
}

/// A name that no other process or thread uses.
fs::path aside(const fs::path& path) {
  static std::atomic<int> number{0};
  return fs::path(fmt::format("{}.{}-{}", path.string(), ::getpid(), number++));
}

}  // namespace

/// What a panel is without its places in memory.
struct PanelFile::PlainPanel {
  std::int32_t first, columns, row_blocks;
};

/// The fixed beginning of a file; the runs follow.
struct PanelFile::Header {
  char magic[16] = {};
  char key[kKeyLength] = {};
  std::uint64_t byte_order = kByteOrder;
  std::int64_t size = 0, groups = 0, panels = 0, rows = 0, origins = 0, values = 0;
  std::int64_t places = 0;
  double entries = 0;
  std::uint64_t check[2] = {};  // of all runs and of the header without it

  /// Whether a file of this length holds what is announced.
  bool fits(std::int64_t length) const {
    std::int64_t left = length - static_cast<std::int64_t>(sizeof(Header));
    const auto take = [&left](std::int64_t count, std::size_t each) {
      if (count < 0 || left < 0 || count > left / static_cast<std::int64_t>(each)) left = -1;
      left -= left < 0 ? 0 : count * static_cast<std::int64_t>(each);
    };
    take(panels, sizeof(PlainPanel));
    take(groups, sizeof(PanelFactor::Group));
    take(rows, sizeof(int));
    take(origins, sizeof(int));
    take(values, sizeof(double));
    return left == 0;
  }
};

/// Visits the contents of a factor in the order of the file.
struct PanelFile::Runs {
  std::vector<PlainPanel> panels;

  template <class Factor, class Visit>
  void each(Factor& factor, Visit&& visit) {
    visit(panels.data(), panels.size());
    visit(factor.groups_.data(), factor.groups_.size());
    visit(factor.rows_.data(), factor.rows_.size());
    visit(factor.origin_.data(), factor.origin_.size());
    visit(factor.values_.data(), factor.values_.size());
  }
};

PanelFile::PanelFile(const fs::path& folder, const SparseMatrix& A, TaskPool* pool)
    : key_(key_of(A, pool)), path_(folder / (key_ + ".factor")) {}

PanelFile::PanelFile(const fs::path& folder, const MatrixSum& A, TaskPool* pool)
    : key_(key_of(A, pool)), path_(folder / (key_ + ".factor")) {}

void PanelFile::write(const PanelFactor& factor, double entries) const {
  Header header;
  std::memcpy(header.magic, kMagic, sizeof kMagic);
  std::memcpy(header.key, key_.data(), sizeof header.key);
  header.size = factor.size_;
  header.groups = static_cast<std::int64_t>(factor.groups_.size());
  header.panels = static_cast<std::int64_t>(factor.panels_.size());
  header.rows = static_cast<std::int64_t>(factor.rows_.size());
  header.origins = static_cast<std::int64_t>(factor.origin_.size());
  header.values = static_cast<std::int64_t>(factor.values_.size());
  header.places = factor.num_places_;
  header.entries = entries;
  Runs runs;
  for (const Panel& panel : factor.panels_) {
    runs.panels.push_back({panel.first, panel.columns, panel.row_blocks});
  }
  ContentHash hash;
  add_run(hash, &header, 1);
  runs.each(factor, [&](const auto* values, std::size_t count) { add_run(hash, values, count); });
  std::memcpy(header.check, hash.value().data(), sizeof header.check);

  const fs::path temporary = aside(path_);
  std::error_code problem;
  fs::create_directories(path_.parent_path(), problem);
  remove_left_over(path_.parent_path());
  std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
  const WriteMark mark(temporary);
  const auto put = [&out](const auto* values, std::size_t count) {
    out.write(reinterpret_cast<const char*>(values),
              static_cast<std::streamsize>(count * sizeof *values));
  };
  put(&header, 1);
  runs.each(factor, put);
  out.close();
  if (out) fs::rename(temporary, path_, problem);
  if (out && !problem) return;
  warn(path_, fmt::format("cannot be written ({}); the run goes on without it",
                          problem ? problem.message() : std::strerror(errno)));
  fs::remove(temporary, problem);
}

std::optional<PanelFile::Stored> PanelFile::read(SimdLevel level) const {
  std::error_code problem;
  const fs::file_status status = fs::status(path_, problem);
  if (!fs::exists(status)) return std::nullopt;
  const auto refuse = [this](const char* what) {
    warn(path_, fmt::format("{}; the factor is computed anew", what));
    return std::nullopt;
  };
  // Whoever opens a pipe waits for somebody to write.
  if (!fs::is_regular_file(status)) return refuse("is no regular file");
  std::ifstream in(path_, std::ios::binary | std::ios::ate);
  if (!in) return refuse("cannot be opened");
  const auto length = static_cast<std::int64_t>(in.tellg());
  in.seekg(0);
  const auto get = [&in](auto* values, std::size_t count) {
    in.read(reinterpret_cast<char*>(values), static_cast<std::streamsize>(count * sizeof *values));
  };
  Header header;
  get(&header, 1);
  const bool is_ours = in && std::memcmp(header.magic, kMagic, sizeof kMagic) == 0 &&
                       header.byte_order == kByteOrder &&
                       std::memcmp(header.key, key_.data(), sizeof header.key) == 0;
  if (!is_ours) return refuse("is no factor of this matrix by this version of Buckens");
  if (!header.fits(length)) return refuse("is cut short or damaged");

  Stored stored{PanelFactor(level), header.entries};
  PanelFactor& factor = stored.factor;
  factor.size_ = header.size;
  factor.num_places_ = static_cast<int>(header.places);
  factor.groups_.resize(static_cast<std::size_t>(header.groups));
  factor.rows_.resize(static_cast<std::size_t>(header.rows));
  factor.origin_.resize(static_cast<std::size_t>(header.origins));
  factor.values_ = StreamingMemory(static_cast<std::size_t>(header.values));
  Runs runs;
  runs.panels.resize(static_cast<std::size_t>(header.panels));
  runs.each(factor, get);
  if (!in) return refuse("cannot be read");
  std::uint64_t check[2];
  std::memcpy(check, header.check, sizeof check);
  std::memset(header.check, 0, sizeof header.check);
  ContentHash hash;
  add_run(hash, &header, 1);
  runs.each(factor, [&](const auto* values, std::size_t count) { add_run(hash, values, count); });
  if (std::memcmp(check, hash.value().data(), sizeof check) != 0) return refuse("is damaged");

  const double* values = factor.values_.data();
  const int* rows = factor.rows_.data();
  for (const PlainPanel& plain : runs.panels) {
    factor.panels_.push_back({values, rows, plain.first, plain.columns, plain.row_blocks});
    values += kPanelRows * factor.panels_.back().num_lines();
    rows += static_cast<std::ptrdiff_t>(kPanelRows) * plain.row_blocks;
  }
  return stored;
}

}  // namespace buckens::linalg
