// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

#include "buckens/base/source_location.h"

namespace buckens {

/// Base class of all exceptions that the library throws. Messages state the error, its location,
/// the value and a remedy.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message) : std::runtime_error(message) {}
  /// Prefixes the message with "file:line:column: " if the location is known.
  Error(const SourceLocation& where, const std::string& message)
      : std::runtime_error(where.empty() ? message : where.text() + ": " + message),
        where_(where) {}

  /// Empty if the location is not known.
  const SourceLocation& where() const { return where_; }
  /// The message without the location, for composing longer messages.
  std::string text() const {
    return where_.empty() ? what() : std::string(what()).substr(where_.text().size() + 2);
  }

 private:
  SourceLocation where_;
};

/// The input is invalid: syntax, unknown names, units, ranges.
class InputError : public Error {
  using Error::Error;
};

/// The input is valid, but the mechanism that it describes cannot be built or solved.
class ModelError : public Error {
  using Error::Error;
};

/// A calculation failed: no convergence, a value that is not finite, or a singular matrix.
class NumericalError : public Error {
  using Error::Error;
};

/// A step is too long for what happens within it; a shorter one will do.
class StepTooLong : public NumericalError {
  using NumericalError::NumericalError;
};

/// A file or directory cannot be read or written.
class IoError : public Error {
  using Error::Error;
};

/// Throws std::logic_error with the location and text of a violated assertion.
[[noreturn]] void assertion_failed(const char* expression, const char* file, int line);

}  // namespace buckens

/// For bugs in the library, never for user errors; checked in builds with assertions.
#ifdef BUCKENS_ASSERTIONS
#define BUCKENS_ASSERT(condition)         \
  (static_cast<bool>(condition) ? void(0) \
                                : ::buckens::assertion_failed(#condition, __FILE__, __LINE__))
#else
#define BUCKENS_ASSERT(condition) static_cast<void>(sizeof(static_cast<bool>(condition)))
#endif
