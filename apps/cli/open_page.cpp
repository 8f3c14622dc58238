// SPDX-License-Identifier: Apache-2.0
#include "cli/open_page.h"

#include <array>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "buckens/base/errors.h"

namespace buckens::cli {

void open_in_browser(const std::string& address) {
  std::string program = "xdg-open", argument = address;
  std::array<char*, 3> arguments = {program.data(), argument.data(), nullptr};
  // Its messages must not mix with ours.
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_RDWR, 0);
  }
  pid_t child = -1;
  const int error =
      ::posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) {
    throw IoError(
        fmt::format("--open: cannot start {}: {}. Install the package xdg-utils, or open {} "
                    "yourself.",
                    program, std::generic_category().message(error), address));
  }
}

}  // namespace buckens::cli
