// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/step/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <sstream>

#include <fmt/format.h>

namespace buckens::mesh_io {

namespace {

constexpr const char kOwn[] = "buckens: ";
constexpr double kMany = 5e4;  // elements; they take about five seconds
constexpr double kWrong = 2;   // from here on an estimate is corrected

/// Two digits, for an estimate says no more.
std::string rounded(double count) {
  if (!(count >= 1)) return "1";
  const double unit = std::pow(10, std::max(0.0, std::floor(std::log10(count)) - 1));
  return fmt::format("{:.0f}", unit * std::round(count / unit));
}

}  // namespace

void say_stage(const char* stage) {
  files::say_to_listener(fmt::format("{}stage {}", kOwn, stage));
}

void say_trial(int number) { files::say_to_listener(fmt::format("{}trial {}", kOwn, number)); }

void say_gluing(std::size_t num_solids) {
  files::say_to_listener(fmt::format("{}gluing {}", kOwn, num_solids));
}

void say_outlook(const MeshOutlook& outlook, std::size_t num_faces) {
  files::say_to_listener(
      fmt::format("{}outlook {} {} {}", kOwn, num_faces, outlook.elements, outlook.nodes));
}

MeshingProgress::MeshingProgress(const std::string& file) {
  work_.name = "meshing " + std::filesystem::path(file).filename().string();
  stage("reading");
}

MeshingProgress::~MeshingProgress() {
  work_.stage.clear();
  base::report_work(work_);
}

void MeshingProgress::stage(const std::string& name) {
  work_.stage = way_ + name;
  work_.done = work_.of = 0;
  base::report_work(work_);
}

void MeshingProgress::trial(int number) {
  being_glued_ = 0;
  way_ = number > 1 ? fmt::format("way {}: ", number) : "";
  stage("reading");
}

files::IsolatedListener MeshingProgress::listener() {
  return [this](const std::string& line) { hear(line); };
}

void MeshingProgress::set_outlook(double elements, double nodes) {
  elements_ = elements;
  work_.is_long = elements > kMany;
  work_.outlook = fmt::format("about {} elements with {} variables are expected", rounded(elements),
                              rounded(3 * nodes));
}

void MeshingProgress::hear(const std::string& line) {
  if (!line.starts_with(kOwn)) return line.empty() ? base::report_work(work_) : hear_gmsh(line);
  std::istringstream words(line.substr(sizeof(kOwn) - 1));
  std::string word;
  words >> word;
  if (word == "stage") {
    std::getline(words >> std::ws, word);
    return stage(word);
  }
  if (int number = 0; word == "trial" && words >> number) return trial(number);
  if (word == "gluing" && words >> being_glued_) {
    return stage(fmt::format("gluing {} solids", being_glued_));
  }
  double elements = 0, nodes = 0;
  if (word == "outlook" && words >> num_faces_ >> elements >> nodes) {
    being_glued_ = 0;
    // Another way to mesh is no news to whoever waits, as long as it is about as much.
    if (elements > kWrong * elements_) set_outlook(elements, nodes);
    stage("edges");
  }
}

void MeshingProgress::hear_gmsh(const std::string& line) {
  const auto says = [&line](const char* words) { return line.find(words) != std::string::npos; };
  long nodes = 0;
  if (says("Meshing surface") && !says(" order ")) {
    work_.stage = way_ + "faces";
    work_.of = num_faces_;
    work_.done = std::min(work_.done + 1, work_.of);
    base::report_work(work_);
  } else if (std::sscanf(line.c_str(), "Info    : Tetrahedrizing %ld nodes", &nodes) == 1) {
    const double triangles = 2 * static_cast<double>(nodes);  // of a closed surface, by Euler
    const MeshOutlook likely = expected_on_surface(triangles);
    if (likely.elements > kWrong * elements_) set_outlook(likely.elements, likely.nodes);
    stage("volume");
  } else if (std::sscanf(line.c_str(), "Info    : It. %*d - %ld nodes", &nodes) == 1) {
    stage(fmt::format("volume, {} nodes inside", nodes));
  } else if (says("Optimizing mesh (HighOrder)")) {
    stage("second order, better elements");
  } else if (says("Optimizing mesh")) {
    stage("better elements");
  }
}

}  // namespace buckens::mesh_io
