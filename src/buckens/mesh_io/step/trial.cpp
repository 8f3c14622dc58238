// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/step/trial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <set>

#include <Eigen/Core>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "buckens/base/errors.h"
#include "buckens/base/stopwatch.h"
#include "buckens/fem/mesh/straighten.h"
#include "buckens/files/isolated_work.h"
#include "buckens/mesh_io/gmsh/library.h"
#include "buckens/mesh_io/gmsh/mesh.h"
#include "buckens/mesh_io/step/estimate.h"
#include "buckens/mesh_io/step/faults.h"
#include "buckens/mesh_io/step/flat_elements.h"
#include "buckens/mesh_io/step/glued_part.h"
#include "buckens/mesh_io/step/progress.h"
#include "buckens/mesh_io/step/shapes.h"
#include "buckens/mesh_io/step/surface.h"
#include "buckens/mesh_io/step/walls.h"

namespace buckens::mesh_io {

namespace {

constexpr double kMostElements = 5e6;
// Passes in which Gmsh moves nodes of badly shaped elements of second order. Its own number is 25:
// of a dozen printer parts where that did not reach the aim, after 1 to 20 s, each kept all of its
// inverted elements.
constexpr int kPasses = 2;
// Elements turned inside out for which Gmsh moves nodes at all: 1059 in a thin tube took it a
// minute on a busy machine, and all stayed as they were.
constexpr int kMostMoved = 300;
// Elements up to which a mesh is made again to follow thin walls, and about as many as it then has.
constexpr std::size_t kMostAtWalls = 40000;
// Of processor time for it and again for its second order, beyond that of the first mesh: 40 000
// elements take five seconds.
constexpr double kWallSeconds = 15;
constexpr int kTetrahedra = 4;  // Gmsh's type
// Of processor time, for the mesh and again for its second order. Parts take up to 1e-4 s per
// element; 350 000 elements instead of a few thousand took 20 s. What takes much longer usually
// never ends.
constexpr double kMeshSeconds = 100, kSecondsPerElement = 1e-3;

/// What the file holds, in metres.
struct Extent {
  double diagonal = 0, volume = 0, area = 0;
};

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// Meshes one part in one way.
class Trial {
 public:
  Trial(GluedPart& part, const StepTask& task, const StepTrial& trial)
      : glued_(part),
        task_(task),
        trial_(trial),
        metre_(part.in_millimetres() ? 1e3 : 1.0),
        gmsh_(part.gmsh()),
        faults_(gmsh_, metre_) {}

  std::string run() {
    if (!glued_.problem().empty()) return "error " + glued_.problem();
    std::string out = glued_.times();
    if (trial_.tolerance > 0) {
      out += sew();
      out += time_line("mending", watch_.lap());
    }
    std::string open = faults_.gap();
    if (gmsh_.entities(3).empty()) return open;
    measure();
    if (trial_.tolerance == 0) out += glued_.faces();
    out += faults_.loose_faces() + faults_.hinges();
    const double wanted = task_.request.size ? *task_.request.size : chosen();
    const double used = trial_.size * (trial_.size < 1 ? std::min(wanted, chosen()) : wanted);
    const MeshOutlook outlook = expected(used);
    if (!(outlook.elements < kMostElements)) {
      return fmt::format(
          "error elements of {:g} m in a volume of {:g} m^3 would be about {:.2g}, more than a "
          "body can have; give a larger size",
          wanted, part_.volume, outlook.elements);
    }
    say_outlook(outlook, gmsh_.entities(2).size());
    const double seconds = kMeshSeconds + outlook.elements * kSecondsPerElement;
    files::limit_time_from_now(seconds);
    out += fmt::format("size {:.17g} {:.17g}\n", wanted, part_.volume);
    set_options(used * metre_);
    const Labels labels = labels_of_solids();
    gmsh_.mesh(3);
    std::string reason = failure();
    if (!reason.empty()) {
      const MendedSurface surface = mend_surface(gmsh_, metre_);
      if (!surface.notes.empty()) {
        gmsh_.mesh(3);
        reason = failure();
        out += surface.notes;
      }
      if (!reason.empty() && !surface.crossings.empty()) reason += "; " + surface.crossings;
    }
    if (reason.empty()) reason = mend_flat_elements(gmsh_, metre_);
    if (!reason.empty()) {
      return open.empty() ? "failed " + reason : fmt::format("{}; {}", open, reason);
    }
    add_groups(labels);
    out += mesh_times();
    if (!task_.request.size) {
      if (const auto followed = follow_walls(used)) return out + *followed;
    }
    return out + thin_walls(used) + finished(seconds);
  }

