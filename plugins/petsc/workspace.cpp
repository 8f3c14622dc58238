// SPDX-License-Identifier: Apache-2.0
#include "workspace.h"

#include <sys/mman.h>
#include <unistd.h>

namespace buckens_petsc {

bool Workspace::set_aside(std::size_t numbers) {
  if (data_ != nullptr) ::munmap(data_, bytes_);
  data_ = nullptr;
  bytes_ = numbers * sizeof(double);
  if (numbers == 0) return true;
  void* found = ::mmap(nullptr, bytes_, PROT_READ | PROT_WRITE,
                       MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (found == MAP_FAILED) return false;
  data_ = static_cast<double*>(found);
  return true;
}

void Workspace::keep(std::size_t numbers) {
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  const std::size_t end = (numbers * sizeof(double) + page - 1) / page * page;
  if (data_ == nullptr || end >= bytes_) return;
  (void)::madvise(reinterpret_cast<char*>(data_) + end, bytes_ - end, MADV_DONTNEED);
}

}  // namespace buckens_petsc
