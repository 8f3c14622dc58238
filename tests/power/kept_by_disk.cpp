// SPDX-License-Identifier: Apache-2.0
// Loaded before the program (LD_PRELOAD), it keeps what the disk certainly has: at each fsync of a
// file its content goes to the directory DISK_KEEPS. What a loss of power leaves is that, and any
// part of what was written later.
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace {

std::string kept_name(const std::string& path) {
  const char* directory = std::getenv("DISK_KEEPS");
  if (directory == nullptr) return {};
  return std::string(directory) + '/' + path.substr(path.find_last_of('/') + 1);
}

/// Complete or not at all, as the disk would have it for a test that looks at any moment.
void keep(const std::string& path, const std::string& name) {
  const std::string part = name + ".copy";
  const int in = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const int out = ::open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (in < 0 || out < 0) std::abort();
  char block[1 << 16];
  off_t at = 0;
  for (ssize_t size = 0; (size = ::pread(in, block, sizeof block, at)) > 0; at += size) {
    if (::write(out, block, static_cast<std::size_t>(size)) != size) std::abort();
  }
  ::close(in);
  ::close(out);
  if (std::rename(part.c_str(), name.c_str()) != 0) std::abort();
}

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" int fsync(int descriptor) {
  static const auto real = next<int (*)(int)>("fsync");
  struct stat about {};
  char path[4096];
  const std::string link = "/proc/self/fd/" + std::to_string(descriptor);
  const ssize_t length = ::readlink(link.c_str(), path, sizeof path);
  if (length > 0 && ::fstat(descriptor, &about) == 0 && S_ISREG(about.st_mode)) {
    const std::string file(path, static_cast<std::size_t>(length));
    const std::string name = kept_name(file);
    if (!name.empty()) keep(file, name);
  }
  return real(descriptor);
}

extern "C" int rename(const char* from, const char* to) noexcept {
  static const auto real = next<int (*)(const char*, const char*)>("rename");
  const int result = real(from, to);
  const std::string kept = kept_name(from);
  if (result == 0 && !kept.empty() && ::access(kept.c_str(), F_OK) == 0) {
    real(kept.c_str(), kept_name(to).c_str());
  }
  return result;
}