 private:
  double chosen() const { return chosen_size(part_.diagonal, part_.volume, part_.area); }

  MeshOutlook expected(double size) const {
    const double triangles = expected_triangles(face_extents(gmsh_), size * metre_,
                                                trial_.smallest * size * metre_, trial_.in_a_turn);
    return expected_mesh(part_.volume, size, triangles, task_.request.order);
  }

  /// Writes the mesh, in the wanted order.
  std::string finished(double seconds) {
    std::string out = messages();
    files::limit_time_from_now(seconds);
    if (task_.request.order == 2) {
      curve();
    } else {
      gmsh_.write(task_.mesh);
    }
    return out + time_line("second-order", watch_.lap());
  }

  /// Meshes anew, with smaller elements where one flat element fills a wall, if there are few. In a
  /// copy of this process, which keeps the mesh that there is.
  /// @return what it says of its mesh; nothing if it came to none
  std::optional<std::string> follow_walls(double size) {
    if (gmsh_.element_nodes(kTetrahedra, -1).size() > 4 * kMostAtWalls) return std::nullopt;
    const auto flat = flat_faces(part_mesh(gmsh_));
    const auto sizes = sizes_for_walls(flat, trial_.smallest * size * metre_, size * metre_,
                                       static_cast<double>(kMostAtWalls));
    if (sizes.empty()) return std::nullopt;
    std::map<GmshEntity, double> bounds;
    double least = size * metre_, wall = least;
    for (const auto& [face, own] : sizes) {
      bounds[{2, face}] = own;
      least = std::min(least, own);
      for (const GmshEntity& curve : gmsh_.boundary({{2, face}})) {
        double& bound = bounds.try_emplace({1, std::abs(curve.second)}, own).first->second;
        bound = std::min(bound, own);
      }
    }
    for (const FlatFace& face : flat) wall = std::min(wall, face.wall);
    const GmshLibrary::SizeOf bound = [&bounds](int dimension, int entity) {
      const auto found = bounds.find({dimension, entity});
      return found == bounds.end() ? 1e22 : found->second;
    };
    const std::string note = fmt::format(
        "note elements down to {:.3g} mm instead of {:.3g} mm resolve walls down to {:.2g} mm ({} "
        "faces), which flat elements would make too stiff\n",
        least / metre_ * 1e3, size * 1e3, wall / metre_ * 1e3, sizes.size());
    const auto work = [&] {
      gmsh_.clear_mesh();
      gmsh_.bound_sizes(&bound);
      gmsh_.mesh(3);
      if (!failure().empty() || !mend_flat_elements(gmsh_, metre_).empty()) return std::string();
      const std::string time = time_line("walls", watch_.lap());
      return time + note + thin_walls(least / metre_) + finished(wall_seconds());
    };
    const files::IsolatedResult result =
        files::do_isolated(work, wall_seconds(), [](const std::string& line) {
          if (!line.empty()) files::say_to_listener(line);
        });
    if (!result.is_complete || result.output.empty()) return std::nullopt;
    return result.output;
  }

  /// So that it cannot take many times what the part takes anyway.
  unsigned wall_seconds() const { return static_cast<unsigned>(kWallSeconds + 2 * first_seconds_); }

  std::string mesh_times() {
    const double whole = watch_.lap();
    first_seconds_ = whole;
    const auto [edges, faces, volumes] = gmsh_.mesh_seconds();
    const double surface = edges + faces;
    return time_line("surface", surface) + time_line("volume", std::max(0.0, whole - surface));
  }

