// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "buckens/run_store/run_snapshot.h"

namespace buckens::exports {

struct GlbOptions {
  run_store::InstantChoice animation;  ///< key frames
  std::optional<double> at;  ///< pose, deformation and colours outside the animation [s]; the end
  double exaggeration = 1;   ///< of deformations
  int shapes = 8;            ///< maximum morph targets per body; all viewers support eight
  double playback = 0;  ///< duration of the animation [s]; 0: that of the run within 2 … 30 s
};

/// What was written to a file.
struct GlbReport {
  double at = 0;               ///< [s]
  std::size_t instants = 0;    ///< key frames
  double playback = 0;         ///< duration of the animation [s]
  double least = 0, most = 0;  ///< von Mises stresses of the ends of the colour scale [Pa]
  /// Largest error of a deformation by too few shapes, relative to the body's largest one.
  double shape_error = 0;
};

/// Writes the surfaces of a run as binary glTF 2.0.
///
/// One node per body carries the motion of its frame; the deformation is a sum of at most `shapes`
/// morph targets with weights over time: the leading left singular vectors of the deformations at
/// the key frames, so that they are the best shapes of that number in the least-squares sense.
/// Beams are octagonal tubes around their nodes. Rigid bodies are lines from the origin of the
/// frame to their markers. Vertices are coloured by von Mises stress at `at`: at nodes if that
/// field was recorded, else the mean of the adjacent elements.
/// @throws InputError if a time is outside the run, IoError
GlbReport export_glb(const run_store::RunReader& run, const GlbOptions& options,
                     const std::filesystem::path& path);

}  // namespace buckens::exports
