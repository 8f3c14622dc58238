// SPDX-License-Identifier: Apache-2.0
#include "cli/viewer_page.h"

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "buckens/analysis/simulation/simulation.h"
#include "buckens/base/errors.h"
#include "buckens/files/output_file.h"
#include "buckens/page/view_page.h"
#include "buckens/run_store/run_directory.h"

namespace buckens::cli {

namespace fs = std::filesystem;

namespace {

/// A directory that exists as long as the object.
class PassingDirectory {
 public:
  PassingDirectory() {
    std::string name = (fs::temp_directory_path() / "buckens-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
      throw IoError(
          fmt::format("{}: cannot create a directory: {}", name, files::system_reason(errno)));
    }
    path_ = name;
  }
  ~PassingDirectory() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  PassingDirectory(const PassingDirectory&) = delete;
  PassingDirectory& operator=(const PassingDirectory&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

}  // namespace

fs::path find_page_template() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path page = (program.parent_path() / "../share/buckens/viewer.html").lexically_normal();
  if (error || !fs::is_regular_file(page, error)) {
    throw IoError(fmt::format(
        "{}: the page of the viewer is missing. It is built by the target buckens_viewer, which "
        "needs npm; configure again with -DBUCKENS_VIEWER=ON after tools/setup.sh, and build.",
        page.string()));
  }
  return page;
}

void write_model_page(model::BuiltModel& built, const fs::path& page) {
  const fs::path page_template = find_page_template();
  if (!built.description.simulation) {
    built.description.simulation.emplace();
    built.description.simulation->duration = 1;
    built.description.simulation->step = 1e-3;
  }
  analysis::SimulationOptions options;
  options.stop_reason = "this is the assembled model, no step was taken";
  options.tells_warnings = false;
  analysis::Simulation simulation(built, options);
  const PassingDirectory place;
  const fs::path run = place.path() / page.stem();
  {
    run_store::RunDirectory directory(run, {built.description.title, built.description.source, {}});
    simulation.record_into(directory);
    simulation.values("energies/total");  // writes the record of the start
    simulation.finish();
  }
  page::write_view_page({run}, page_template, page);
}

}  // namespace buckens::cli
