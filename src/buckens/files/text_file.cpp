// SPDX-License-Identifier: Apache-2.0
#include "buckens/files/text_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>

#include <fmt/format.h>

#include "buckens/base/checksum.h"
#include "buckens/base/errors.h"

namespace buckens::files {

namespace {

[[noreturn]] void fail(const std::string& name, const std::string& kind,
                       const std::string& reason) {
  throw IoError(fmt::format("{}: cannot read the {}: {}", name, kind, reason));
}

thread_local FilesRead* files_read = nullptr;

}  // namespace

FilesRead::FilesRead() : outer_(files_read) { files_read = this; }

FilesRead::~FilesRead() { files_read = outer_; }

void FilesRead::add(const std::filesystem::path& path, std::string_view content) {
  hashes_[path] = base::checksum(content);
  if (outer_ != nullptr) outer_->add(path, content);
}

std::string read_text_file(const std::filesystem::path& path, const std::string& kind,
                           std::size_t largest) {
  namespace fs = std::filesystem;
  const std::string name = path.string();
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) fail(name, kind, "there is no such file");
  if (error) fail(name, kind, error.message());
  if (fs::is_directory(status)) fail(name, kind, "it is a directory; name a file in it");
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) fail(name, kind, errno != 0 ? std::strerror(errno) : "it cannot be opened");
  std::string text;
  // Piece by piece: pipes and devices have no size to ask for.
  std::string piece(1u << 16, '\0');
  while (stream.read(piece.data(), static_cast<std::streamsize>(piece.size())) ||
         stream.gcount() > 0) {
    text.append(piece, 0, static_cast<std::size_t>(stream.gcount()));
    if (text.size() > largest) {
      fail(name, kind, fmt::format("it is larger than {} MB", largest >> 20));
    }
  }
  if (stream.bad()) fail(name, kind, errno != 0 ? std::strerror(errno) : "reading failed");
  if (files_read != nullptr) files_read->add(path, text);
  return text;
}

}  // namespace buckens::files
