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
  int shapes = 8;            ///< most morph targets per body; viewers bear eight everywhere
  double playback = 0;       ///< how long the animation lasts [s]; 0: as the run, but 2 … 30 s
};

/// What went into a file.
struct GlbReport {
  double at = 0;               ///< [s]
  std::size_t instants = 0;    ///< key frames
  double playback = 0;         ///< how long the animation lasts [s]
  double least = 0, most = 0;  ///< von Mises stresses of the ends of the colour scale [Pa]
  /// Largest error of a deformation by the few shapes, relative to the body's largest one.
  double shape_error = 0;
};

/// Writes the surfaces of a run as binary glTF 2.0.
///
/// One node per body carries the motion of its frame; the deformation is a sum of at most `shapes`
/// morph targets with weights over time: the leading left singular vectors of the deformations at
/// the key frames, so that no other shapes of that number come closer in the sense of least
/// squares. Beams are octagonal tubes around their nodes. Rigid bodies are lines from the origin of
/// the frame to their markers. Vertices are coloured by von Mises stress at `at`: at nodes where
/// that field was recorded, else the mean of the elements around.
/// @throws InputError if a time lies outside the run, IoError
GlbReport export_glb(const run_store::RunReader& run, const GlbOptions& options,
                     const std::filesystem::path& path);

}  // namespace buckens::exports
