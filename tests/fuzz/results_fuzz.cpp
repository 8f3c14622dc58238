// SPDX-License-Identifier: Apache-2.0
// Results and a stored basis, changed as the input says (result_edits.h): every reader accepts
// them or refuses them with an error of this library. Changes of whole objects leave a file that is
// sound as such, so that they reach our own checks; changed bytes are for HDF5.
#include <nlohmann/json.hpp>

#include "tests/fuzz/result_edits.h"

#include "buckens/base/errors.h"
#include "buckens/base/test/temporary_directory.h"
#include "buckens/exports/csv.h"
#include "buckens/exports/glb.h"
#include "buckens/exports/vtk.h"
#include "buckens/page/run.h"
#include "buckens/run_store/basis_files.h"
#include "buckens/run_store/run_comparison.h"
#include "buckens/run_store/run_curves.h"
#include "buckens/run_store/run_directory.h"
#include "buckens/run_store/run_reader.h"
#include "buckens/run_store/test/sample_fields.h"
#include "buckens/run_store/test/sample_run.h"

namespace {

namespace fs = std::filesystem;
namespace exports = buckens::exports;
namespace page = buckens::page;
namespace run_store = buckens::run_store;

constexpr std::uint64_t kKey = 7;

void write_samples(const fs::path& place) {
  run_store::test::write_fields_run(place / "good", 12);
  run_store::BasisFiles bases(place);
  buckens::body::ReducedBasis basis;
  basis.Z = Eigen::MatrixXd::Identity(12, 2);
  basis.omega = Eigen::VectorXd::Constant(2, 3.0);
  bases.keep("good.basis", kKey, basis);
  fs::create_directory(place / "run");
  for (const char* name : {run_store::kSummaryName, run_store::kSensorsName}) {
    fs::copy_file(place / "good" / name, place / "run" / name);
  }
}

template <typename Work>
void attempt(const Work& work) {
  try {
    work();
  } catch (const buckens::Error&) {  // refused
  }
}

void read_run(const fs::path& place) {
  const run_store::RunReader run(place / "run");
  attempt([&] { exports::export_csv(run, {}, place / "out"); });
  attempt([&] { exports::export_vtk(run, {}, place / "out", "x"); });
  attempt([&] { exports::export_glb(run, {}, place / "out" / "x.glb"); });
  attempt([&] { run_store::compare_runs(run, run_store::RunReader(place / "good")); });
  attempt([&] {
    for (const std::string& name : run_store::sensor_names(run)) run_store::find_curves(run, name);
  });
  attempt([&] {
    page::ViewPageReport report;
    const std::string page = page::page_run(place / "run", {}, report).dump();
  });
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer looks for this name.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const buckens::test::TemporaryDirectory directory;
  static const bool is_first = [] {
    write_samples(directory.path());
    fs::create_directory(directory / "out");
    return true;
  }();
  const buckens::fuzz::ResultEdits edits(
      std::string(reinterpret_cast<const char*>(data), is_first ? size : 0));
  const auto anew = fs::copy_options::overwrite_existing;
  const fs::path results = directory / "run" / run_store::kResultsName;
  fs::copy_file(directory / "good" / run_store::kResultsName, results, anew);
  edits.apply(results);
  attempt([] { read_run(directory.path()); });
  fs::copy_file(directory / "good.basis", directory / "basis", anew);
  edits.apply(directory / "basis");
  attempt([] { run_store::BasisFiles(directory.path()).find("basis", kKey); });
  return 0;
}
