// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/run_directory.h"

#include <array>
#include <csignal>
#include <fstream>
#include <map>
#include <thread>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include "buckens/base/errors.h"
#include "buckens/base/test/temporary_directory.h"
#include "buckens/run_store/run_reader.h"
#include "buckens/run_store/test/file_size_limit.h"
#include "buckens/run_store/test/sample_run.h"

namespace buckens::run_store {
namespace {

using buckens::test::TemporaryDirectory;
using test::finished_summary;
using test::sample_geometry;
using test::sample_layout;
using test::sample_record;
using test::sample_value;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

nlohmann::json summary_of(const std::filesystem::path& run) {
  return nlohmann::json::parse(files::read_text_file(run / kSummaryName));
}

void write_run(const std::filesystem::path& path, std::size_t records, bool finish = true) {
  RunDirectory run(path, {.title = "sample", .model_text = "buckens: 1\n", .flush = {}});
  const results::RecordLayout layout = sample_layout();
  run.begin(layout, sample_geometry());
  for (std::size_t i = 0; i < records; ++i) run.write(sample_record(i, layout.num_values()));
  if (finish) run.finish(finished_summary());
}

/// As a chain of 1000 links has them; HDF5 used freed memory where it made room among them.
TEST(RunDirectory, KeepsThousandsOfChannels) {
  constexpr int kChannels = 4500;
  const TemporaryDirectory directory;
  results::RecordLayout layout;
  for (int k = 0; k < kChannels; ++k) {
    layout.add({fmt::format("joints/j{}/force", k), "N", {3}, "on a marker", {"x", "y", "z"}});
  }
  {
    RunDirectory run(directory / "out",
                     {.title = "many", .model_text = "buckens: 1\n", .flush = {}});
    run.begin(layout, {});
    for (std::size_t i = 0; i < 3; ++i) run.write(sample_record(i, layout.num_values()));
    run.finish(finished_summary());
  }
  const RunReader run(directory / "out");
  ASSERT_EQ(run.num_records(), 3U);
  const std::vector<double> last = run.read("joints/j4000/force", std::array<std::size_t, 1>{2});
  ASSERT_EQ(last.size(), 3U);
  EXPECT_EQ(last[1], sample_value(2, 3 * 4000 + 1));
}

TEST(RunDirectory, ComesBackAsWritten) {
  const TemporaryDirectory directory;
  constexpr std::size_t kRecords = 357;  // several flushes and a part of one
  write_run(directory / "out", kRecords);

  const RunReader run(directory / "out");
  EXPECT_EQ(run.status(), RunStatus::finished);
  EXPECT_EQ(run.title(), "sample");
  ASSERT_EQ(run.num_records(), kRecords);
  EXPECT_EQ(run.times()[200], 0.2);
  const results::RecordLayout layout = sample_layout();
  ASSERT_EQ(run.layout().channels().size(), layout.channels().size());
  for (std::size_t c = 0; c < layout.channels().size(); ++c) {
    const results::Channel& channel = layout.channel(c);
    const int found = run.layout().find(channel.path);
    ASSERT_GE(found, 0) << channel.path;
    const results::Channel& read = run.layout().channel(static_cast<std::size_t>(found));
    EXPECT_EQ(read.unit, channel.unit);
    EXPECT_EQ(read.shape, channel.shape);
    EXPECT_EQ(read.description, channel.description);
    EXPECT_EQ(read.components, channel.components);
    const std::vector<double> values = run.read(channel.path);
    ASSERT_EQ(values.size(), kRecords * channel.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::size_t record = i / channel.size();
      // The file stores doubles: equal to the last bit.
      ASSERT_EQ(values[i], sample_value(record, layout.offset(c) + i % channel.size()));
    }
  }
  EXPECT_EQ(files::read_text_file(directory / "out" / kModelName), "buckens: 1\n");
}

TEST(RunDirectory, KeepsTheGeometry) {
  const TemporaryDirectory directory;
  write_run(directory / "out", 1);
  const results::Geometry wanted = sample_geometry();
  const results::Geometry read = RunReader(directory / "out").geometry();
  EXPECT_EQ(read.gravity, wanted.gravity);
  EXPECT_EQ(read.planar, "xy");
  ASSERT_EQ(read.bodies.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const results::GeometryBody& body = read.bodies[i];
    EXPECT_EQ(body.name, wanted.bodies[i].name);
    EXPECT_EQ(body.kind, wanted.bodies[i].kind);
    EXPECT_EQ(body.nodes, wanted.bodies[i].nodes);
    EXPECT_EQ(body.elements, wanted.bodies[i].elements);
    EXPECT_EQ(body.radius, wanted.bodies[i].radius);
    EXPECT_EQ(body.sections, wanted.bodies[i].sections);
    EXPECT_EQ(body.element_sections, wanted.bodies[i].element_sections);
    EXPECT_EQ(body.element_y, wanted.bodies[i].element_y);
    ASSERT_EQ(body.markers.size(), wanted.bodies[i].markers.size());
    for (std::size_t m = 0; m < body.markers.size(); ++m) {
      const results::GeometryMarker& marker = wanted.bodies[i].markers[m];
      EXPECT_EQ(body.markers[m].name, marker.name);
      EXPECT_EQ(body.markers[m].node, marker.node);
      EXPECT_EQ(body.markers[m].X_BF.p, marker.X_BF.p);
      EXPECT_EQ(body.markers[m].X_BF.q.coeffs(), marker.X_BF.q.coeffs());
    }
  }
  ASSERT_EQ(read.joints.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read.joints[i].name, wanted.joints[i].name);
    EXPECT_EQ(read.joints[i].type, wanted.joints[i].type);
    EXPECT_EQ(read.joints[i].axis, wanted.joints[i].axis);
    for (std::size_t s = 0; s < 2; ++s) {
      EXPECT_EQ(read.joints[i].between[s].body, wanted.joints[i].between[s].body);
      EXPECT_EQ(read.joints[i].between[s].marker, wanted.joints[i].between[s].marker);
      EXPECT_EQ(read.joints[i].between[s].position, wanted.joints[i].between[s].position);
    }
  }
}

TEST(RunDirectory, TellsItsStatus) {
  const TemporaryDirectory directory;
  const results::RecordLayout layout = sample_layout();
  {
    RunDirectory run(directory / "out");
    EXPECT_EQ(summary_of(run.path())["status"], "starting");
    run.log("a line");
    EXPECT_EQ(files::read_text_file(run.path() / kLogName), "a line\n");
    EXPECT_THAT([&] { RunReader{run.path()}; },
                ThrowsMessage<IoError>(HasSubstr("results.h5 is missing")));
    run.begin(layout, sample_geometry());
    EXPECT_EQ(summary_of(run.path())["status"], "running");
    run.write(sample_record(0, layout.num_values()));
  }
  const nlohmann::json summary = summary_of(directory / "out");
  EXPECT_EQ(summary["status"], "interrupted");
  EXPECT_EQ(summary["interrupted"], "the run ended without a summary");
  EXPECT_EQ(RunReader(directory / "out").num_records(), 1U);
}

TEST(RunDirectory, ReplacesAnEarlierRunAndNothingElse) {
  const TemporaryDirectory directory;
  write_run(directory / "out", 50);
  std::ofstream(directory / "out" / "notes.txt") << "mine";
  write_run(directory / "out", 3);
  EXPECT_EQ(RunReader(directory / "out").num_records(), 3U);
  EXPECT_EQ(files::read_text_file(directory / "out" / "notes.txt"), "mine");
}

/// All files of a run with their contents.
std::map<std::string, std::string> contents_of(const std::filesystem::path& run) {
  std::map<std::string, std::string> out;
  for (const auto& entry : std::filesystem::directory_iterator(run)) {
    out[entry.path().filename().string()] = files::read_text_file(entry.path());
  }
  return out;
}

TEST(RunDirectory, LeavesAnEarlierRunAsItWasUntilItHasResults) {
  const TemporaryDirectory directory;
  write_run(directory / "out", 50);
  std::ofstream(directory / "out" / kLogName) << "what was said then\n";
  const auto before = contents_of(directory / "out");
  {
    RunDirectory run(directory / "out", {.title = "new", .model_text = "other\n", .flush = {}});
    EXPECT_EQ(summary_of(run.path())["status"], "starting");
    EXPECT_EQ(files::read_text_file(run.path() / kModelName), "other\n");
    EXPECT_FALSE(std::filesystem::exists(run.path() / kResultsName));
    run.log("what is said now");
    run.finish({});
    EXPECT_TRUE(run.has_earlier_run_back());
  }
  EXPECT_EQ(contents_of(directory / "out"), before);
  { const RunDirectory run(directory / "out"); }  // without finish()
  EXPECT_EQ(contents_of(directory / "out"), before);
  {
    RunDirectory run(directory / "out");
    run.begin(sample_layout(), sample_geometry());
    run.finish({});
    EXPECT_FALSE(run.has_earlier_run_back());
  }
  EXPECT_EQ(RunReader(directory / "out").num_records(), 0U);
  EXPECT_FALSE(std::filesystem::exists(directory / "out" / ".earlier"));
}

TEST(RunDirectory, BringsAnEarlierRunBackAfterAKill) {
  const TemporaryDirectory directory;
  write_run(directory / "out", 50);
  const auto before = contents_of(directory / "out");
  RunDirectory run(directory / "out");
  // The files are now as SIGKILL would leave them.
  std::filesystem::copy(directory / "out", directory / "left",
                        std::filesystem::copy_options::recursive);
  RunDirectory(directory / "left").finish({});
  EXPECT_EQ(contents_of(directory / "left"), before);
}

TEST(RunDirectory, KeepsNoEarlierRunIfThatIsNotWanted) {
  const TemporaryDirectory directory;
  write_run(directory / "out", 50);
  RunDirectory(directory / "out",
               {.title = "", .model_text = "", .flush = {}, .keeps_earlier_run = false})
      .finish({});
  EXPECT_EQ(summary_of(directory / "out")["status"], "interrupted");
  EXPECT_FALSE(std::filesystem::exists(directory / "out" / kResultsName));
}

TEST(RunDirectory, RefusesADirectoryOfOthers) {
  const TemporaryDirectory directory;
  std::ofstream(directory / "model.yaml") << "somebody's model";
  EXPECT_THAT([&] { RunDirectory{directory.path()}; },
              ThrowsMessage<IoError>(AllOf(HasSubstr(directory.path().string()),
                                           HasSubstr("not empty"), HasSubstr("-o"))));
  EXPECT_EQ(files::read_text_file(directory / "model.yaml"), "somebody's model");

  std::ofstream(directory / "summary.json") << R"({"status": "of something else"})";
  EXPECT_THROW(RunDirectory{directory.path()}, IoError);
}

TEST(RunDirectory, RefusesAFileAndAPlaceThatCannotBeWritten) {
  const TemporaryDirectory directory;
  std::ofstream(directory / "file") << "x";
  EXPECT_THAT([&] { RunDirectory{directory / "file"}; },
              ThrowsMessage<IoError>(HasSubstr("is a file")));
  EXPECT_THAT([&] { RunDirectory{directory / "file" / "below"}; },
              ThrowsMessage<IoError>(HasSubstr("cannot create the directory")));
  EXPECT_THAT([&] { RunDirectory{"/proc/buckens"}; },  // not even root can write there
              ThrowsMessage<IoError>(HasSubstr("cannot create the directory")));
}

TEST(RunDirectory, RefusesADirectoryThatAnotherRunWritesInto) {
  const TemporaryDirectory directory;
  RunDirectory first(directory / "out");
  EXPECT_THAT([&] { RunDirectory{directory / "out"}; },
              ThrowsMessage<IoError>(HasSubstr("another run is writing")));
  first.finish({});
  EXPECT_NO_THROW(RunDirectory{directory / "out"});
}

TEST(RunDirectory, RefusesRecordsOfTheWrongLength) {
  const TemporaryDirectory directory;
  RunDirectory run(directory / "out");
  EXPECT_THROW(run.write({0.0, {}}), IoError);
  run.begin(sample_layout(), sample_geometry());
  EXPECT_THAT(
      [&] {
        run.write({0.25, {1.0}});
      },
      ThrowsMessage<IoError>(AllOf(HasSubstr("t = 0.25 s"), HasSubstr("1 values"))));
}

/// Many limits, so that each part of the files is the one that does not fit at least once.
TEST(RunDirectory, FullDiskKeepsWhatWasWritten) {
  const results::RecordLayout layout = sample_layout();
  int stopped = 0;
  for (rlim_t limit = 25000; limit < 150000; limit += 1237) {
    const TemporaryDirectory directory;
    std::string message;
    {
      RunDirectory run(directory / "out", {.title = "", .model_text = "", .flush = {}});
      run.begin(layout, sample_geometry());
      const FileSizeLimit full_disk(limit);
      try {
        for (std::size_t i = 0; i < 400; ++i) run.write(sample_record(i, layout.num_values()));
        run.finish(finished_summary());
      } catch (const IoError& error) {
        message = error.what();
        EXPECT_NO_THROW(run.finish(finished_summary())) << "has been said already";
      }
    }
    const RunReader reader(directory / "out");
    const std::size_t records = reader.num_records();
    if (message.empty()) {
      EXPECT_EQ(records, 400U);
      continue;
    }
    ++stopped;
    EXPECT_THAT(message, AllOf(HasSubstr(directory.path().string()), HasSubstr("File too large"),
                               HasSubstr("-o")));
    EXPECT_EQ(reader.status(), RunStatus::interrupted);
    EXPECT_EQ(summary_of(directory / "out")["finished"], false);
    EXPECT_EQ(records % 100, 0U) << "flushes of 100 records";
    const std::vector<double> angle = reader.read("sensors/angle");
    const std::size_t position =
        layout.offset(static_cast<std::size_t>(layout.find("sensors/angle")));
    for (std::size_t i = 0; i < records; ++i) ASSERT_EQ(angle[i], sample_value(i, position));
  }
  EXPECT_GT(stopped, 20);
}

TEST(RunDirectory, FullDiskAtTheStartIsSaidAtOnce) {
  const TemporaryDirectory directory;
  {
    const FileSizeLimit full_disk(20);
    EXPECT_THAT([&] { RunDirectory{directory / "out"}; },
                ThrowsMessage<IoError>(AllOf(HasSubstr("summary.json"), HasSubstr("Free space"))));
  }
  EXPECT_NO_THROW(RunDirectory{directory / "out"}) << "the traces of that attempt do no harm";
  for (rlim_t limit = 400; limit < 16000; limit += 977) {
    RunDirectory run(directory / "other");
    const FileSizeLimit full_disk(limit);
    EXPECT_THROW(run.begin(sample_layout(), sample_geometry()), IoError) << limit;
  }
}

/// Exit code of a line of Python with `f` an open results.h5 and `options` those of h5py.File.
int exit_code_of_h5py(const std::filesystem::path& run, const std::string& options,
                      const std::string& code) {
  const std::string command = "/usr/bin/python3 -c \"import h5py, sys; f = h5py.File('" +
                              (run / kResultsName).string() + "', 'r'" + options + "); sys.exit(" +
                              code + ")\"";
  return WEXITSTATUS(std::system(command.c_str()));
}

TEST(RunDirectory, FinishedResultsOpenLikeAnyHdf5File) {
  const TemporaryDirectory directory;
  write_run(directory / "out", 5);
  EXPECT_EQ(exit_code_of_h5py(directory / "out", "",
                              "0 if f['time'].attrs['unit'] == 's' and "
                              "list(f['sensors/tip'].attrs['components']) == ['x', 'y', 'z'] and "
                              "f['bodies/rod/displacement'].shape == (5, 3, 6) else 1"),
            0);
}

/// The age rule, seen from another process: a few records, then silence.
TEST(RunDirectory, RecordsReachTheFileWithoutFurtherCalls) {
  const TemporaryDirectory directory;
  RunDirectory run(directory / "out");
  const results::RecordLayout layout = sample_layout();
  run.begin(layout, sample_geometry());
  for (std::size_t i = 0; i < 7; ++i) run.write(sample_record(i, layout.num_values()));
  std::this_thread::sleep_for(std::chrono::milliseconds(900));  // the promise is one second
  EXPECT_EQ(
      exit_code_of_h5py(directory / "out", ", swmr=True", "len(f['time']) + len(f['sensors/tip'])"),
      14);
}

}  // namespace
}  // namespace buckens::run_store
