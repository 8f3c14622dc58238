// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <exception>
#include <string>

#include "cli/exit_code.h"

#include "buckens/base/source_location.h"

namespace buckens::cli {

/// An error as shown to the user.
struct Failure {
  ExitCode code = ExitCode::internal;
  std::string kind;      ///< "usage", "input", "model", "numerical", "memory", "io", "internal"
  std::string message;   ///< preceded by the place if known
  SourceLocation where;  ///< empty if unknown
};

/// Converts any exception into a failure with its exit code.
Failure describe_failure(const std::exception_ptr& thrown);

/// {"error": {"kind", "message", "file", "line", "column"}}; unknown places are null.
std::string failure_json(const Failure& failure);

/// Prints "buckens: error: ..." to the standard error stream, with `json` the object to the
/// standard output as well.
/// @return the exit code
int report_failure(const Failure& failure, bool json);

}  // namespace buckens::cli
