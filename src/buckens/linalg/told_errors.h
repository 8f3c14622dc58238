// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <exception>
#include <new>

namespace buckens::linalg {

/// Does something that the plug-in asks for. Errors end here, since C is between it and the
/// program, and are written into `error`.
/// @param little_memory what to write if memory is too small
/// @return not zero after an error
template <class Action>
int told_errors(char* error, int error_size, const char* little_memory, Action&& action) {
  const auto tell = [&](const char* why) {
    std::snprintf(error, static_cast<std::size_t>(error_size), "%s", why);
    return 1;
  };
  try {
    action();
    return 0;
  } catch (const std::bad_alloc&) {
    return tell(little_memory);
  } catch (const std::exception& failure) {
    return tell(failure.what());
  }
}

}  // namespace buckens::linalg
