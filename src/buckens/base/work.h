// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace buckens::base {

/// How far something is that takes long before a simulation begins, such as meshing a part.
struct Work {
  std::string name;       ///< "meshing rod.step"
  std::string stage;      ///< "faces"; empty: the work is over
  long done = 0, of = 0;  ///< of this stage; of = 0: nobody knows
  std::string outlook;    ///< "about 2100 elements"; empty: not known yet
  bool is_long = false;   ///< who waits should be told of the outlook at once
};

/// Takes reports of work; called under a lock, so it must not report itself.
using WorkSink = std::function<void(const Work& work)>;

/// Sets where reports go, for the whole process; an empty sink (the default) drops them. The
/// library itself never prints. May be called from any thread.
void set_work_sink(WorkSink sink);

void report_work(const Work& work);

}  // namespace buckens::base
