// SPDX-License-Identifier: Apache-2.0
#include "nameless_file.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <iterator>

#include <fcntl.h>
#include <linux/magic.h>
#include <sys/statfs.h>
#include <unistd.h>

namespace buckens_petsc {

namespace {

// File systems in memory, and of networks. The headers of Debian 12 name neither Lustre's nor
// GPFS's.
constexpr unsigned kLustre = 0x0bd00bd0, kGpfs = 0x47504653;
constexpr unsigned kNoDisks[] = {TMPFS_MAGIC,
                                 RAMFS_MAGIC,
                                 NFS_SUPER_MAGIC,
                                 SMB_SUPER_MAGIC,
                                 CIFS_SUPER_MAGIC,
                                 SMB2_SUPER_MAGIC,
                                 CEPH_SUPER_MAGIC,
                                 AFS_SUPER_MAGIC,
                                 V9FS_MAGIC,
                                 kLustre,
                                 kGpfs};

bool is_disk(int file) {
  struct statfs system {};
  if (::fstatfs(file, &system) != 0) return false;
  const auto kind = static_cast<unsigned>(system.f_type);
  return std::find(std::begin(kNoDisks), std::end(kNoDisks), kind) == std::end(kNoDisks);
}

bool is_switched_off() {
  const char* text = std::getenv("BUCKENS_MPI_DISK");
  return text != nullptr && std::strcmp(text, "off") == 0;
}

}  // namespace

int nameless_file() {
  if (is_switched_off()) return -1;
  const char* chosen = std::getenv("TMPDIR");
  for (const char* folder : {chosen, "/var/tmp", "/tmp"}) {
    if (folder == nullptr) continue;
    const int file = ::open(folder, O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
    if (file < 0) continue;
    if (is_disk(file)) return file;
    ::close(file);
  }
  return -1;
}

}  // namespace buckens_petsc
