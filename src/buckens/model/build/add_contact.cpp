// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/add_contact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/loads/contact.h"
#include "buckens/loads/elastic_contact.h"
#include "buckens/model/build/contact_shapes.h"
#include "buckens/model/build/rigid_contact_rows.h"
#include "buckens/model/build/rigid_touches.h"
#include "buckens/spatial/principal_axes.h"

namespace buckens::model {

using Eigen::Vector3d;
using loads::ContactShape;
using ShapeKind = ContactShape::Kind;

namespace {

// Share of m L² below which a body has no rotary inertia.
constexpr double kNoRotaryInertia = 1e-12;
// Rounding of places, as a share of the smaller shape.
constexpr double kTouchingPlace = 1e-9;
// Overlap as placed that needs no exact places, as a share of the smaller shape.
constexpr double kDeepInside = 0.1;

class ContactBuilder {
 public:
  ContactBuilder(const loads::ContactSpec& spec, MarkerFinder& find, Load& load,
                 const SourceLocation& where)
      : spec_(spec),
        find_(find),
        load_(load),
        where_(where),
        what_(fmt::format("load \"{}\"", load.name)) {}

  std::vector<Load> build() {
    std::array<MarkerId, 2> markers = {find_.marker(spec_.between[0], true),
                                       find_.marker(spec_.between[1], true)};
    find_.require_two_bodies(markers[0], markers[1], what_, where_);
    std::array<ContactShape, 2> shapes;
    for (std::size_t k = 0; k < 2; ++k) {
      shapes[k] = contact_shape(spec_.shapes[k], find_, markers[k], what_, where_);
    }
    if (!loads::ContactPair::knows(shapes[0].kind, shapes[1].kind)) {
      std::swap(shapes[0], shapes[1]);
      std::swap(markers[0], markers[1]);
    }
    load_.first = markers[0];
    load_.second = markers[1];
    load_.shapes = std::make_shared<const std::array<ContactShape, 2>>(shapes);
    const loads::ContactPair pair(shapes[0], shapes[1]);
    require_place(pair);
    require_moments(pair);
    if (spec_.stiffness || spec_.modulus) {
      set_elastic(pair);
    } else {
      set_rigid(pair);
    }
    return std::move(behind_);
  }

 private:
  /// Forces that do not point at the marker turn it.
  void require_moments(const loads::ContactPair& pair) {
    const auto is_centred = [&](const ContactShape& shape) {
      return (shape.kind == ShapeKind::sphere || shape.kind == ShapeKind::socket) &&
             spec_.coefficient == 0.0;
    };
    if (!is_centred(pair.first())) find_.require_moment(load_.first, what_, where_);
    if (!is_centred(pair.second())) find_.require_moment(load_.second, what_, where_);
    const bool is_rigid = !spec_.stiffness && !spec_.modulus;
    const bool has_feet = is_rigid && touches(pair).size() > 1;
    if (spec_.coefficient == 0.0 && !has_feet) return;
    for (const MarkerId* id : {&load_.first, &load_.second}) require_inertia(*id);
  }

  void require_inertia(const MarkerId& id) {
    if (id.body == kGround) return;
    const auto b = static_cast<std::size_t>(id.body);
    const body::Body& body = find_.model().bodies[b];
    if (body.is_flexible()) return;
    double least = spatial::principal_axes(body.J0).values[0];
    if (find_.model().planar) {
      const Vector3d normal =
          find_.model().placed[b].R().transpose() * spatial::normal(*find_.model().planar);
      least = normal.dot(body.J0 * normal);
    }
    if (least > kNoRotaryInertia * body.mass * size_ * size_) return;
    throw ModelError(
        where_, fmt::format("{}: {} turns body \"{}\", which has no rotary "
                            "inertia; give it an `inertia`{}",
                            what_, spec_.coefficient > 0.0 ? "friction" : "the contact", body.name,
                            spec_.coefficient > 0.0 ? ", or leave out `static`" : ""));
  }

