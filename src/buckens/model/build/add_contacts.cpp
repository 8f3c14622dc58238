// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/add_contacts.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fnmatch.h>

#include "buckens/base/errors.h"
#include "buckens/base/nearest.h"
#include "buckens/loads/many_contacts.h"
#include "buckens/loads/near_pairs.h"
#include "buckens/model/build/contact_shapes.h"
#include "buckens/model/build/rigid_contact_rows.h"
#include "buckens/model/build/rigid_pairs.h"
#include "buckens/model/contact_group.h"
#include "buckens/spatial/principal_axes.h"

namespace buckens::model {

using Eigen::Vector3d;
using loads::ContactShape;

namespace {

// Rounding of places, as a share of the smaller shape.
constexpr double kOutOfOnePlane = 1e-9;
// Overlap of rigid contacts that is rounding, and one that needs no exact places, likewise.
constexpr double kTouchingRigidly = 1e-9;
constexpr double kDeepBelow = 0.1;
// Share of m r² below which a body has no rotary inertia.
constexpr double kNoTurningInertia = 1e-12;

class GroupBuilder {
 public:
  GroupBuilder(const loads::ContactsSpec& spec, MarkerFinder& find, const Load& load,
               const SourceLocation& where)
      : spec_(spec),
        find_(find),
        where_(where),
        what_(fmt::format("load \"{}\"", load.name)),
        group_(std::make_shared<ContactGroup>()) {}

  std::shared_ptr<const ContactGroup> build() {
    group_->load = find_.model().loads.size();
    group_->gravity = find_.model().gravity.norm();
    if (spec_.stiffness || spec_.modulus) {
      group_->law = loads::elastic_law(spec_);
      group_->settings = spec_.settings;
    } else {
      group_->rigid = rigid_pair_law(spec_);
    }
    if (spec_.modulus) {
      const double poisson = spec_.poisson.value_or(group_->law.poisson[0]);
      group_->law.modulus = {*spec_.modulus, *spec_.modulus};
      group_->law.poisson = {poisson, poisson};
    }
    group_->has_two_lists = !spec_.against.empty();
    for (const loads::ContactMemberSpec& member : spec_.among) add(member, false);
    for (const loads::ContactMemberSpec& member : spec_.against) add(member, true);
    for (const Joint& joint : find_.model().joints) {
      if (joint.first.body == kGround || joint.second.body == kGround) continue;
      group_->joined.push_back(std::minmax(joint.first.body, joint.second.body));
    }
    std::sort(group_->joined.begin(), group_->joined.end());
    require_one_plane();
    require_places();
    return group_;
  }

 private:
  void add(const loads::ContactMemberSpec& member, bool is_against) {
    if (member.bodies.empty()) return add(member, member.on, is_against);
    for (const std::string& pattern : member.bodies) {
      bool has_any = false;
      for (const WholeBody& whole : find_.model().wholes) {
        if (fnmatch(pattern.c_str(), whole.name.c_str(), 0) != 0) continue;
        has_any = true;
        base::MarkerRef ref;
        ref.body = ref.text = whole.name;
        ref.where = member.where;
        add(member, ref, is_against);
      }
      if (has_any) continue;
      std::vector<std::string> names;
      for (const WholeBody& whole : find_.model().wholes) names.push_back(whole.name);
      throw InputError(member.where, fmt::format("{}: there is no body \"{}\".{}", what_, pattern,
                                                 base::suggestion(pattern, names)));
    }
  }

  void add(const loads::ContactMemberSpec& spec, const base::MarkerRef& on, bool is_against) {
    ContactMember member;
    member.marker = find_.marker(on, true);
    member.shape = contact_shape(spec.shape, find_, member.marker, what_, spec.where);
    member.is_against = is_against;
    if (member.marker.body != kGround) {
      const body::Body& body = find_.model().bodies[static_cast<std::size_t>(member.marker.body)];
      member.inverse_mass = 1.0 / body.mass;
      if (body.is_flexible()) {
        const bool is_centred = member.shape.kind == ContactShape::Kind::sphere;
        if (!is_centred || spec_.coefficient > 0.0) {
          find_.require_moment(member.marker, what_, spec.where);
        }
      } else {
        require_inertia(member, body, spec.where);
      }
    }
    group_->members.push_back(std::move(member));
  }

