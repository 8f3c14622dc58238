// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace buckens::run_store {

/// The texts of a file, as read by another process. HDF5 stores texts in a heap of the file without
/// checksums and copies as many bytes as that says: a damaged file makes it overwrite memory. So a
/// disposable process does it.
class Hdf5Texts {
 public:
  /// What was found at a place: texts, or why there are none.
  struct Entry {
    std::vector<std::string> texts;
    std::string error;
  };

  void note(const std::string& place, Entry entry) { entries_[place] = std::move(entry); }
  /// Null if not read.
  const Entry* find(const std::string& place) const;
  /// Whether texts are taken from here; otherwise they are collected.
  bool is_complete() const { return is_complete_; }

  /// As bytes for a pipe, and back.
  std::string packed() const;
  static Hdf5Texts unpacked(const std::string& bytes);

 private:
  std::map<std::string, Entry> entries_;
  bool is_complete_ = false;
};

/// Reads a file with HDF5 in a separate process first, which also shows whether HDF5 crashes or
/// hangs on it.
/// @param file for the message
/// @param read does what will be done here afterwards, with an Hdf5File that collects its texts;
/// exceptions are ignored, since they will occur again
/// @return the texts to give to the Hdf5File here
/// @throws IoError if that process does not finish, or not within a minute of processor time
std::shared_ptr<Hdf5Texts> read_texts_apart(
    const std::filesystem::path& file,
    const std::function<void(const std::shared_ptr<Hdf5Texts>&)>& read);

}  // namespace buckens::run_store
