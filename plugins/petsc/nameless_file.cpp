// SPDX-License-Identifier: Apache-2.0
#include "nameless_file.h"

#include <cstdlib>
#include <initializer_list>

#include <fcntl.h>
#include <linux/magic.h>
#include <sys/statfs.h>
#include <unistd.h>

namespace buckens_petsc {

int nameless_file() {
  const char* chosen = std::getenv("TMPDIR");
  for (const char* folder : {chosen, "/var/tmp", "/tmp"}) {
    if (folder == nullptr) continue;
    const int file = ::open(folder, O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
    if (file < 0) continue;
    struct statfs system {};
    const bool is_disk = ::fstatfs(file, &system) == 0 && system.f_type != TMPFS_MAGIC &&
                         system.f_type != RAMFS_MAGIC;
    if (is_disk) return file;
    ::close(file);
  }
  return -1;
}

}  // namespace buckens_petsc
