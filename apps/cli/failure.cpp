// SPDX-License-Identifier: Apache-2.0
#include "cli/failure.h"

#include <cstdio>
#include <filesystem>
#include <new>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/output.h"

#include "buckens/base/errors.h"

namespace buckens::cli {

namespace {

using Json = nlohmann::ordered_json;

}  // namespace

Failure describe_failure(const std::exception_ptr& thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const InputError& error) {
    return {ExitCode::input, "input", error.what(), error.where()};
  } catch (const ModelError& error) {
    return {ExitCode::model, "model", error.what(), error.where()};
  } catch (const NumericalError& error) {
    return {ExitCode::numerical, "numerical", error.what(), error.where()};
  } catch (const IoError& error) {
    return {ExitCode::io, "io", error.what(), error.where()};
  } catch (const std::bad_alloc&) {
    return {ExitCode::numerical,
            "memory",
            "not enough memory. Use fewer elements, or a machine with more memory.",
            {}};
  } catch (const std::filesystem::filesystem_error& error) {
    return {ExitCode::io, "io", error.what(), {}};
  } catch (const std::exception& error) {
    return {ExitCode::internal,
            "internal",
            fmt::format("internal error, please report it with the model file: {}", error.what()),
            {}};
  } catch (...) {
    return {ExitCode::internal,
            "internal",
            "internal error of an unknown kind, please report it with the model file.",
            {}};
  }
}

std::string failure_json(const Failure& failure) {
  const SourceLocation& where = failure.where;
  const Json error = {{"kind", failure.kind},
                      {"message", failure.message},
                      {"file", where.empty() ? Json(nullptr) : Json(where.file)},
                      {"line", where.line > 0 ? Json(where.line) : Json(nullptr)},
                      {"column", where.line > 0 ? Json(where.column) : Json(nullptr)}};
  return to_text(Json{{"error", error}});
}

int report_failure(const Failure& failure, bool json) {
  tell(stderr, fmt::format("buckens: error: {}\n", failure.message));
  // If the output is what cannot be written, this fails, too; the exit code tells it already.
  if (json) try_print(failure_json(failure));
  return static_cast<int>(failure.code);
}

}  // namespace buckens::cli