  double diagonal() const {
    const auto box = gmsh_.box({-1, -1});
    return std::hypot(box[3] - box[0], box[4] - box[1], box[5] - box[2]);
  }

  std::string sew() {
    say_stage("mending");
    const bool was_open = !faults_.gap().empty();
    const std::size_t before = gmsh_.entities(2).size();
    const double tolerance = trial_.tolerance * diagonal();
    gmsh_.heal(tolerance);
    const std::string walls =
        gmsh_.entities(3).empty() ? leave_out_walls(tolerance) : std::string();
    return fmt::format(
               "note {}: {} faces became {}, gaps of up to {:.2g} mm were closed; faces are "
               "renumbered and have neither names nor colours\n",
               was_open ? "the surface was not closed and was sewn together"
                        : "the surface was mended",
               before, gmsh_.entities(2).size(), tolerance / metre_ * 1e3) +
           walls;
  }

  /// Rooms with a common wall are no solid: makes one of what encloses them.
  std::string leave_out_walls(double tolerance) {
    constexpr std::size_t kMostFaces = 300;  // which are cut with each other
    const auto faces = gmsh_.entities(2);
    if (faces.size() < 3 || faces.size() > kMostFaces) return {};
    // Sewing joins edges in pairs only: the third face at an edge keeps one of its own.
    gmsh_.fragment(faces);
    const std::vector<GmshEntity> walls = surface_faults(gmsh_).walls;
    if (walls.empty()) return {};
    const std::string first = faults_.place(walls.front());
    gmsh_.remove(walls);
    gmsh_.heal(tolerance);
    return fmt::format(
        "note walls without thickness inside the part were left out ({} faces, the first near {}), "
        "since the others enclose it\n",
        walls.size(), first);
  }

  /// Of plates of 0.1 m × 0.06 m with elements of 4 mm, second order: the four lowest frequencies
  /// are up to 2 % too high with a wall of an eighth of the size, 3 % with a twentieth, 6 % with a
  /// fortieth, 17 % with a hundredth.
  std::string thin_walls(double size) const {
    constexpr double kThin = 30;
    const double wall = 2 * part_.volume / part_.area;
    if (kThin * wall > size) return {};
    return fmt::format(
        "note walls are about {:.2g} mm thick, a {:.0f}th of the element size: the elements are "
        "flat, natural frequencies come out several per cent too high and stresses are inaccurate; "
        "give a smaller size, or mesh the part with shells\n",
        wall * 1e3, size / wall);
  }

  void measure() {
    part_.diagonal = diagonal() / metre_;
    for (const GmshEntity& solid : gmsh_.entities(3)) {
      part_.volume += std::abs(gmsh_.size(solid)) / std::pow(metre_, 3);
    }
    for (const GmshEntity& face : gmsh_.entities(2)) {
      part_.area += std::abs(gmsh_.size(face)) / std::pow(metre_, 2);
    }
  }

  void set_options(double size) {
    gmsh_.set_number("Mesh.MeshSizeMax", size);
    gmsh_.set_number("Mesh.MeshSizeMin", trial_.smallest * size);
    gmsh_.set_number("Mesh.MeshSizeFromCurvature", trial_.in_a_turn);
    gmsh_.set_number("Mesh.Algorithm", trial_.algorithm);
    gmsh_.set_number("Mesh.HighOrderPassMax", kPasses);
    gmsh_.set_number("Mesh.MaxNumThreads1D", 1);
    gmsh_.set_number("Mesh.MaxNumThreads2D", 1);
    gmsh_.set_number("Mesh.MaxNumThreads3D", 1);
    gmsh_.set_number("Mesh.Binary", 1);
    gmsh_.set_number("Mesh.MshFileVersion", 4.1);
    gmsh_.set_number("Mesh.SaveAll", 0);
    gmsh_.set_number("Mesh.ScalingFactor", 1 / metre_);
    // The mesher stops at an error but does not throw, which it cannot do from parallel loops.
    gmsh_.set_number("General.AbortOnError", 1);
  }

