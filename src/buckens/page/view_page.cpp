// SPDX-License-Identifier: Apache-2.0
#include "buckens/page/view_page.h"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "buckens/base/errors.h"
#include "buckens/files/output_file.h"
#include "buckens/page/origin.h"
#include "buckens/page/run.h"

namespace buckens::page {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kMarker = "/*BUCKENS_DATA*/null";
constexpr int kPageFormat = 2;

/// JSON that may stand inside a <script> element: a name like "</script>" must not end it. These
/// characters occur in JSON only within strings, where escapes mean the same.
std::string script_text(const Json& json) {
  const std::string plain = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string text;
  text.reserve(plain.size());
  for (std::size_t i = 0; i < plain.size(); ++i) {
    const char c = plain[i];
    if (c == '<' || c == '>' || c == '&') {
      text += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else if (plain.compare(i, 3, "\u2028") == 0 || plain.compare(i, 3, "\u2029") == 0) {
      text += plain[i + 2] == '\xA8' ? "\\u2028" : "\\u2029";  // line ends in older JavaScript
      i += 2;
    } else {
      text += c;
    }
  }
  return text;
}

}  // namespace

std::string view_page(const std::vector<std::filesystem::path>& run_directories,
                      const std::filesystem::path& template_html, const ViewPageOptions& options,
                      std::vector<ViewPageReport>& reports) {
  std::string page = files::read_text_file(template_html);
  const std::size_t at = page.find(kMarker);
  if (at == page.npos || page.find(kMarker, at + 1) != page.npos) {
    throw IoError(
        fmt::format("{}: not the viewer's page: it must hold the text {} exactly once. "
                    "Install Buckens again.",
                    template_html.string(), kMarker));
  }
  ViewPageOptions share = options;
  share.max_bytes /= run_directories.size();
  reports.assign(run_directories.size(), {});
  const std::vector<std::string> names = directory_names(run_directories);
  Json runs = Json::array();
  for (std::size_t i = 0; i < run_directories.size(); ++i) {
    runs.push_back(page_run(run_directories[i], share, reports[i]));
    runs.back()["directory"] = names[i];
  }
  if (runs.front()["modes"].is_null() != runs.back()["modes"].is_null()) {
    throw IoError(fmt::format(
        "{} holds {} and {} the other: a run and the shapes of vibrations "
        "cannot be shown side by side.",
        run_directories.front().string(), runs.front()["modes"].is_null() ? "a run" : "vibrations",
        run_directories.back().string()));
  }
  page.replace(at, kMarker.size(),
               script_text({{"format", kPageFormat}, {"runs", std::move(runs)}}));
  return page;
}

std::vector<ViewPageReport> write_view_page(
    const std::vector<std::filesystem::path>& run_directories,
    const std::filesystem::path& template_html, const std::filesystem::path& output_html,
    const ViewPageOptions& options) {
  std::vector<ViewPageReport> reports;
  files::replace_text_file(output_html,
                           view_page(run_directories, template_html, options, reports));
  return reports;
}

}  // namespace buckens::page