  /// Whatever does not push at a mass centre turns the body.
  void require_inertia(const ContactMember& member, const body::Body& body,
                       const SourceLocation& where) const {
    const bool is_centred = member.shape.kind == ContactShape::Kind::sphere &&
                            spec_.coefficient == 0.0 && on_centre(member.marker);
    if (is_centred) return;
    double least = spatial::principal_axes(body.J0).values[0];
    if (find_.model().planar) {
      const Vector3d normal =
          find_.model().placed[static_cast<std::size_t>(member.marker.body)].R().transpose() *
          spatial::normal(*find_.model().planar);
      least = normal.dot(body.J0 * normal);
    }
    const double size =
        std::isinf(loads::size_of(member.shape)) ? 0.0 : loads::size_of(member.shape);
    if (least > kNoTurningInertia * body.mass * size * size) return;
    throw ModelError(where, fmt::format("{}: the contact turns body \"{}\", which has no rotary "
                                        "inertia; give it an `inertia`",
                                        what_, body.name));
  }

  bool on_centre(const MarkerId& id) const {
    const body::Body& body = find_.model().bodies[static_cast<std::size_t>(id.body)];
    return body.markers[static_cast<std::size_t>(id.marker)].X_BF.p.isZero(0.0);
  }

  /// Sections of planar models lie in one plane, or would never meet.
  void require_one_plane() const {
    if (!find_.model().planar) return;
    const Vector3d normal = spatial::normal(*find_.model().planar);
    const ContactMember* first = nullptr;
    for (const ContactMember& member : group_->members) {
      const bool is_endless = member.shape.kind == ContactShape::Kind::plane ||
                              member.shape.kind == ContactShape::Kind::bore;
      if (is_endless) continue;
      if (first == nullptr) first = &member;
      const double apart =
          std::abs(normal.dot(find_.placed(member.marker).p - find_.placed(first->marker).p));
      if (apart <= kOutOfOnePlane * loads::size_of(member.shape)) continue;
      throw InputError(
          where_, fmt::format("{}: {} and {} are {:.4g} m apart in the direction normal to the "
                              "plane of the model and would never meet; place them in one plane",
                              what_, first->marker.text, member.marker.text, apart));
    }
  }

  void require_places() const {
    std::vector<Eigen::AlignedBox3d> boxes;
    std::vector<spatial::MarkerMotion> at;
    for (const ContactMember& member : group_->members) {
      const spatial::Pose X = find_.placed(member.marker);
      at.push_back({X.p, X.R(), Vector3d::Zero(), Vector3d::Zero()});
      boxes.push_back(loads::bounding_box(member.shape, at.back()));
    }
    std::vector<std::pair<int, int>> pairs;
    loads::find_overlapping(boxes, pairs);
    for (const auto& [a, b] : pairs) {
      const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
      if (!group_->can_touch(i, j)) continue;
      const auto [first, second] = group_->ordered(i, j);
      require_place(group_->members[first], at[first], group_->members[second], at[second]);
    }
  }

  void require_place(const ContactMember& first, const spatial::MarkerMotion& X,
                     const ContactMember& second, const spatial::MarkerMotion& Y) const {
    const double size = std::min(loads::size_of(first.shape), loads::size_of(second.shape));
    const double admitted = group_->rigid ? kTouchingRigidly * size : size;
    const loads::ContactPair pair(first.shape, second.shape);
    loads::ContactPair::Spots spots;
    pair.find(X.R.transpose() * (Y.p - X.p), X.R.transpose() * Y.R, spots);
    for (int k = 0; k < pair.num_spots(); ++k) {
      double gap = spots[static_cast<std::size_t>(k)].gap;
      if (gap >= -admitted) continue;
      // Spots may be beside what touches: rigid contacts have exact places, unless deep inside.
      if (group_->rigid && gap >= -kDeepBelow * size) {
        gap = least_gap(touches_of(find_.model(), first, second),
                        find_.placement(first.marker, second.marker));
        if (gap >= -admitted) return;
      }
      throw InputError(
          where_,
          fmt::format(
              "{}: {} and {} overlap by {:.4g} m as placed{}; place them apart{}", what_,
              first.marker.text, second.marker.text, -gap,
              group_->rigid ? "" : ", more than their size",
              first.shape.kind == ContactShape::Kind::plane ? ", or turn the plane's normal" : ""));
    }
  }

  const loads::ContactsSpec& spec_;
  MarkerFinder& find_;
  const SourceLocation& where_;
  std::string what_;
  std::shared_ptr<ContactGroup> group_;
};

}  // namespace

void set_contacts(const loads::ContactsSpec& spec, MarkerFinder& find, Load& load,
                  const SourceLocation& where) {
  load.element = std::make_shared<loads::ManyContacts>();
  find.model().contact_groups.push_back(GroupBuilder(spec, find, load, where).build());
}

}  // namespace buckens::model
