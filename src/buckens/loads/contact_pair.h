// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <span>

#include <Eigen/Dense>

namespace buckens::loads {

class ContactMesh;

/// A shape about the origin of its marker, in the marker's axes.
struct ContactShape {
  enum class Kind { plane, sphere, socket, bore, capsule, cylinder, box, mesh };

  Kind kind = Kind::sphere;
  double radius = 0;                                ///< [m]
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< unit vector; of a plane: its normal
  double half_length = 0;                           ///< of capsules and cylinders [m]
  Eigen::Vector3d half = Eigen::Vector3d::Zero();   ///< half the edges of a box [m]; of a mesh
                                                    ///< its reach along each axis
  std::shared_ptr<const ContactMesh> mesh;          ///< of meshes, in axes of the marker
  int flat = -1;  ///< axis of a box that points out of the plane of a planar model, −1: none
};

/// Name of the kind as spelled in the model file.
const char* to_string(ContactShape::Kind kind);

/// Where two shapes touch, or are next to each other: halfway between both surfaces.
struct ContactSpot {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();    ///< [m]
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit vector from the first to the second
  double gap = 0;                                     ///< negative: overlap [m]
  double share = 1;                                   ///< of the law's stiffness
  double held = 0;  ///< energy beyond that of its overlap, per stiffness [m²]
  Eigen::Vector3d couple = Eigen::Vector3d::Zero();  ///< beside its force, on the second, per force
                                                     ///< [m]
};

/// Two shapes that can touch. The first is a surface, given by the distance from it
/// (loads/shape_distance.h); the second is made of spheres, or of points where their radius is
/// zero. So pairs have exact distances: anything with a sphere; a plane with capsule, cylinder and
/// box; a bore with a cylinder. Capsules touch capsules, boxes and cylinders along a line
/// (loads/line_spots.h); two boxes touch with areas (loads/box_manifold.h), a plane and a mesh and
/// a cylinder and a box or cylinder with volumes (loads/mesh_spots.h, loads/cylinder_spots.h); a
/// mesh touches a sphere with each of its patches, and another mesh by springs spread over it
/// (loads/mesh_on_mesh.h). Theory: docs/theory/25-contact.md §1, §6.
class ContactPair {
 public:
  static constexpr int kMostSpots = 18;
  using Spots = std::array<ContactSpot, kMostSpots>;

  /// All pairs that can touch, first and second.
  using Kinds = std::array<ContactShape::Kind, 2>;
  static std::span<const Kinds> all();
  /// Whether these are among them, in this order.
  static bool knows(ContactShape::Kind first, ContactShape::Kind second);

  /// @pre knows(first.kind, second.kind)
  ContactPair(const ContactShape& first, const ContactShape& second);

  /// Number of places at which they can touch at once; constant.
  int num_spots() const { return num_spots_; }
  /// Finds them. Their numbers stay with them as the bodies move.
  /// @param r origin of the second marker in axes of the first [m]
  /// @param R orientation of the second marker in the first
  /// @param spots the first num_spots() of them are written
  void find(const Eigen::Vector3d& r, const Eigen::Matrix3d& R, std::span<ContactSpot> spots) const;

  const ContactShape& first() const { return first_; }
  const ContactShape& second() const { return second_; }

 private:
  /// Centres of the spheres that the second is made of, in axes of the first.
  void centres(const Eigen::Vector3d& r, const Eigen::Matrix3d& R,
               std::span<ContactSpot> spots) const;
  void rim_points(const Eigen::Vector3d& r, const Eigen::Matrix3d& R,
                  std::span<ContactSpot> spots) const;
  /// Normal of the first where a rim around this centre is nearest to it.
  Eigen::Vector3d normal_at_rim(const Eigen::Vector3d& centre, const Eigen::Vector3d& axis) const;

  ContactShape first_, second_;
  double radius_ = 0;  // of the spheres
  int num_spots_ = 1;
};

}  // namespace buckens::loads
