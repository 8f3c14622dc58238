// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "buckens/base/work.h"
#include "buckens/files/isolated_work.h"
#include "buckens/mesh_io/step/estimate.h"

namespace buckens::mesh_io {

/// For the process that meshes: tells the other one where it is.
void say_stage(const char* stage);
void say_trial(int number);
void say_gluing(std::size_t num_solids);
void say_outlook(const MeshOutlook& outlook, std::size_t num_faces);

/// Reports to base::report_work() how far the meshing of a part is, from what the other process and
/// Gmsh in it say; that it is over when the object ends.
class MeshingProgress {
 public:
  /// @param file shown without its directory
  explicit MeshingProgress(const std::string& file);
  ~MeshingProgress();
  MeshingProgress(const MeshingProgress&) = delete;
  MeshingProgress& operator=(const MeshingProgress&) = delete;

  void stage(const std::string& name);
  files::IsolatedListener listener();
  /// How many solids are being glued, as last heard; 0: none.
  int being_glued() const { return being_glued_; }

 private:
  void hear(const std::string& line);
  void hear_gmsh(const std::string& line);
  /// Another trial begins, counted from 1.
  void trial(int number);
  void set_outlook(double elements, double nodes);

  base::Work work_;
  std::string way_;  // "" or "way 2: "
  long num_faces_ = 0;
  double elements_ = 0;  // expected
  int being_glued_ = 0;  // solids
};

}  // namespace buckens::mesh_io
