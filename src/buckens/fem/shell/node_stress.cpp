// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/shell/node_stress.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <span>

#include "buckens/fem/shell/element.h"
#include "buckens/fem/shell/turn.h"
#include "buckens/fem/solid/recovery.h"
#include "buckens/spatial/rotation.h"

namespace buckens::fem {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using linalg::Triplet;

namespace {

// Cosine of 25°, up to which the shells at a node have one director, too.
constexpr double kSameSurface = 0.9063;
// Up to which the x axes of elements with directed layers may differ: 10° in radians.
constexpr double kSameDirection = 0.175;

bool same_layer(const ShellLayer& a, const ShellLayer& b) {
  const LayerElasticity of_a = layer_elasticity(a), of_b = layer_elasticity(b);
  return a.thickness == b.thickness && of_a.in_plane == of_b.in_plane;
}

bool same_section(const ShellSection& a, const ShellSection& b) {
  return a.offset == b.offset &&
         std::equal(a.layers.begin(), a.layers.end(), b.layers.begin(), b.layers.end(), same_layer);
}

bool has_direction(const ShellSection& section) {
  return std::any_of(section.layers.begin(), section.layers.end(),
                     [](const ShellLayer& layer) { return layer.material.orthotropy.has_value(); });
}

Eigen::Matrix<double, 6, 1> tensor_in_model_axes(const Matrix3d& axes, const Matrix3d& local,
                                                 double shear) {
  const Matrix3d T = axes * local * axes.transpose();
  Eigen::Matrix<double, 6, 1> out;
  out << T(0, 0), T(1, 1), T(2, 2), shear * T(0, 1), shear * T(1, 2), shear * T(0, 2);
  return out;
}

Matrix3d surface_tensor(const Vector3d& s, double shear, double zz) {
  Matrix3d out;
  out << s[0], shear * s[2], 0.0, shear * s[2], s[1], 0.0, 0.0, 0.0, zz;
  return out;
}

double surface_mises(const Vector3d& s) {
  return std::sqrt(std::max(0.0, s[0] * s[0] - s[0] * s[1] + s[1] * s[1] + 3.0 * s[2] * s[2]));
}

}  // namespace

/// The shells of a mesh, and the groups at one node.
class ShellNodeStresses::Grouping {
 public:
  struct Shell {
    const ShellBlock* block;
    int index;
    std::size_t section;  // number among the different ones
  };
  struct Corner {
    int shell;
    std::size_t corner;
  };
  struct Member {
    Corner at;
    Matrix3d axes;  // of the element there
  };

  explicit Grouping(const FeModel& fe) : fe_(fe), at_node_(fe.nodes.size()) {
    for (const auto& block : fe.blocks) {
      const auto* source = dynamic_cast<const ShellBlock*>(block.get());
      for (int e = 0; source != nullptr && e < source->num_elements(); ++e) {
        const auto nodes = source->nodes(e);
        for (std::size_t k = 0; k < nodes.size(); ++k) {
          at_node_[static_cast<std::size_t>(nodes[k])].push_back(
              {static_cast<int>(shells.size()), k});
        }
        shells.push_back({source, e, number_of(source->shell_section(e))});
      }
    }
  }

  std::vector<Shell> shells;
  std::vector<const ShellSection*> sections;  // different ones

  /// The shells at a node, in groups of neighbours.
  std::vector<std::vector<Member>> groups(int node) const {
    std::vector<Member> members;
    for (const Corner& corner : at_node_[static_cast<std::size_t>(node)]) {
      const Shell& shell = shells[static_cast<std::size_t>(corner.shell)];
      const ShellElement element = shell_element(*shell.block, fe_.nodes, shell.index);
      members.push_back({corner, shell_corner_axes(element)[corner.corner]});
    }
    std::vector<std::size_t> root(members.size());
    std::iota(root.begin(), root.end(), std::size_t{0});
    for (const auto& [other, on_side] : sides(members)) {
      if (on_side.size() != 2 || !are_alike(members[on_side[0]], members[on_side[1]])) continue;
      const std::size_t from = root[on_side[0]], to = root[on_side[1]];
      std::replace(root.begin(), root.end(), std::max(from, to), std::min(from, to));
    }
    std::vector<std::vector<Member>> out;
    for (std::size_t k = 0; k < members.size(); ++k) {
      if (root[k] != k) continue;
      out.emplace_back();
      for (std::size_t m = k; m < members.size(); ++m) {
        if (root[m] == k) out.back().push_back(members[m]);
      }
    }
    return out;
  }

