// SPDX-License-Identifier: Apache-2.0
// Variants of one model with a solid body that advance concurrently and share a factor, against one
// of them alone.
//
//     variant_bench hex8:124,8,8 [--steps N] [--together 6,32] [--coupling none,full]
//
// Prints one JSON object; processor times per step of all variants [s], medians of rounds in which
// one, six … are measured in turn.

#include <algorithm>
#include <cstring>
#include <ctime>
#include <functional>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "models.h"
#include "solid_block.h"

#include "buckens/linalg/blas_kernels.h"
#include "buckens/linalg/solve_exchange.h"

namespace {

using buckens::bench::SolidBlock;
using nlohmann::json;

constexpr double kStep = 1e-4;
constexpr int kRounds = 7;

/// A block on a ball joint; the variants differ in gravity.
std::string block_pendulum(const SolidBlock& block, const std::string& level, double gravity) {
  return fmt::format(R"(buckens: 1
gravity: [0, {}, 0]
bodies:
  block:
    mesh:
      box: {{size: [{}, 0.1, 0.1], divisions: [{}, {}, {}], element: {}}}
      material: {{E: 210 GPa, nu: 0.3, rho: 7850}}
    coupling: {}
joints:
  pin: {{spherical: {{between: [ground, block/corner_000]}}}}
)",
                     gravity, block.size().x(), block.divisions[0], block.divisions[1],
                     block.divisions[2], block.element(), level);
}

/// Of all threads of this process [s].
double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Variants that share one factor, or one without an exchange.
class Variants {
 public:
  Variants(const SolidBlock& block, const std::string& level, int count) {
    if (count > 1) exchange_ = std::make_unique<buckens::linalg::SolveExchange>();
    for (int k = 0; k < count; ++k) {
      const std::string text = block_pendulum(block, level, -9.81 + 0.1 * k);
      runs_.push_back(buckens::bench::start(text, kStep, 1, exchange_.get()));
    }
  }

  void advance(int steps) {
    std::vector<std::function<void()>> participants;
    for (auto& run : runs_) {
      participants.emplace_back([&run, steps] {
        for (int k = 0; k < steps; ++k) run.stepper->step(run.prepared.state);
      });
    }
    const double start = processor_time();
    if (exchange_) {
      exchange_->run(participants);
    } else {
      participants.front()();
    }
    times_.push_back((processor_time() - start) / steps);
  }

  /// Without the first round, which builds up the history of the coupling.
  double median_time() {
    std::sort(times_.begin() + 1, times_.end());
    return times_[1 + (times_.size() - 1) / 2];
  }

 private:
  std::unique_ptr<buckens::linalg::SolveExchange> exchange_;
  std::vector<buckens::bench::Running> runs_;
  std::vector<double> times_;
};

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string item; std::getline(in, item, ',');) out.push_back(item);
  return out;
}

json measure(const SolidBlock& block, const std::string& level, const std::vector<int>& counts,
             int steps) {
  std::vector<Variants> all;
  for (const int count : counts) all.emplace_back(block, level, count);
  for (int round = 0; round <= kRounds; ++round) {
    for (Variants& variants : all) variants.advance(steps);
  }
  json out;
  for (std::size_t k = 0; k < all.size(); ++k) {
    out[std::to_string(counts[k])] = all[k].median_time();
  }
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  buckens::linalg::choose_blas_kernels();
  SolidBlock block;
  int steps = 20;
  std::string together = "6", levels = "none,full";
  for (int k = 1; k < argc; ++k) {
    const auto is_option = [&](const char* name) {
      return std::strcmp(argv[k], name) == 0 && k + 1 < argc;
    };
    if (is_option("--steps")) {
      steps = std::stoi(argv[++k]);
    } else if (is_option("--together")) {
      together = argv[++k];
    } else if (is_option("--coupling")) {
      levels = argv[++k];
    } else {
      block = SolidBlock::parse(argv[k]);
    }
  }
  std::vector<int> counts = {1};
  for (const std::string& count : split(together)) counts.push_back(std::stoi(count));
  json out = {
      {"element", block.element()}, {"divisions", block.shape()}, {"slender", block.is_slender()}};
  for (const std::string& level : split(levels)) {
    out[level] = measure(block, level, counts, steps);
  }
  std::cout << out.dump(1) << '\n';
}
