// SPDX-License-Identifier: Apache-2.0
#include "buckens/page/view_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "buckens/base/errors.h"
#include "buckens/base/test/temporary_directory.h"
#include "buckens/files/output_file.h"
#include "buckens/page/origin.h"
#include "buckens/page/test/page_values.h"
#include "buckens/run_store/run_directory.h"
#include "buckens/run_store/test/sample_run.h"

namespace buckens::page {
namespace {

using buckens::test::TemporaryDirectory;
using run_store::test::finished_summary;
using run_store::test::sample_geometry;
using run_store::test::sample_layout;
using run_store::test::sample_record;
using run_store::test::sample_value;
using test::decode;
using test::decode_ints;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

constexpr char kHead[] = "<html><script>window.BUCKENS_DATA = ";
constexpr char kTail[] = ";</script></html>";

class ViewPage : public testing::Test {
 protected:
  void write_run(std::size_t records, const std::string& title = "sample") {
    run_store::RunDirectory run(directory_ / "out",
                                {.title = title, .model_text = "", .flush = {}});
    const results::RecordLayout layout = sample_layout();
    run.begin(layout, sample_geometry());
    for (std::size_t i = 0; i < records; ++i) run.write(sample_record(i, layout.num_values()));
    run.finish(finished_summary(77));
  }

  ViewPageReport write_page(const ViewPageOptions& options = {}) {
    files::replace_text_file(directory_ / "template.html",
                             std::string(kHead) + "/*BUCKENS_DATA*/null" + kTail);
    const std::vector<ViewPageReport> reports = write_view_page(
        {directory_ / "out"}, directory_ / "template.html", directory_ / "page.html", options);
    page_ = files::read_text_file(directory_ / "page.html");
    return reports.at(0);
  }

  nlohmann::json page() const {
    const std::size_t head = std::string(kHead).size();
    return nlohmann::json::parse(
        page_.substr(head, page_.size() - head - std::string(kTail).size()));
  }

  nlohmann::json data() const { return page()["runs"][0]; }

