// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include <hdf5.h>

#include "buckens/run_store/hdf5_driver.h"
#include "buckens/run_store/hdf5_texts.h"

namespace buckens::run_store {

/// Owns one HDF5 identifier.
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);

  Hdf5Handle() = default;
  Hdf5Handle(hid_t id, Close close) : id_(id), close_(close) {}
  ~Hdf5Handle() { reset(); }
  Hdf5Handle(Hdf5Handle&& other) noexcept;
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept;

  hid_t get() const { return id_; }
  bool is_valid() const { return id_ >= 0; }
  /// Closes the identifier. @return false if HDF5 reports an error
  bool reset() noexcept;

 private:
  hid_t id_ = H5I_INVALID_HID;
  Close close_ = nullptr;
};

/// While it lives, HDF5 prints no errors from this thread (the library never prints).
class Hdf5Quiet {
 public:
  Hdf5Quiet();
  ~Hdf5Quiet();
  Hdf5Quiet(const Hdf5Quiet&) = delete;
  Hdf5Quiet& operator=(const Hdf5Quiet&) = delete;

 private:
  H5E_auto2_t print_ = nullptr;
  void* print_argument_ = nullptr;
};

/// Why the last HDF5 call of this thread failed, in the system's words if it has any
/// ("No space left on device"), otherwise in those of HDF5.
std::string hdf5_reason();

/// An HDF5 file, written once or read.
///
/// Life of a written file: create; groups, data sets and attributes; start_swmr; rows are appended
/// while others read; close. From start_swmr on the file can be read at any moment, also after
/// SIGKILL, up to the last flush, with the flags H5F_ACC_RDONLY | H5F_ACC_SWMR_READ.
class Hdf5File {
 public:
  Hdf5File() = default;
  /// Creates the file anew (open_anew()). All writes go through `writer`, which must outlive the
  /// file. @throws IoError
  /// @param undo null, or keeps what is overwritten after a checkpoint; must outlive the file
  static Hdf5File create(const std::filesystem::path& path, files::WriteProcess& writer,
                         Hdf5Undo* undo = nullptr);
  /// Opens a file that is complete, still being written by another process, or left by a killed
  /// one.
  /// @param texts where its texts are collected or taken from: read_texts_apart()
  /// @param undone null, or what makes it the file that it was at a checkpoint
  /// @throws IoError
  static Hdf5File open_for_reading(const std::filesystem::path& path,
                                   std::shared_ptr<Hdf5Texts> texts = nullptr,
                                   std::shared_ptr<const Undone> undone = nullptr);
  ~Hdf5File();
  Hdf5File(Hdf5File&&) = default;
  Hdf5File& operator=(Hdf5File&&) = default;

  hid_t id() const { return file_.get(); }
  bool is_open() const { return file_.is_valid(); }
  const std::filesystem::path& path() const { return path_; }
  Hdf5Texts* texts() const { return texts_.get(); }

  /// Lets others read from now on; no more attributes or data sets can be added.
  /// @throws IoError
  void start_swmr();
  /// Passes everything written so far to the system. @throws IoError also for earlier writes:
  /// failed writes only show here, in check_written and in close
  void flush();
  /// @throws IoError if a write has failed
  void check_written() const;
  /// Gives the file another name in the same directory. @throws IoError
  void rename(const std::filesystem::path& path);
  /// Completes the file. All handles to its contents must be closed. After a failed write the file
  /// on disk is left unchanged. @throws IoError if a write has failed now or before
  void close();
  /// Leaves the file on disk unchanged, as a killed program would; further writes are discarded.
  void abandon() noexcept;

  /// @throws IoError "<path>: cannot <what>: <reason>" with the reason of the last failed call
  [[noreturn]] void fail(const std::string& what) const;
  /// `result` if it is not negative. @throws IoError
  hid_t check(hid_t result, const std::string& what) const;

 private:
  std::filesystem::path path_;
  std::shared_ptr<Hdf5Texts> texts_;
  std::shared_ptr<const Undone> undone_;
  std::unique_ptr<Hdf5WriteFault> fault_;  // before file_, which uses it until the end
  Hdf5Handle file_;
};

}  // namespace buckens::run_store
