// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace buckens::cli {

/// The whole program: reads the command line, executes it, reports errors.
/// @return exit code
int run_program(int argc, const char* const* argv);

}  // namespace buckens::cli
