// SPDX-License-Identifier: Apache-2.0
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "buckens/base/errors.h"
#include "buckens/base/test/temporary_directory.h"
#include "buckens/files/base64.h"
#include "buckens/files/output_file.h"
#include "buckens/run_store/sensors_csv.h"
#include "buckens/run_store/summary_json.h"
#include "buckens/run_store/test/sample_run.h"

namespace buckens::run_store {
namespace {

using buckens::test::TemporaryDirectory;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(SensorsCsv, NamesColumnsWithUnits) {
  const TemporaryDirectory directory;
  const results::RecordLayout layout = test::sample_layout();
  SensorsCsv csv(directory / "sensors.csv", layout);
  EXPECT_EQ(files::read_text_file(directory / "sensors.csv"),
            "t [s],tip.x [m],tip.y [m],tip.z [m],angle [rad]\n");
}

TEST(SensorsCsv, QuotesNamesAndNumbersComponents) {
  results::RecordLayout layout;
  layout.add({"sensors/a, \"b\"", "", {2}, "", {}});
  EXPECT_EQ(csv_column_names(layout.channel(0)),
            (std::vector<std::string>{"a, \"b\".1 [1]", "a, \"b\".2 [1]"}));
  const TemporaryDirectory directory;
  SensorsCsv csv(directory / "sensors.csv", layout);
  EXPECT_THAT(files::read_text_file(directory / "sensors.csv"),
              HasSubstr(",\"a, \"\"b\"\".1 [1]\","));
}

TEST(SensorsCsv, LinesAreThereAtOnceAndNumbersReadBackExactly) {
  const TemporaryDirectory directory;
  results::RecordLayout layout;
  layout.add({"energies/kinetic", "J", {}, "", {}});  // not a sensor
  layout.add({"sensors/s", "m", {}, "", {}});
  SensorsCsv csv(directory / "sensors.csv", layout);
  const double value = -1e-7 * std::numbers::pi;
  csv.write({1.0 / 3.0, {42.0, value}});
  std::istringstream text(files::read_text_file(directory / "sensors.csv"));
  std::string line;
  std::getline(text, line);
  std::getline(text, line);
  ASSERT_FALSE(text.eof()) << "the line is complete";
  const std::size_t comma = line.find(',');
  EXPECT_EQ(std::stod(line.substr(0, comma)), 1.0 / 3.0);
  EXPECT_EQ(std::stod(line.substr(comma + 1)), value);
}

TEST(SensorsCsv, FullDeviceIsAnIoError) {
  results::RecordLayout layout;
  layout.add({"sensors/s", "m", {}, "", {}});
  EXPECT_THAT([&] { SensorsCsv("/dev/full", layout); },
              ThrowsMessage<IoError>(AllOf(HasSubstr("/dev/full"), HasSubstr("No space left"),
                                           HasSubstr("output: every"))));
}

TEST(OutputFile, SaysWhyItCannotBeOpened) {
  EXPECT_THAT([] { files::OutputFile{"/nowhere/at/all"}; },
              ThrowsMessage<IoError>(HasSubstr("No such file or directory")));
  EXPECT_THAT([] { files::read_text_file("/nowhere/at/all"); },
              ThrowsMessage<IoError>(HasSubstr("cannot read")));
  EXPECT_THAT([] { files::read_text_file("/"); },
              ThrowsMessage<IoError>(HasSubstr("is a directory")));
}

TEST(OutputFile, BeganAnewNoOtherFileIsTouched) {
  const TemporaryDirectory directory;
  const auto anew = files::OutputFile::Start::anew;
  const auto other = directory / "other";
  files::OutputFile(other).write("other");
  std::filesystem::create_symlink(other, directory / "link");
  std::filesystem::create_hard_link(other, directory / "twin");
  for (const char* name : {"link", "twin", "new"}) {
    files::OutputFile(directory / name, anew).write("text");
    EXPECT_EQ(files::read_text_file(directory / name), "text") << name;
    EXPECT_TRUE(
        std::filesystem::is_regular_file(std::filesystem::symlink_status(directory / name)));
  }
  EXPECT_EQ(files::read_text_file(other), "other");
  std::filesystem::create_symlink(other, directory / "log");
  EXPECT_THAT([&] { files::OutputFile(directory / "log", files::OutputFile::Start::as_it_is); },
              ThrowsMessage<IoError>(HasSubstr("symbolic link")));
  std::filesystem::create_directory(directory / "folder");
  EXPECT_THROW(files::OutputFile(directory / "folder", anew), IoError);
  EXPECT_TRUE(std::filesystem::is_directory(directory / "folder"));
  files::OutputFile("/dev/null", anew).write("text");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(OutputFile, ReplacesAFileAsAWhole) {
  const TemporaryDirectory directory;
  files::replace_text_file(directory / "a", "old");
  files::replace_text_file(directory / "a", "new");
  EXPECT_EQ(files::read_text_file(directory / "a"), "new");
  EXPECT_FALSE(std::filesystem::exists(directory / "a.part"));
}

TEST(SummaryJson, HoldsTheFiguresOfARun) {
  results::RunSummary summary;
  summary.title = "crank";
  summary.finished = true;
  summary.steps = 1000;
  summary.wall_seconds = {2.0, 0.5, 1.5, {{"solve", 1.0}}, {{"factor", 0.25}}};
  summary.bodies.push_back({"rod", 96, 1, 1001, 975, "first-order", {{"mode_ratio", 0.02}}});
  summary.setup_solves = 12;
  summary.newton_iterations = {2500, 2.5, 4};
  summary.residuals = {1e-15, 2e-14, 3e-16};
  summary.energy_error = std::numeric_limits<double>::quiet_NaN();
  const auto json =
      nlohmann::json::parse(summary_json(summary, files::utc_now(), files::utc_now()));
  EXPECT_EQ(json["status"], "finished");
  EXPECT_EQ(json["interrupted"], nullptr);
  EXPECT_EQ(json["steps"], 1000);
  EXPECT_EQ(json["wall_seconds"]["stepping"], 1.5);
  EXPECT_EQ(json["wall_seconds"]["phases"]["solve"], 1.0);
  EXPECT_EQ(json["wall_seconds"]["preparation"]["factor"], 0.25);
  EXPECT_EQ(json["bodies"]["rod"]["dof"], 96);
  EXPECT_EQ(json["bodies"]["rod"]["factorisations"], 1);
  EXPECT_EQ(json["bodies"]["rod"]["solves"], 1001);
  EXPECT_EQ(json["bodies"]["rod"]["recycled"], 975);
  EXPECT_EQ(json["bodies"]["rod"]["mode_ratio"], 0.02);
  EXPECT_EQ(json["setup_solves"], 12);
  EXPECT_EQ(json["newton_iterations"]["per_step_mean"], 2.5);
  EXPECT_EQ(json["residuals"]["sieve"], 3e-16);
  EXPECT_EQ(json["energy_error"], nullptr);
  EXPECT_EQ(json["trust"], "ok");
}

TEST(SummaryJson, GivesReasonsForDistrustAndInterruption) {
  results::RunSummary summary;
  summary.title = "broken \xff text";
  summary.interrupted = "Ctrl-C at t = 0.1 s";
  summary.trust = {"|w| is large"};
  const std::string text = summary_json(summary, "", "");
  const auto json = nlohmann::json::parse(text);
  EXPECT_EQ(json["status"], "interrupted");
  EXPECT_EQ(json["interrupted"], "Ctrl-C at t = 0.1 s");
  EXPECT_EQ(json["trust"][0], "|w| is large");
  EXPECT_TRUE(is_summary_json(text));
  EXPECT_EQ(status_in(text, "x"), RunStatus::interrupted);
}

TEST(SummaryJson, KnowsItsOwn) {
  EXPECT_TRUE(is_summary_json(status_json(RunStatus::starting, "", "", "")));
  for (const char* text : {"", "{", "[]", "1", "{}", R"({"status": "finished"})",
                           R"({"program": "other", "status": "finished"})"}) {
    EXPECT_FALSE(is_summary_json(text)) << text;
  }
  EXPECT_THROW(status_in("{}", "x"), IoError);
}

TEST(Base64, EncodesLittleEndianFloats) {
  // 1.0f is 00 00 80 3f, −2.0f is 00 00 00 c0 in memory order.
  EXPECT_EQ(files::base64_float32(std::vector<double>{1.0}), "AACAPw==");
  EXPECT_EQ(files::base64_float32(std::vector<double>{1.0, -2.0}), "AACAPwAAAMA=");
  EXPECT_EQ(files::base64_float32(std::vector<double>{1.0, -2.0, 0.0}), "AACAPwAAAMAAAAAA");
  EXPECT_EQ(files::base64_float32({}), "");
}

}  // namespace
}  // namespace buckens::run_store