  /// Numbers of the solids of each name.
  using Labels = std::map<std::string, std::vector<int>>;

  Labels labels_of_solids() const {
    Labels out;
    for (const GmshEntity& solid : gmsh_.entities(3)) {
      out[label_of_solid(gmsh_, solid)].push_back(solid.second);
    }
    return out;
  }

  void add_groups(const Labels& solids) {
    for (const auto& [name, tags] : solids) gmsh_.add_group(3, tags, name);
    std::vector<int> faces;
    for (const GmshEntity& face : gmsh_.entities(2)) faces.push_back(face.second);
    gmsh_.add_group(2, std::move(faces), "faces");  // the file has the number of each
  }

  /// The first error says what happened, later ones are consequences.
  std::string failure() const {
    const auto said = gmsh_.messages();
    const auto error = std::find_if(said.begin(), said.end(), [](const std::string& line) {
      return line.starts_with("Error");
    });
    if (error == said.end()) return {};
    std::vector<std::string> places;
    for (const GmshEntity& entity : gmsh_.entities_at_fault()) {
      const char* kind = entity.first == 2 ? "face" : entity.first == 1 ? "curve" : "solid";
      places.push_back(fmt::format("{} {} around {}", kind, entity.second, faults_.place(entity)));
      if (places.size() == 4) break;
    }
    std::string out = "Gmsh: " + one_line(error->substr(error->find(':') + 2));
    if (trial_.in_millimetres) out += " (in mm)";
    if (!places.empty()) out += fmt::format("; {}", fmt::join(places, ", "));
    if (!glued_.overlap().empty()) {
      out += fmt::format(
          ". Solids overlap {}: slivers remain where they are cut. In the CAD program, leave out "
          "what is screwed or pressed into other parts, such as modelled threads, or make each "
          "solid a separate body by `solid` and join the bodies",
          glued_.overlap());
    }
    return out;
  }

  std::string messages() {
    constexpr std::size_t kShown = 3;
    const auto said = gmsh_.messages();
    std::string out;
    for (std::size_t k = 0; k < std::min(kShown, said.size()); ++k) {
      out += fmt::format("message {}\n", one_line(said[k]));
    }
    if (said.size() > kShown)
      out += fmt::format("message and {} more", said.size() - kShown) + '\n';
    return out;
  }

  /// Elements that stay inverted are straightened later: Gmsh's errors are ignored here.
  void curve() {
    say_stage("second order");
    gmsh_.set_number("General.AbortOnError", 0);
    gmsh_.set_order(2);
    gmsh_.write(task_.mesh);
    fem::ImportedMesh unmoved = read_gmsh_mesh(task_.mesh);
    if (fem::straighten_inverted(unmoved) > kMostMoved) return;
    gmsh_.optimize("HighOrder");
    const std::string moved = task_.mesh + ".moved.msh";
    gmsh_.write(moved);
    try {
      read_gmsh_mesh(moved);
    } catch (const InputError&) {
      return;  // nodes were moved to places that are no numbers
    }
    std::filesystem::rename(moved, task_.mesh);
  }

  GluedPart& glued_;
  const StepTask& task_;
  const StepTrial& trial_;
  double metre_;
  GmshLibrary& gmsh_;
  PartFaults faults_;
  base::Stopwatch watch_;
  double first_seconds_ = 0;  // for the mesh of first order
  Extent part_;
};

}  // namespace

std::string time_line(const char* what, double seconds) {
  return fmt::format("time {} {:.3f}\n", what, seconds);
}

std::string outcome_of(const std::exception& error) {
  const std::string text = one_line(error.what());
  const bool is_hopeless =
      text.starts_with("Could not read file") || text.find("library") != std::string::npos;
  return (is_hopeless ? "error " : "failed ") + text;
}

std::string mesh_in_trial(GluedPart& part, const StepTask& task, const StepTrial& trial) {
  try {
    return Trial(part, task, trial).run();
  } catch (const std::exception& error) {
    return outcome_of(error);
  }
}

}  // namespace buckens::mesh_io
