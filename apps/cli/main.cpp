// SPDX-License-Identifier: Apache-2.0
#include "cli/interruption.h"
#include "cli/output.h"
#include "cli/program.h"
#include "cli/several_processes.h"

#include "buckens/linalg/blas_kernels.h"

int main(int argc, char** argv) {
  buckens::cli::hold_standard_streams();
  buckens::cli::ignore_write_signals();
  buckens::linalg::choose_blas_kernels();
  return buckens::cli::are_several(argc, argv) ? buckens::cli::run_together(argc, argv)
                                               : buckens::cli::run_program(argc, argv);
}