  TemporaryDirectory directory_;
  std::string page_;
};

TEST_F(ViewPage, HoldsTheRun) {
  write_run(3);
  const ViewPageReport report = write_page();
  EXPECT_EQ(report.records, 3U);
  EXPECT_EQ(report.frames, 3U);
  EXPECT_EQ(page()["format"], 2);
  const nlohmann::json page = data();
  EXPECT_EQ(page["title"], "sample");
  EXPECT_EQ(page["time"]["n"], 3);
  EXPECT_EQ(decode(page["time"]["f32"]), (std::vector<float>{0.0F, 0.001F, 0.002F}));
  EXPECT_EQ(page["planar"], "xy");
  EXPECT_EQ(page["gravity"], nlohmann::json({0.0, -9.81, 0.0}));
  EXPECT_EQ(page["summary"]["steps"], 77);

  const nlohmann::json& rod = page["bodies"][1];
  EXPECT_EQ(rod["name"], "rod");
  EXPECT_EQ(rod["kind"], "beam");
  EXPECT_EQ(decode(rod["nodes"]), (std::vector<float>{-0.5F, 0, 0, 0, 0, 0, 0.5F, 0, 0}));
  EXPECT_EQ(rod["nodeNumbers"], nullptr);
  ASSERT_EQ(rod["sections"].size(), 3U);
  EXPECT_EQ(decode(rod["sections"][0][1]),
            (std::vector<float>{0.005F, 0, 0, -0.005F, -0.005F, 0, 0, 0.005F}));
  EXPECT_TRUE(rod["sections"][1].empty());
  EXPECT_EQ(decode_ints(rod["elementSections"]), (std::vector<int>{0, 0, 2, 1}));
  EXPECT_EQ(decode(rod["elementAxes"]), (std::vector<float>{0, 1, 0, 0, 0, 1}));
  EXPECT_EQ(page["directory"], "out");
  EXPECT_EQ(rod["elements"], nlohmann::json({{0, 1}, {1, 2}}));
  EXPECT_EQ(rod["markers"][1]["node"], 2);
  const std::vector<float> pose = decode(rod["pose"]);
  ASSERT_EQ(pose.size(), 21U);
  EXPECT_EQ(pose[7 + 2], static_cast<float>(sample_value(1, 2)));
  EXPECT_EQ(rod["displacement"]["type"], "f32");
  EXPECT_EQ(decode(rod["displacement"]["values"]).size(), 3U * 3U * 6U);
  const nlohmann::json& slider = page["bodies"][0];
  EXPECT_EQ(slider["kind"], "rigid");
  EXPECT_EQ(slider["displacement"], nullptr);
  EXPECT_EQ(slider["fields"], nlohmann::json::array());
  EXPECT_EQ(slider["markers"][0]["orientation"], nlohmann::json({0.6, 0.0, 0.0, 0.8}));

  EXPECT_EQ(page["joints"][0]["between"][1]["body"], 1);
  EXPECT_EQ(page["joints"][1]["between"][0]["body"], -1);
  ASSERT_EQ(page["sensors"].size(), 2U);  // as the model file has them
  EXPECT_EQ(page["sensors"][0]["name"], "tip");
  EXPECT_EQ(page["sensors"][0]["components"], nlohmann::json({"x", "y", "z"}));
  EXPECT_EQ(decode(page["sensors"][0]["values"]).size(), 9U);
  EXPECT_EQ(page["sensors"][1]["components"], nlohmann::json({""}));
  EXPECT_EQ(page["energies"][0]["name"], "kinetic");
  EXPECT_EQ(page["energies"][0]["unit"], "J");
  EXPECT_EQ(page["storage"]["records"], 3);
  EXPECT_EQ(page["storage"]["rounded"], false);
}

TEST_F(ViewPage, StressIsTheLargestMagnitudeOfAnElement) {
  write_run(2);
  write_page();
  const nlohmann::json field = data()["bodies"][1]["fields"].at(0);
  EXPECT_EQ(field["name"], "stress");
  EXPECT_EQ(field["on"], "lines");
  EXPECT_EQ(field["unit"], "Pa");
  const std::vector<float> stress = decode(field["values"]["values"]);
  ASSERT_EQ(stress.size(), 4U);
  const results::RecordLayout layout = sample_layout();
  const std::size_t offset = layout.offset(2);
  const auto largest = [&](std::size_t record, std::size_t element) {
    const double a = sample_value(record, offset + 2 * element);
    const double b = sample_value(record, offset + 2 * element + 1);
    return static_cast<float>(std::max(std::abs(a), std::abs(b)));
  };
  EXPECT_EQ(stress[0], largest(0, 0));
  EXPECT_EQ(stress[3], largest(1, 1));
}

TEST_F(ViewPage, ThinsLongRunsEvenly) {
  write_run(1001);
  EXPECT_EQ(write_page({.max_frames = 11}).frames, 11U);
  const std::vector<float> times = decode(data()["time"]["f32"]);
  ASSERT_EQ(times.size(), 11U);
  for (std::size_t i = 0; i < 11; ++i) {
    EXPECT_FLOAT_EQ(times[i], 0.1F * static_cast<float>(i));
  }
  const ViewPageReport small = write_page({.max_bytes = 20000});
  EXPECT_GT(small.frames, 10U);
  EXPECT_LT(small.frames, 400U);
  EXPECT_TRUE(small.rounded);
  EXPECT_EQ(data()["storage"]["rounded"], true);
  EXPECT_THAT(data()["storage"]["notes"].dump(), HasSubstr("Frames were left out"));
  EXPECT_LT(page_.size(), 20000 * 4 / 3 + 5000) << "base64 takes 4/3, the rest is geometry";
}

TEST_F(ViewPage, ShowsTheFieldsThatAreWanted) {
  write_run(2);
  write_page({.fields = {"von_mises"}});
  EXPECT_EQ(data()["bodies"][1]["fields"].size(), 0U);
  write_page({.fields = {"von_mises", "stress"}});
  EXPECT_EQ(data()["bodies"][1]["fields"].size(), 1U);
}

TEST_F(ViewPage, ShowsTwoRunsSideBySide) {
  write_run(3);
  files::replace_text_file(directory_ / "template.html",
                           std::string(kHead) + "/*BUCKENS_DATA*/null" + kTail);
  const std::vector<ViewPageReport> reports =
      write_view_page({directory_ / "out", directory_ / "out"}, directory_ / "template.html",
                      directory_ / "page.html", {.max_frames = 2});
  page_ = files::read_text_file(directory_ / "page.html");
  ASSERT_EQ(reports.size(), 2U);
  EXPECT_EQ(reports[1].frames, 2U);
  EXPECT_EQ(page()["runs"].size(), 2U);
  EXPECT_EQ(page()["runs"][0]["bodies"], page()["runs"][1]["bodies"]);
}

TEST_F(ViewPage, TextOfTheModelCannotBreakThePage) {
  const std::string title = "</script><script>alert('&')</script> \u2028 \"quoted\" <!--";
  write_run(1, title);
  write_page();
  EXPECT_EQ(data()["title"], title);
  const std::string inside =
      page_.substr(std::string(kHead).size(),
                   page_.size() - std::string(kHead).size() - std::string(kTail).size());
  EXPECT_THAT(inside, Not(HasSubstr("<")));
  EXPECT_THAT(inside, Not(HasSubstr(">")));
  EXPECT_THAT(inside, Not(HasSubstr("\u2028")));
}

TEST_F(ViewPage, RefusesWhatItCannotShow) {
  EXPECT_THAT([&] { write_page(); }, ThrowsMessage<IoError>(HasSubstr("not a run directory")));
  write_run(0);
  EXPECT_THAT([&] { write_page(); }, ThrowsMessage<IoError>(HasSubstr("no records yet")));
  write_run(1);
  files::replace_text_file(directory_ / "bad.html", "<html></html>");
  EXPECT_THAT(
      [&] {
        write_view_page({directory_ / "out"}, directory_ / "bad.html", directory_ / "page.html");
      },
      ThrowsMessage<IoError>(HasSubstr("exactly once")));
}

TEST(DirectoryNames, AreAsLongAsItTakes) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(directory_names({"runs/coarse", "runs/fine/"}), (Names{"coarse", "fine"}));
  EXPECT_EQ(directory_names({"/a/out", "/b/out"}), (Names{"a/out", "b/out"}));
  EXPECT_EQ(directory_names({"/a/b/out/."}), (Names{"out"}));
  EXPECT_EQ(directory_names({"/a/out", "/a/out"}).size(), 2U);
}

}  // namespace
}  // namespace buckens::page
