// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/nastran/source.h"

#include <algorithm>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/files/text_file.h"
#include "buckens/mesh_io/nastran/number.h"

namespace buckens::mesh_io {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostIncludes = 1000;
constexpr std::size_t kMostText = std::size_t{1} << 30;
/// Lines over which the name of an included file may run.
constexpr int kMostNameLines = 20;

bool is_include(std::string_view text) {
  constexpr std::size_t kLength = 7;
  if (upper_case(text.substr(0, kLength)) != "INCLUDE") return false;
  return text.size() == kLength ||
         std::string_view(" \t,'\"").find(text[kLength]) != std::string_view::npos;
}

/// What makes two names of a file the same.
std::string key_of(const fs::path& path) {
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(path, error);
  return (error ? path.lexically_normal() : canonical).string();
}

}  // namespace

std::string load_nastran_file(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status)) {
    throw IoError(
        fmt::format("{}: cannot read the included file: it is not a regular file", path.string()));
  }
  return files::read_text_file(path, "included file", kMostText);
}

NastranSource::NastranSource(const fs::path& name, std::string text, LoadNastranFile load)
    : load_(std::move(load)) {
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  files_.push_back({name.string(), std::move(text)});
  open_.push_back({&files_.front(), 0, 0});
}

std::optional<NastranLine> NastranSource::raw_line() {
  while (!open_.empty()) {
    Open& top = open_.back();
    const std::string_view text = top.file->text;
    if (top.place >= text.size()) {
      open_.pop_back();
      continue;
    }
    const std::size_t end = std::min(text.find('\n', top.place), text.size());
    NastranLine line{top.file, ++top.line, text.substr(top.place, end - top.place)};
    top.place = end + 1;
    if (line.text.ends_with('\r')) line.text.remove_suffix(1);
    const std::size_t zero = line.text.find('\0');
    if (zero != std::string_view::npos) {
      throw InputError({line.file->name, line.number, static_cast<int>(zero % 1000000) + 1},
                       "there is a zero byte: this is not a text file, or it is in UTF-16; save "
                       "the deck as plain text");
    }
    return line;
  }
  return std::nullopt;
}

std::optional<NastranLine> NastranSource::next() {
  while (auto line = raw_line()) {
    const std::size_t comment = line->text.find('$');
    if (comment == 0) names_.add_comment(trimmed(line->text));
    line->text = line->text.substr(0, comment);
    const std::string_view text = trimmed(line->text);
    if (text.empty()) continue;
    if (is_include(text)) {
      include(*line);
      continue;
    }
    return line;
  }
  return std::nullopt;
}

std::string NastranSource::include_argument(const NastranLine& line) {
  std::string_view rest = trimmed(trimmed(line.text).substr(7));
  if (rest.starts_with(',')) rest = trimmed(rest.substr(1));
  if (rest.empty() || (rest[0] != '\'' && rest[0] != '"')) return std::string(rest);
  const char quote = rest[0];
  rest.remove_prefix(1);
  std::string name;
  for (int lines = 0; lines < kMostNameLines; ++lines) {
    const std::size_t end = rest.find(quote);
    name += trimmed(rest.substr(0, end));
    if (end != std::string_view::npos) return name;
    const auto more = raw_line();
    if (!more || more->file != line.file) break;
    rest = more->text;
  }
  throw InputError({line.file->name, line.number, 1},
                   "INCLUDE: the closing quotation mark of the file name is missing");
}

fs::path NastranSource::resolve(const std::string& argument, const NastranFile& from) const {
  std::string name = argument;
  std::replace(name.begin(), name.end(), '\\', '/');
  const fs::path given(name);
  if (given.is_absolute()) return given;
  const fs::path beside = fs::path(from.name).parent_path() / given;
  std::error_code error;
  if (fs::exists(beside, error)) return beside;
  const fs::path beside_main = fs::path(files_.front().name).parent_path() / given;
  return fs::exists(beside_main, error) ? beside_main : beside;
}

void NastranSource::include(const NastranLine& line) {
  const SourceLocation where{line.file->name, line.number, 1};
  const std::string argument = include_argument(line);
  if (argument.empty()) throw InputError(where, "INCLUDE has no file name");
  if (argument.size() > 4096) throw InputError(where, "INCLUDE: the name of the file is too long");
  const fs::path path = resolve(argument, *line.file);
  const std::string key = key_of(path);
  if (keys_.empty()) keys_.push_back(key_of(files_.front().name));
  for (const Open& open : open_) {
    if (key_of(open.file->name) != key) continue;
    throw InputError(
        where,
        fmt::format("INCLUDE {}: the file is already being read; files must not include each other",
                    quoted_excerpt(argument)));
  }
  if (std::find(keys_.begin(), keys_.end(), key) != keys_.end()) {
    throw InputError(
        where, fmt::format(
                   "INCLUDE {}: the file has already been included; its numbers would appear twice",
                   quoted_excerpt(argument)));
  }
  if (files_.size() >= kMostIncludes) {
    throw InputError(where, fmt::format("INCLUDE: more than {} files", kMostIncludes));
  }
  std::string text;
  try {
    text = load_(path);
  } catch (const IoError& error) {
    throw IoError(where, fmt::format("INCLUDE: {}", error.what()));
  }
  total_size_ += text.size();
  if (total_size_ > kMostText) throw InputError(where, "INCLUDE: the files are too large in total");
  files_.push_back({path.string(), std::move(text)});
  keys_.push_back(key);
  open_.push_back({&files_.back(), 0, 0});
}

}  // namespace buckens::mesh_io
