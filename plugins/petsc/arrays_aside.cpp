// SPDX-License-Identifier: Apache-2.0
#include "arrays_aside.h"

#include <cerrno>

#include <unistd.h>

#include "nameless_file.h"

namespace buckens_petsc {

ArraysAside::ArraysAside() : file_(nameless_file()) {}

ArraysAside::~ArraysAside() {
  if (file_ >= 0) ::close(file_);
}

bool ArraysAside::write(const void* bytes, std::size_t size) {
  const auto* from = static_cast<const char*>(bytes);
  for (std::size_t done = 0; done < size;) {
    const ssize_t count =
        file_ < 0 ? -1 : ::pwrite(file_, from + done, size - done, end_ + static_cast<off_t>(done));
    if (count < 0 && file_ >= 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    done += static_cast<std::size_t>(count);
  }
  end_ += static_cast<off_t>(size);
  return true;
}

bool ArraysAside::read(void* bytes, std::size_t size, off_t at) const {
  auto* to = static_cast<char*>(bytes);
  for (std::size_t done = 0; done < size;) {
    const ssize_t count = ::pread(file_, to + done, size - done, at + static_cast<off_t>(done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    done += static_cast<std::size_t>(count);
  }
  return true;
}

bool ArraysAside::bring_back() {
  bool is_complete = true;
  for (const auto& fill : returns_) is_complete = fill() && is_complete;
  returns_.clear();
  return is_complete;
}

}  // namespace buckens_petsc
