// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace buckens::run_store {

/// Bytes of a file and their place.
struct FileBytes {
  std::uint64_t address = 0;
  std::vector<std::uint8_t> bytes;
};

/// A file as it was at a checkpoint: what was overwritten since, and its length.
struct Undone {
  std::uint64_t length = 0;
  std::vector<FileBytes> before;
};

/// Keeps what results.h5 held at the last checkpoint, for as long as the run may go on from it.
///
/// Of writes after a checkpoint, a loss of power leaves any part. Those that add to the file do no
/// harm; those that change its bookkeeping would. So before bytes that the file had at the
/// checkpoint are overwritten for the first time, they are brought to the disk in another file
/// (results.undo); with them the file can be read as it was (Undone). The same bytes change again
/// and again, so this costs one or two writes to the disk per checkpoint.
class Hdf5Undo {
 public:
  explicit Hdf5Undo(const std::filesystem::path& directory);
  ~Hdf5Undo();
  Hdf5Undo(const Hdf5Undo&) = delete;
  Hdf5Undo& operator=(const Hdf5Undo&) = delete;

  /// From now on the first `length` bytes are kept; what was kept before is not needed any more.
  /// @param checkpoint identifies the checkpoint
  void begin(std::string checkpoint, std::uint64_t length);
  /// Takes up what is about to be overwritten. @return 0 or the error number
  int keep(int descriptor, std::uint64_t address, std::size_t size);
  /// Whether something was taken up that is not on the disk: until then nothing may be overwritten.
  bool is_waiting() const { return !waiting_.empty(); }
  /// Brings it there. @return 0 or the error number
  int sync();

  /// A continued run replaces results.h5 while the undo file belongs to the old one: under its
  /// other name it does so only as long as the new file has not taken its place.
  /// @throws IoError
  void set_aside();
  void take_back();
  /// Removes the file, also under its other name. @throws IoError
  void discard();

 private:
  void close();
  void take_up(std::uint64_t address, std::vector<std::uint8_t> bytes);

  std::filesystem::path path_, aside_;
  std::string checkpoint_;
  std::uint64_t length_ = 0;
  std::map<std::uint64_t, std::uint64_t> kept_;  // first address and end of ranges
  std::string waiting_;
  int descriptor_ = -1;
};

/// What the directory holds of results.h5 as it was at its checkpoint; null: no need, or nothing.
/// @param checkpoint as given to Hdf5Undo::begin()
std::shared_ptr<const Undone> read_undone(const std::filesystem::path& directory,
                                          const std::string& checkpoint);

/// The text that identifies a checkpoint: its trailer. Empty if there is none.
std::string checkpoint_mark(const std::filesystem::path& checkpoint);

}  // namespace buckens::run_store
