// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/abaqus/ties.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <unordered_map>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/mesh_io/abaqus/face_point.h"

namespace buckens::mesh_io {

using Eigen::Matrix3Xd;
using Eigen::Vector3d;

namespace {

/// Share of the mean size of the master's faces within which nodes are tied, as Abaqus has it.
constexpr double kTieTolerance = 0.05;
/// Share of a face's size below which a gap is rounding of coordinates with seven digits.
constexpr double kNoGap = 1e-6;
/// Share of the largest weight that is rounding.
constexpr double kNoWeight = 1e-12;
/// Terms of all equations together.
constexpr std::size_t kMostTieTerms = 50'000'000;

/// The faces of a master surface, found by place.
class MasterFaces {
 public:
  MasterFaces(const std::vector<AbaqusFace>& faces, const std::vector<Vector3d>& positions) {
    for (const AbaqusFace& face : faces) {
      Face& own = faces_.emplace_back();
      own.face = &face;
      own.nodes.resize(3, static_cast<Eigen::Index>(face.nodes.size()));
      for (std::size_t k = 0; k < face.nodes.size(); ++k) {
        own.nodes.col(static_cast<Eigen::Index>(k)) =
            positions[static_cast<std::size_t>(face.nodes[k])];
      }
      own.centre = own.nodes.rowwise().mean();
      for (Eigen::Index k = 0; k < own.nodes.cols(); ++k) {
        own.radius = std::max(own.radius, (own.nodes.col(k) - own.centre).norm());
      }
      mean_ += 2.0 * own.radius / static_cast<double>(faces.size());
      largest_ = std::max(largest_, own.radius);
    }
  }

  /// Mean of the faces' sizes, twice the distance of the farthest corner from the middle.
  double mean_size() const { return mean_; }

  /// Sorts the faces into cells, for points up to this distance.
  void index(double reach) {
    // A curved face bulges less than its radius beyond its nodes.
    cell_ = std::max(2.0 * largest_ + reach, 1e-300);
    for (std::size_t f = 0; f < faces_.size(); ++f) cells_[key(faces_[f].centre)].push_back(f);
  }

  struct Found {
    const AbaqusFace* face = nullptr;
    const Matrix3Xd* nodes = nullptr;
    FacePoint point;
    double size = 0;
  };

