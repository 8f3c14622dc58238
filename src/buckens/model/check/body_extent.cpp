// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/check/body_extent.h"

#include <concepts>

#include <Eigen/Geometry>

namespace buckens::model {

using Eigen::Vector3d;

namespace {

class Extent {
 public:
  double of(const body::BodySpec& body) {
    std::visit([this](const auto& kind) { add(kind); }, body.kind);
    return box_.isEmpty() ? 0.0 : box_.sizes().maxCoeff();
  }

 private:
  void add(const fem::BeamSpec& beam) {
    box_.extend(beam.from);
    box_.extend(beam.to);
    for (const Vector3d& p : beam.through) box_.extend(p);
  }
  void add(const fem::StructureSpec& structure) {
    for (const fem::NodeSpec& node : structure.nodes) box_.extend(node.position);
  }
  void add(const fem::MeshSpec& mesh) {
    if (mesh.imported) return add(*mesh.imported);
    std::visit([this](const auto& shape) { add(shape); }, mesh.shape);
  }
  void add(const fem::GeometrySpec& part) {
    if (part.imported) add(*part.imported);
  }
  void add(const fem::MatricesSpec& matrices) {
    if (!matrices.imported) return;
    for (const fem::Node& node : matrices.imported->nodes) box_.extend(node.position);
  }
  void add(const fem::ImportedMesh& mesh) {
    for (const Vector3d& p : mesh.positions) box_.extend(p);
  }
  void add(const fem::BoxMeshSpec& box) {
    box_.extend(box.from);
    box_.extend(box.from + box.size);
  }
  void add(const fem::PlateMeshSpec& plate) {
    box_.extend(plate.from);
    box_.extend(plate.from + Vector3d(plate.size[0], plate.size[1], 0));
  }
  template <class Round>
  requires std::derived_from<Round, fem::RoundMeshSpec>
  void add(const Round& round) {
    // Somewhat large: the radius counts in all directions.
    const fem::Cylinder shape = round.shape();
    for (const Vector3d& p : {shape.from, shape.to}) {
      box_.extend(Vector3d(p.array() - shape.outer_radius));
      box_.extend(Vector3d(p.array() + shape.outer_radius));
    }
  }
  void add(const fem::MeshFileSpec& /*not read*/) {}
  void add(const body::RigidSpec& /*has no shape*/) {}
  void add(const body::LikeSpec& /*resolved by the reader*/) {}

  Eigen::AlignedBox3d box_;
};

}  // namespace

double body_extent(const body::BodySpec& body) { return Extent().of(body); }

}  // namespace buckens::model
