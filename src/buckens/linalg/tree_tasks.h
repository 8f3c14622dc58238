// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "buckens/base/task_pool.h"

namespace buckens::linalg {

/// Runs task(0) … task(n − 1), each once and after all those below it in a forest, and returns when
/// all have finished. Of the tasks that may begin the one with the highest number comes first.
/// A task may depend only on those below it.
/// @param parent of each task, −1 for roots @param pool may be null, or called from inside a task
/// @throws one of the exceptions of the tasks; tasks that had not begun then are not run
void run_tree(TaskPool* pool, const std::vector<int>& parent,
              const std::function<void(int task)>& task);

}  // namespace buckens::linalg