  /// As placed, the shapes are beside each other and in the same plane.
  void require_place(const loads::ContactPair& pair) {
    size_ = std::min(loads::size_of(pair.first()), loads::size_of(pair.second()));
    const joints::Placement placed = find_.placement(load_.first, load_.second);
    if (find_.model().planar && pair.first().kind != ShapeKind::plane &&
        pair.first().kind != ShapeKind::bore) {
      const double apart =
          std::abs(spatial::normal(*find_.model().planar).dot(placed.R_WF * placed.r_F));
      if (apart > kTouchingPlace * size_) {
        throw InputError(
            where_,
            fmt::format("{}: its shapes are {:.4g} m apart in the direction normal to the plane of "
                        "the model and would never meet; place their markers in one plane",
                        what_, apart));
      }
    }
    const bool is_elastic = spec_.stiffness || spec_.modulus;
    const double admitted = is_elastic ? size_ : kTouchingPlace * size_;
    const double gap = is_elastic ? gap_of_spots(pair, placed) : gap_of_touches(pair, placed);
    if (gap >= -admitted) return;
    throw InputError(
        where_,
        fmt::format("{}: the shapes overlap by {:.4g} m as placed{}; place them apart{}", what_,
                    -gap, is_elastic ? ", more than their size" : "",
                    pair.first().kind == ShapeKind::plane ? ", or turn the plane's normal" : ""));
  }

  static double gap_of_spots(const loads::ContactPair& pair, const joints::Placement& placed) {
    loads::ContactPair::Spots spots;
    pair.find(placed.r_F, placed.R_WF.transpose() * placed.R_WM, spots);
    double gap = HUGE_VAL;
    for (int k = 0; k < pair.num_spots(); ++k) {
      gap = std::min(gap, spots[static_cast<std::size_t>(k)].gap);
    }
    return gap;
  }

  /// Of the places, which are exact; deep inside each other, where these may be beside what
  /// overlaps, of the spots.
  double gap_of_touches(const loads::ContactPair& pair, const joints::Placement& placed) const {
    const double by_spots = gap_of_spots(pair, placed);
    if (by_spots < -kDeepInside * size_) return by_spots;
    return least_gap(touches(pair), placed);
  }

  double reduced_mass() const {
    double inverse = 0.0;
    for (const MarkerId* id : {&load_.first, &load_.second}) {
      if (id->body == kGround) continue;
      inverse += 1.0 / find_.model().bodies[static_cast<std::size_t>(id->body)].mass;
    }
    return 1.0 / inverse;
  }

  void set_elastic(const loads::ContactPair& pair) {
    loads::ElasticContactLaw law = loads::elastic_law(spec_);
    law.modulus = spec_.modulus;
    if (spec_.poisson) law.poisson = *spec_.poisson;
    load_.element = std::make_shared<loads::Contact>(
        pair, loads::contact_data(law, pair, reduced_mass(), find_.model().gravity.norm()),
        spec_.settings);
  }

  std::vector<spatial::RigidTouch> touches(const loads::ContactPair& pair) const {
    std::optional<Vector3d> normal;
    if (find_.model().planar) normal = spatial::normal(*find_.model().planar);
    return rigid_touches(pair, find_.placement(load_.first, load_.second), normal);
  }

  void set_rigid(const loads::ContactPair& pair) {
    RigidPairLaw law = rigid_pair_law(spec_);
    Load like = load_;
    like.shapes = nullptr;  // drawn once
    for (RigidContactRow& row : rigid_contact_rows(like, touches(pair), law, size_)) {
      row.load.coordinate = static_cast<int>(find_.model().coordinates.size());
      find_.model().coordinates.push_back(std::move(row.coordinate));
      behind_.push_back(std::move(row.load));
    }
    load_.coordinate = behind_.front().coordinate;
    load_.element = behind_.front().element;
    behind_.erase(behind_.begin());
  }

  const loads::ContactSpec& spec_;
  MarkerFinder& find_;
  Load& load_;
  const SourceLocation& where_;
  std::string what_;
  double size_ = 0;  // of the smaller shape [m]
  std::vector<Load> behind_;
};

}  // namespace

std::vector<Load> set_contact(const loads::ContactSpec& spec, MarkerFinder& find, Load& load,
                              const SourceLocation& where) {
  return ContactBuilder(spec, find, load, where).build();
}

}  // namespace buckens::model
