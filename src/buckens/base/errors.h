// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

#include "buckens/base/source_location.h"

namespace buckens {

/// Base of all exceptions the library throws. Messages say what is wrong, where, the value, and
/// what to do about it.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message) : std::runtime_error(message) {}
  /// Puts "file:line:column: " before the message if the place is known.
  Error(const SourceLocation& where, const std::string& message)
      : std::runtime_error(where.empty() ? message : where.text() + ": " + message),
        where_(where) {}

  /// Empty if the place is not known.
  const SourceLocation& where() const { return where_; }
  /// The message without the place, for building longer messages.
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

/// The input can be read but the mechanism it describes cannot be built or solved.
class ModelError : public Error {
  using Error::Error;
};

/// A calculation failed on the way: no convergence, not a number, a singular matrix.
class NumericalError : public Error {
  using Error::Error;
};

/// A file or directory cannot be read or written.
class IoError : public Error {
  using Error::Error;
};

/// Throws std::logic_error with the place and text of a violated assertion.
[[noreturn]] void assertion_failed(const char* expression, const char* file, int line);

}  // namespace buckens

/// For bugs in this library, never for user errors: checked in builds with assertions.
#ifdef BUCKENS_ASSERTIONS
#define BUCKENS_ASSERT(condition)         \
  (static_cast<bool>(condition) ? void(0) \
                                : ::buckens::assertion_failed(#condition, __FILE__, __LINE__))
#else
#define BUCKENS_ASSERT(condition) static_cast<void>(sizeof(static_cast<bool>(condition)))
#endif