 private:
  std::size_t number_of(const ShellSection& section) {
    const auto known = numbers_.find(&section);
    if (known != numbers_.end()) return known->second;
    std::size_t number = 0;
    while (number < sections.size() && !same_section(*sections[number], section)) ++number;
    if (number == sections.size()) sections.push_back(&section);
    numbers_.emplace(&section, number);
    return number;
  }

  /// By the other end of a side, the members that have it.
  std::map<int, std::vector<std::size_t>> sides(const std::vector<Member>& members) const {
    std::map<int, std::vector<std::size_t>> out;
    for (std::size_t m = 0; m < members.size(); ++m) {
      const Shell& shell = shells[static_cast<std::size_t>(members[m].at.shell)];
      const auto nodes = shell.block->nodes(shell.index);
      const auto rim = shell_rim(static_cast<Eigen::Index>(nodes.size()));
      const auto at = std::find(rim.begin(), rim.end(), static_cast<int>(members[m].at.corner));
      const auto k = static_cast<std::size_t>(at - rim.begin()), n = rim.size();
      out[nodes[static_cast<std::size_t>(rim[(k + 1) % n])]].push_back(m);
      out[nodes[static_cast<std::size_t>(rim[(k + n - 1) % n])]].push_back(m);
    }
    return out;
  }

  bool are_alike(const Member& a, const Member& b) const {
    const std::size_t section = shells[static_cast<std::size_t>(a.at.shell)].section;
    if (section != shells[static_cast<std::size_t>(b.at.shell)].section) return false;
    if (a.axes.col(2).dot(b.axes.col(2)) < kSameSurface) return false;
    return !has_direction(*sections[section]) ||
           std::abs(turn_between(a.axes, b.axes)) < kSameDirection;
  }