  /// The nearest face, none if all lie farther away than the reach of index().
  Found nearest(const Vector3d& x, double reach) const {
    Found best;
    best.point.distance = reach;
    const Cell at = key(x);
    for (std::int64_t i = -1; i <= 1; ++i) {
      for (std::int64_t j = -1; j <= 1; ++j) {
        for (std::int64_t k = -1; k <= 1; ++k) {
          const auto found = cells_.find({at[0] + i, at[1] + j, at[2] + k});
          if (found == cells_.end()) continue;
          for (const std::size_t f : found->second) try_face(faces_[f], x, best);
        }
      }
    }
    return best;
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  struct CellHash {
    std::size_t operator()(const Cell& cell) const {
      std::uint64_t out = 1469598103934665603U;
      for (const std::int64_t k : cell) {
        out = (out ^ static_cast<std::uint64_t>(k)) * 1099511628211U;
        out ^= out >> 31;
      }
      return out;
    }
  };
  struct Face {
    const AbaqusFace* face = nullptr;
    Matrix3Xd nodes;
    Vector3d centre;
    double radius = 0;
  };

  Cell key(const Vector3d& x) const {
    Cell out;
    for (int k = 0; k < 3; ++k) {
      // Far from the surface all cells are as good as one.
      const double place = std::clamp(x[k] / cell_, -1e15, 1e15);
      out[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(std::floor(place));
    }
    return out;
  }

  static void try_face(const Face& face, const Vector3d& x, Found& best) {
    if ((x - face.centre).norm() - 1.5 * face.radius > best.point.distance) return;
    FacePoint point = nearest_on_face(face.nodes, face.face->is_edge, x);
    if (!(point.distance <= best.point.distance)) return;
    best = {face.face, &face.nodes, std::move(point), 2.0 * face.radius};
  }

  std::vector<Face> faces_;
  std::unordered_map<Cell, std::vector<std::size_t>, CellHash> cells_;
  double mean_ = 0, largest_ = 0, cell_ = 1;
};

class TieMaker {
 public:
  TieMaker(const AbaqusLines& lines, AbaqusNames& names, const std::vector<bool>& turns,
           fem::ImportedMesh& out)
      : lines_(lines), names_(names), turns_(turns), out_(out) {}

  void run() {
    tied_.assign(names_.positions().size(), false);
    for (std::size_t s = 0; s < names_.scopes().size(); ++s) {
      for (const AbaqusTie& tie : names_.scopes()[s].scope->ties) add(static_cast<int>(s), tie);
    }
  }

 private:
  bool all_turn(const std::vector<int>& nodes) const {
    return std::all_of(nodes.begin(), nodes.end(),
                       [&](int node) { return turns_[static_cast<std::size_t>(node)]; });
  }

  void note(const AbaqusTie& tie, const std::string& text, int count) {
    out_.notes.push_back({fmt::format("*TIE \"{}\": {}", tie.name, text),
                          tie.place.file == 0 ? tie.place.line : 0, count});
  }

  void add(int scope, const AbaqusTie& tie);
  void tie_node(int node, const MasterFaces::Found& at, const AbaqusTie& tie);
  void add_equation(fem::ImportedEquation equation, const AbaqusTie& tie);

  const AbaqusLines& lines_;
  AbaqusNames& names_;
  const std::vector<bool>& turns_;
  fem::ImportedMesh& out_;
  std::vector<bool> tied_;
  std::size_t num_terms_ = 0;
};

void TieMaker::add(int scope, const AbaqusTie& tie) {
  const std::vector<AbaqusFace> faces = names_.faces(scope, tie.master, tie.place);
  if (faces.empty()) {
    lines_.fail(tie.place, fmt::format("*TIE: the master surface \"{}\" has no faces of solids or "
                                       "shells; make it of TYPE=ELEMENT, or swap it with the slave",
                                       tie.master));
  }
  MasterFaces master(faces, names_.positions());
  const double reach = tie.tolerance.value_or(kTieTolerance * master.mean_size());
  // Beyond the reach only to report how far the nodes are; rounding must not untie what touches.
  const double slack = kNoGap * master.mean_size();
  master.index(reach + slack);
  int untied = 0, again = 0, num_tied = 0, gaps = 0, hinges = 0;
  double gap = 0;
  for (const auto& [node, share] : names_.surface_nodes(scope, tie.slave, tie.place)) {
    const auto at =
        master.nearest(names_.positions()[static_cast<std::size_t>(node)], reach + slack);
    if (at.face == nullptr) {
      ++untied;
      continue;
    }
    const auto& own = at.face->nodes;
    if (std::find(own.begin(), own.end(), node) != own.end()) continue;  // one mesh there
    if (tied_[static_cast<std::size_t>(node)]) {
      ++again;
      continue;
    }
    tied_[static_cast<std::size_t>(node)] = true;
    ++num_tied;
    if (at.point.distance > kNoGap * at.size) ++gaps;
    gap = std::max(gap, at.point.distance);
    if (turns_[static_cast<std::size_t>(node)] && !all_turn(own)) ++hinges;
    tie_node(node, at, tie);
  }
  if (gaps > 0) {
    note(tie,
         fmt::format("nodes lie off the master surface, by up to {:.3g}; they stay there and "
                     "rotate with its faces",
                     gap),
         gaps);
  }
  if (untied > 0) {
    note(tie,
         fmt::format("nodes of \"{}\" lie farther than {:.3g} from \"{}\" and are not tied; "
                     "POSITION TOLERANCE= changes that",
                     tie.slave, reach, tie.master),
         untied);
  }
  if (again > 0)
    note(tie, "nodes that are already tied by another *TIE are left to that one", again);
  if (hinges > 0) {
    note(tie, "rotations of shells and beams are not tied to solids, which have none", hinges);
  }
  if (num_tied == 0 && untied == 0 && again == 0) note(tie, "it has nothing to tie", 1);
}

void TieMaker::tie_node(int node, const MasterFaces::Found& at, const AbaqusTie& tie) {
  const std::vector<int>& master = at.face->nodes;
  const bool master_turns = all_turn(master);
  const Vector3d arm = names_.positions()[static_cast<std::size_t>(node)] - at.point.place;
  const bool has_gap = at.point.distance > 1e-12 * at.size;
  // Rotation of the face by displacements of its nodes; an edge of a shell turns as its nodes do.
  std::optional<Matrix3Xd> turn;
  if (has_gap && !master_turns && at.point.slopes.cols() == 2) {
    turn = face_rotation(*at.nodes, at.point.slopes);
  }
  for (int v = 0; v < 3; ++v) {
    fem::ImportedEquation equation;
    equation.terms.push_back({node, v, 1.0});
    for (std::size_t k = 0; k < master.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      const double weight = at.point.weights[i];
      // ω × arm: row v of it by ω is (e_v × …): (ω × arm)·e_v = ω·(arm × e_v).
      const Vector3d lever = arm.cross(Vector3d::Unit(v));
      Vector3d by_place = weight * Vector3d::Unit(v);
      if (turn) by_place += turn->middleCols(3 * i, 3).transpose() * lever;
      for (int d = 0; d < 3; ++d) {
        if (std::abs(by_place[d]) > kNoWeight)
          equation.terms.push_back({master[k], d, -by_place[d]});
      }
      if (!has_gap || !master_turns) continue;
      for (int d = 0; d < 3; ++d) {
        const double share = weight * lever[d];
        if (std::abs(share) > kNoWeight * at.size) {
          equation.terms.push_back({master[k], 3 + d, -share});
        }
      }
    }
    add_equation(std::move(equation), tie);
  }
  if (!master_turns || !tie.ties_rotations || !turns_[static_cast<std::size_t>(node)]) return;
  for (int v = 3; v < 6; ++v) {
    fem::ImportedEquation equation;
    equation.terms.push_back({node, v, 1.0});
    for (std::size_t k = 0; k < master.size(); ++k) {
      const double weight = at.point.weights[static_cast<Eigen::Index>(k)];
      if (std::abs(weight) > kNoWeight) equation.terms.push_back({master[k], v, -weight});
    }
    add_equation(std::move(equation), tie);
  }
}

void TieMaker::add_equation(fem::ImportedEquation equation, const AbaqusTie& tie) {
  equation.line = tie.place.file == 0 ? tie.place.line : 0;
  num_terms_ += equation.terms.size();
  if (num_terms_ > kMostTieTerms) {
    lines_.fail(tie.place, fmt::format("the ties have more than {} terms in total", kMostTieTerms));
  }
  out_.equations.push_back(std::move(equation));
}

}  // namespace

void add_abaqus_ties(const AbaqusLines& lines, AbaqusNames& names, const std::vector<bool>& turns,
                     fem::ImportedMesh& out) {
  TieMaker(lines, names, turns, out).run();
}

}  // namespace buckens::mesh_io
