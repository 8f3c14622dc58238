// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/step/quick_settings.h"

#include <string_view>

#include "buckens/files/output_file.h"

namespace buckens::mesh_io {

namespace {

// 10 000 faces took more than two minutes, 20 s with these settings; 1000 take a second with both.
constexpr int kManyFaces = 3000;

// -1: as the kernel finds necessary. The lines with other values are its own defaults except for
// the two searches, self-intersection and intersecting wires.
constexpr const char kSettings[] = R"(FromSTEP.exec.op : FixShape
FromSTEP.FixShape.Tolerance3d : &Runtime.Tolerance
FromSTEP.FixShape.MaxTolerance3d : &Runtime.MaxTolerance
FromSTEP.FixShape.MinTolerance3d : 1.e-7
FromSTEP.FixShape.CreateOpenSolidMode : 0
FromSTEP.FixShape.AutoCorrectPrecisionMode : 1
FromSTEP.FixShape.ModifyTopologyMode : 0
FromSTEP.FixShape.ModifyGeometryMode : 1
FromSTEP.FixShape.ClosedWireMode : 1
FromSTEP.FixShape.PreferencePCurveMode : 1
FromSTEP.FixShape.FixEdgeSameParameterMode : 0
FromSTEP.FixShape.FixTailMode : 0
FromSTEP.FixShape.MaxTailAngle : 0
FromSTEP.FixShape.MaxTailWidth : -1
FromSTEP.FixShape.FixSelfIntersectionMode : 0
FromSTEP.FixShape.FixIntersectingWiresMode : 0
)";

}  // namespace

bool has_many_faces(const std::string& step) {
  constexpr std::string_view kFace = "ADVANCED_FACE";
  int count = 0;
  for (std::size_t at = step.find(kFace); at != std::string::npos && count < kManyFaces;
       at = step.find(kFace, at + kFace.size())) {
    ++count;
  }
  return count == kManyFaces;
}

void write_quick_settings(const std::filesystem::path& directory) {
  files::replace_text_file(directory / "STEP", kSettings);
}

}  // namespace buckens::mesh_io
