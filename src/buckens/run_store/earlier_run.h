// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "buckens/files/output_file.h"

namespace buckens::run_store {

/// The files of an earlier run in a directory that a new run has taken. They are set aside in
/// `.earlier` until the new run has its own results; if it never gets that far, they are restored.
/// A program that was killed in between leaves them there, and the next run finds them.
class EarlierRun {
 public:
  EarlierRun() = default;

  /// Restores what a killed program left aside. Then sets the files of an earlier run aside if it
  /// has results.
  /// @param log log.txt of the directory, open and locked by this process; it keeps its contents
  /// @throws IoError; the earlier run is then as it was
  EarlierRun(const std::filesystem::path& run, files::OutputFile& log);

  bool is_aside() const { return is_aside_; }
  /// Restores all files, replacing those of the new run. @throws IoError
  void bring_back(files::OutputFile& log);
  /// Removes them. @throws IoError
  void discard();

 private:
  void put_aside();

  std::filesystem::path run_, aside_;
  bool is_aside_ = false;
};

}  // namespace buckens::run_store
