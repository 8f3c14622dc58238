// SPDX-License-Identifier: Apache-2.0
// Writes a run until it is killed; tests/test_kill.py reads what is left.
//
//   kill_writer DIRECTORY RECORDS_PER_BURST PAUSE_MS [BURSTS]
//
// Writes bursts of records with pauses between them, BURSTS of them and then silence (0: without
// end). The sensor "clock" of each record holds the monotonic clock at its writing.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <thread>

#include "buckens/run_store/run_directory.h"

namespace {

double clock_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

buckens::results::RecordLayout make_layout() {
  buckens::results::RecordLayout layout;
  for (int body = 0; body < 8; ++body) {
    const std::string path = "bodies/rod" + std::to_string(body);
    layout.add({path + "/pose", "m, 1", {7}, "pose of the body frame", {}});
    layout.add({path + "/displacement", "m, rad", {17, 6}, "nodal displacements", {}});
  }
  layout.add({"sensors/clock", "s", {}, "monotonic clock", {}});
  layout.add({"sensors/count", "1", {2}, "number of the record, twice", {"x", "y"}});
  return layout;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) return 2;
  const int burst = std::atoi(argv[2]);
  const std::chrono::milliseconds pause(std::atoi(argv[3]));
  const int bursts = argc > 4 ? std::atoi(argv[4]) : 0;
  try {
    buckens::run_store::RunDirectory run(argv[1]);
    const buckens::results::RecordLayout layout = make_layout();
    run.begin(layout, {});
    const auto clock = layout.offset(static_cast<std::size_t>(layout.find("sensors/clock")));
    const auto count = layout.offset(static_cast<std::size_t>(layout.find("sensors/count")));
    buckens::results::Record record{0.0, std::vector<double>(layout.num_values(), 1.0)};
    double number = 0;
    for (int round = 0; bursts == 0 || round < bursts; ++round) {
      for (int i = 0; i < burst; ++i) {
        record.t = 1e-3 * number;
        record.values[clock] = clock_now();
        record.values[count] = record.values[count + 1] = number++;
        run.write(record);
      }
      if (pause.count() > 0) std::this_thread::sleep_for(pause);
    }
    std::this_thread::sleep_for(std::chrono::hours(1));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
