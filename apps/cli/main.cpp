// SPDX-License-Identifier: Apache-2.0
#include "cli/interruption.h"
#include "cli/output.h"
#include "cli/program.h"

int main(int argc, char** argv) {
  buckens::cli::hold_standard_streams();
  buckens::cli::ignore_write_signals();
  return buckens::cli::run_program(argc, argv);
}