  const FeModel& fe_;
  std::vector<std::vector<Corner>> at_node_;
  std::map<const ShellSection*, std::size_t> numbers_;
};

namespace {

/// Mean normal; x is that of the first one, carried there.
template <class Members>
Matrix3d mean_axes(const Members& members) {
  Vector3d normal = Vector3d::Zero();
  for (const auto& member : members) normal += member.axes.col(2);
  normal.normalize();
  const Matrix3d& first = members.front().axes;
  const Vector3d x = spatial::rotation_between(first.col(2), normal) * first.col(0);
  Matrix3d out;
  out << x, normal.cross(x), normal;
  return out;
}

using SurfaceRows = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 6 * kMostShellNodes>;

/// Rows over the six variables of each node as entries of a sparse matrix.
void add_rows(const SurfaceRows& rows, const DofMap& dofs, std::span<const int> nodes,
              int first_row, std::vector<Triplet>& entries) {
  Eigen::Index column = 0;
  for (const int node : nodes) {
    for (const int dof : dofs.node_dofs[static_cast<std::size_t>(node)]) {
      for (int row = 0; row < 6 && dof >= 0; ++row) {
        if (rows(row, column) != 0.0) entries.emplace_back(first_row + row, dof, rows(row, column));
      }
      ++column;
    }
  }
}

}  // namespace

ShellNodeStresses::ShellNodeStresses(const FeModel& fe, const std::vector<int>& nodes) {
  const Grouping grouping(fe);
  for (const ShellSection* section : grouping.sections) {
    sides_.push_back({side_of(*section, true), side_of(*section, false)});
  }
  constexpr std::array<int, kMostShellNodes> kNone = {-1, -1, -1, -1, -1, -1, -1, -1};
  corner_place_.assign(grouping.shells.size(), kNone);
  for (const Grouping::Shell& shell : grouping.shells) {
    corner_node_.push_back(kNone);
    const auto own = shell.block->nodes(shell.index);
    std::copy(own.begin(), own.end(), corner_node_.back().begin());
  }
  std::vector<double> shares;  // of one element in each place
  for (const int node : nodes) {
    for (const auto& group : grouping.groups(node)) {
      for (const Grouping::Member& member : group) {
        corner_place_[static_cast<std::size_t>(member.at.shell)][member.at.corner] =
            static_cast<int>(places_.size());
      }
      places_.push_back({node, mean_axes(group)});
      shares.push_back(1.0 / static_cast<double>(group.size()));
      sections_.push_back(
          grouping.shells[static_cast<std::size_t>(group.front().at.shell)].section);
    }
  }
  std::vector<Triplet> entries;
  for (std::size_t k = 0; k < grouping.shells.size(); ++k) {
    const auto& own = corner_place_[k];
    if (std::all_of(own.begin(), own.end(), [](int place) { return place < 0; })) continue;
    const Grouping::Shell& shell = grouping.shells[k];
    const auto strains = shell_corner_strains(shell_element(*shell.block, fe.nodes, shell.index));
    for (std::size_t corner = 0; corner < strains.size(); ++corner) {
      if (own[corner] < 0) continue;
      const auto place = static_cast<std::size_t>(own[corner]);
      const auto& [rows, axes] = strains[corner];
      const Matrix3d turn =
          shares[place] * strain_in_other_axes(turn_between(axes, places_[place].axes));
      SurfaceRows turned(6, rows.cols());
      turned << turn * rows.topRows<3>(), turn * rows.middleRows<3>(3);
      add_rows(turned, fe.dofs, shell.block->nodes(shell.index), 6 * own[corner], entries);
    }
  }
  rows_.resize(6 * static_cast<Eigen::Index>(places_.size()), fe.dofs.num_dofs);
  rows_.setFromTriplets(entries.begin(), entries.end());
}

int ShellNodeStresses::place_of(int node, int shell) const {
  const auto& nodes = corner_node_.at(static_cast<std::size_t>(shell));
  const auto at = std::find(nodes.begin(), nodes.end(), node);
  if (at == nodes.end()) return -1;
  return corner_place_[static_cast<std::size_t>(shell)]
                      [static_cast<std::size_t>(at - nodes.begin())];
}

ShellNodeStresses::Side ShellNodeStresses::side_of(const ShellSection& section, bool is_top) {
  const ShellLayer& layer = is_top ? section.layers.back() : section.layers.front();
  Side out;
  out.elasticity = layer_elasticity(layer).in_plane;
  out.z = (is_top ? 0.5 : -0.5) * section.thickness();
  const Material& m = layer.material;
  if (!m.orthotropy) {
    out.thinning = Eigen::RowVector3d(-m.nu / m.E, -m.nu / m.E, 0.0);
    return out;
  }
  const Orthotropy& o = *m.orthotropy;
  const double c = std::cos(layer.angle), s = std::sin(layer.angle);
  out.thinning = -o.nu13 / o.E[0] * Eigen::RowVector3d(c * c, s * s, 2 * c * s) -
                 o.nu23 / o.E[1] * Eigen::RowVector3d(s * s, c * c, -2 * c * s);
  return out;
}

ShellNodeStresses::Surface ShellNodeStresses::surface(
    const Eigen::Ref<const TensorColumns>& strains) const {
  const auto count = static_cast<Eigen::Index>(places_.size());
  Surface out{TensorColumns(6, count), TensorColumns(6, count), Eigen::VectorXd(count)};
  for (Eigen::Index p = 0; p < count; ++p) {
    const auto place = static_cast<std::size_t>(p);
    const auto& [top, bottom] = sides_[sections_[place]];
    const auto at = [&strains, p](const Side& side) -> Vector3d {
      return strains.col(p).head<3>() + side.z * strains.col(p).tail<3>();
    };
    const Vector3d strain = at(top), stress = top.elasticity * strain;
    const Matrix3d& axes = places_[place].axes;
    out.strain.col(p) =
        tensor_in_model_axes(axes, surface_tensor(strain, 0.5, top.thinning * stress), 2.0);
    out.stress.col(p) = tensor_in_model_axes(axes, surface_tensor(stress, 1.0, 0.0), 1.0);
    out.mises[p] = std::max(surface_mises(stress), surface_mises(bottom.elasticity * at(bottom)));
  }
  return out;
}

}  // namespace buckens::fem
