// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace buckens::run_store {

// Names of the files in a run directory.
inline constexpr char kResultsName[] = "results.h5";
inline constexpr char kSensorsName[] = "sensors.csv";
inline constexpr char kSummaryName[] = "summary.json";
inline constexpr char kModelName[] = "model.yaml";
inline constexpr char kLogName[] = "log.txt";
inline constexpr char kCheckpointName[] = "checkpoint.h5";
inline constexpr char kUndoName[] = "results.undo";  ///< what changed since the checkpoint
inline constexpr char kModesName[] = "modes.json";   ///< of `buckens modes` only

}  // namespace buckens::run_store
