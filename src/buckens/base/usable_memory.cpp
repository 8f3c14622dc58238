// SPDX-License-Identifier: Apache-2.0
#include "buckens/base/usable_memory.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include <sys/resource.h>
#include <unistd.h>

namespace buckens::base {

namespace {

constexpr double kUsableShare = 0.5;

double machine_memory() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

double limit_of_process() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return HUGE_VAL;
  return static_cast<double>(limit.rlim_cur);
}

/// Of the group that a container sees as its own; the word "max" is no number.
double limit_of_group() {
  std::ifstream file("/sys/fs/cgroup/memory.max");
  double bytes = 0;
  return file >> bytes && bytes > 0 ? bytes : HUGE_VAL;
}

}  // namespace

double usable_memory() {
  return kUsableShare * std::min({machine_memory(), limit_of_process(), limit_of_group()});
}

}  // namespace buckens::base
