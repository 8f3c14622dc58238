// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace buckens::cli {

/// Whether mpirun has started several processes for a verb that solves large systems, which they
/// are to do together, or for a whole sweep, which is refused. Other verbs, such as shards of a
/// sweep, run once per process.
bool are_several(int argc, const char* const* argv);

/// The first process runs the program; the others hold their shares of factors until it ends.
/// @return exit code: of the others 0, unless they could not begin
int run_together(int argc, const char* const* argv);

}  // namespace buckens::cli
