// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace buckens::run_store {

inline constexpr int kStateFormat = 1;
inline constexpr std::size_t kStateTrailer = 80;

/// The text at the end of a saved state: what the file is, and size and checksum of what comes
/// before it. kStateTrailer bytes.
std::string state_trailer(std::uint64_t size, std::uint64_t checksum);

/// The file of a saved state, whose trailer was right when it was opened.
///
/// The content is read in pieces. Each must be what it was when the file was checked, so that what
/// happens to the file in between is an error and never another state. A file that takes the place
/// of this one changes nothing. One thread at a time may use it.
class SealedFile {
 public:
  /// @throws IoError if the file cannot be read, is not a saved state, has another format, is
  /// truncated or damaged
  explicit SealedFile(const std::filesystem::path& path);
  ~SealedFile();
  SealedFile(const SealedFile&) = delete;
  SealedFile& operator=(const SealedFile&) = delete;

  /// Bytes before the trailer.
  std::uint64_t size() const { return size_; }
  /// Reads some of them; says false, and later why, if they are not there or no longer the same.
  bool read(std::uint64_t first, std::size_t count, void* to) const noexcept;
  /// @throws IoError after a read has found the file changed
  void require_unchanged() const;
  /// @throws IoError what is wrong with the content
  [[noreturn]] void refuse(std::string_view what) const;

 private:
  static constexpr std::uint64_t kPiece = 1U << 16U;

  void check(std::string_view end, bool is_hdf5) const;
  std::uint64_t take_checksums();
  std::string bytes_at(std::uint64_t first, std::size_t count) const;
  std::size_t size_of_piece(std::uint64_t piece) const;
  bool read_piece(std::uint64_t piece, char* to) const noexcept;

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  std::vector<std::uint64_t> checksums_;       // of all that is before each piece, and of all
  mutable std::vector<char> piece_;            // the last one of which a part was read
  mutable std::uint64_t number_ = UINT64_MAX;  // of that piece
  mutable bool has_changed_ = false;
};

}  // namespace buckens::run_store
