// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace buckens::page {

struct ViewPageOptions {
  std::size_t max_frames = 2000;
  /// Upper bound for the numbers of all frames together; if float32 would need more than a quarter
  /// of it, deformations and fields are rounded to 16 bits, and fewer frames are taken.
  std::size_t max_bytes = 64U << 20U;
  /// Names of the fields to show ("von_mises"); all that were recorded if it is empty.
  std::vector<std::string> fields = {};
};

/// What was put into the page of one run.
struct ViewPageReport {
  std::size_t records = 0;               ///< in the run
  std::size_t frames = 0;                ///< of them in the page
  bool rounded = false;                  ///< deformations and fields to 16 bits
  std::vector<std::string> fields = {};  ///< names of all that the run recorded, in order
};

/// One self-contained HTML page that shows a run, or two runs side by side.
///
/// `template_html` is the viewer's page, which contains the text `/*BUCKENS_DATA*/null` exactly
/// once; the runs replace that text as JSON (format 2, viewer/src/page_data.ts). Frames are taken
/// evenly from the records, the first and the last among them. Runs that are in progress or were
/// killed show what they have.
/// @param run_directories one or two
/// @param reports gets one for each
/// @throws IoError if a run cannot be read, the template does not fit, a run has no records, one
///   directory holds a run and the other vibrations, or the page cannot be written
std::string view_page(const std::vector<std::filesystem::path>& run_directories,
                      const std::filesystem::path& template_html, const ViewPageOptions& options,
                      std::vector<ViewPageReport>& reports);

/// Writes that page to a file.
std::vector<ViewPageReport> write_view_page(
    const std::vector<std::filesystem::path>& run_directories,
    const std::filesystem::path& template_html, const std::filesystem::path& output_html,
    const ViewPageOptions& options = {});

}  // namespace buckens::page
