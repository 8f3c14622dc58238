// SPDX-License-Identifier: Apache-2.0
// A program around the library may have chosen a locale whose numbers have a decimal comma.
#include <clocale>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <locale>
#include <map>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/expression.h"
#include "buckens/base/test/source_directory.h"
#include "buckens/base/test/temporary_directory.h"
#include "buckens/base/units.h"
#include "buckens/exports/csv.h"
#include "buckens/exports/vtk.h"
#include "buckens/mesh_io/mesh_file.h"
#include "buckens/model_file/model_file.h"
#include "buckens/model_file/test/sample.h"
#include "buckens/run_store/run_reader.h"
#include "buckens/run_store/test/sample_fields.h"

namespace buckens::exports {
namespace {

using buckens::test::TemporaryDirectory;

/// Decimal comma and thousands in groups, for streams of C++.
class CommaNumbers : public std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

/// While it lives, C and C++ write numbers that way.
class CommaLocale {
 public:
  CommaLocale() : before_(std::locale()) {
    std::ofstream(place_ / "source") << "comment_char %\nescape_char /\nLC_NUMERIC\n"
                                        "decimal_point \",\"\nthousands_sep \".\"\n"
                                        "grouping 3;3\nEND LC_NUMERIC\n";
    // It fails, because the locale contains only numbers, but writes it nevertheless.
    const std::string command = "localedef -c --quiet -f ANSI_X3.4-1968 -i '" +
                                (place_ / "source").string() + "' '" + (place_ / "xx_XX").string() +
                                "' 2>/dev/null";
    static_cast<void>(std::system(command.c_str()));
    ::setenv("LOCPATH", place_.path().c_str(), 1);
    is_chosen_ = std::setlocale(LC_NUMERIC, "xx_XX") != nullptr;
    std::locale::global(std::locale(before_, new CommaNumbers));
    if (is_chosen_) std::setlocale(LC_NUMERIC, "xx_XX");  // the line above may have changed it
  }
  ~CommaLocale() {
    std::locale::global(before_);
    std::setlocale(LC_ALL, "C");
    ::unsetenv("LOCPATH");
  }
  CommaLocale(const CommaLocale&) = delete;
  CommaLocale& operator=(const CommaLocale&) = delete;

  bool is_chosen() const { return is_chosen_ && std::strtod("1,5", nullptr) == 1.5; }

 private:
  TemporaryDirectory place_;
  std::locale before_;
  bool is_chosen_ = false;
};

/// Contents of a run directory and its exports, by name, except times of day.
std::map<std::string, std::string> texts_of_a_run(const std::filesystem::path& place) {
  run_store::test::write_fields_run(place / "run", 1234);
  const run_store::RunReader run(place / "run");
  export_csv(run, {}, place / "csv");
  run_store::InstantChoice last;
  last.count = 1;
  export_vtk(run, last, place / "vtk", "x");
  std::map<std::string, std::string> out;
  for (const char* folder : {"run", "csv", "vtk"}) {
    for (const auto& entry : std::filesystem::directory_iterator(place / folder)) {
      const std::string name = entry.path().filename().string();
      if (name != run_store::kResultsName && name != run_store::kSummaryName)
        out[name] = files::read_text_file(entry.path());
    }
  }
  return out;
}

TEST(DecimalComma, DoesNotChangeWhatIsRead) {
  const std::filesystem::path mesh =
      std::filesystem::path(buckens::test::kSourceDirectory) / "tests/parts/crank_web_41.msh";
  const fem::ImportedMesh plain_mesh = mesh_io::read_mesh_file(mesh);
  const model::ModelDescription plain =
      model_file::read_model_text(model_file::kSampleModel, "sample.yaml");
  const CommaLocale comma;
  ASSERT_TRUE(comma.is_chosen());
  EXPECT_EQ(base::parse_number("1.25e-3"), 1.25e-3);
  EXPECT_EQ(base::parse_number("1,25"), std::nullopt);
  const model::ModelDescription model =
      model_file::read_model_text(model_file::kSampleModel, "sample.yaml");
  EXPECT_EQ(model.gravity, plain.gravity);
  EXPECT_EQ(model.simulation->step, plain.simulation->step);
  EXPECT_EQ(model.bodies[1].damping->mass, plain.bodies[1].damping->mass);
  for (std::size_t k = 0; k < plain.parameters.size(); ++k) {
    EXPECT_EQ(model.parameters[k].value, plain.parameters[k].value);
  }
  EXPECT_EQ(mesh_io::read_mesh_file(mesh).positions, plain_mesh.positions);
}

TEST(DecimalComma, DoesNotChangeWhatIsWritten) {
  const TemporaryDirectory place;
  const auto plain = texts_of_a_run(place / "plain");
  const CommaLocale comma;
  ASSERT_TRUE(comma.is_chosen());
  const auto texts = texts_of_a_run(place / "comma");
  ASSERT_GE(plain.size(), 6U);
  for (const auto& [name, text] : plain) EXPECT_EQ(texts.at(name), text) << name;
}

TEST(DecimalComma, DoesNotChangeExpressions) {
  const auto value = [] {
    const base::Expression law("1.25*sin(0.5*t) + 2.5e-1*a", {"t"}, {{"a", 1.5}}, {});
    return law({3.0});
  };
  const double plain = value();
  const CommaLocale comma;
  ASSERT_TRUE(comma.is_chosen());
  EXPECT_EQ(value(), plain);
  EXPECT_NEAR(plain, 1.25 * std::sin(1.5) + 0.375, 1e-15);  // rounding of numbers of size 1
}

}  // namespace
}  // namespace buckens::exports
