// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>

namespace buckens::io {

struct ViewPageOptions {
  std::size_t max_frames = 2000;
  /// Upper bound for the numbers of all frames together; fewer frames are taken to keep it.
  std::size_t max_bytes = 96U << 20U;
};

/// What went into a page.
struct ViewPageReport {
  std::size_t records = 0;  ///< in the run
  std::size_t frames = 0;   ///< of them in the page
};

/// Writes one self-contained HTML page that shows a run.
///
/// `template_html` is the viewer's page, which holds the text `/*BUCKENS_DATA*/null` exactly once;
/// the run takes the place of that text as JSON (format 1, viewer/src/page_data.ts). Frames are
/// taken evenly from the records, the first and the last among them. Runs that go on or were killed
/// show what they have.
/// @throws IoError if the run cannot be read, the template does not fit, the run has no records, or
///   the page cannot be written
ViewPageReport write_view_page(const std::filesystem::path& run_directory,
                               const std::filesystem::path& template_html,
                               const std::filesystem::path& output_html,
                               const ViewPageOptions& options = {});

}  // namespace buckens::io
