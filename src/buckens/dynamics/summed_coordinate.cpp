// SPDX-License-Identifier: Apache-2.0
#include "buckens/dynamics/summed_coordinate.h"

namespace buckens::dynamics {

namespace {

const model::Joint& owner_of(const model::Model& model, const model::CoupledCoordinate& coupled) {
  const auto index = static_cast<std::size_t>(coupled.coordinate);
  return model.joints[static_cast<std::size_t>(model.coordinates[index].joint)];
}

}  // namespace

SummedCoordinate::SummedCoordinate(const model::Model& model,
                                   const model::CoupledCoordinate& coupled,
                                   const std::vector<BodyMotion>& motions, double t,
                                   const model::RowMemory* memory)
    : model_(model),
      coupled_(coupled),
      coordinate_(model.coordinates[static_cast<std::size_t>(coupled.coordinate)]),
      owner_(owner_of(model, coupled)),
      motions_(motions),
      before_(before_of(memory, static_cast<std::size_t>(coupled.coordinate))) {
  if (owner_.track) {
    travel_.emplace(model, owner_, motions, memory);
    value_ = {0, travel_->displacement()};
    rate_ = travel_->rate();
  } else {
    first_ = evaluate_marker(model, owner_.first, motions);
    second_ = evaluate_marker(model, owner_.second, motions);
    const spatial::MarkerMotion& F = first_.motion;
    const spatial::MarkerMotion& M = second_.motion;
    value_ =
        counted_coordinate(model, static_cast<std::size_t>(coupled.coordinate), t, memory, F, M);
    J_ = coordinate_.law.derivatives(F, M, before_);
    rate_ = J_.segment<3>(0).dot(F.w) + J_.segment<3>(3).dot(F.v) + J_.segment<3>(6).dot(M.w) +
            J_.segment<3>(9).dot(M.v);
  }
  slope_ = coupled.term.slope(value_.value());
}

double SummedCoordinate::bias() const {
  const double own =
      travel_ ? travel_->coordinate_bias()
              : coordinate_.law.bias(first_.motion, second_.motion,
                                     evaluate_bias(model_, owner_.first, motions_),
                                     evaluate_bias(model_, owner_.second, motions_), before_);
  return slope_ * own + coupled_.term.curvature(value_.value()) * rate_ * rate_;
}

void SummedCoordinate::derive(SystemRow& out, std::size_t& next) const {
  if (!travel_) {
    const SystemRow own =
        system_row(model_, owner_.first, first_, owner_.second, second_, slope_ * J_);
    out.part(next++) = own.first;
    out.part(next++) = own.second;
    return;
  }
  thread_local SystemRow own;  // keeps its room
  travel_->derive({0.0, 0.0, slope_ * travel_->along()}, 0, own);
  for (const BodyRow* part : own.parts()) out.part(next++) = *part;
}

void SummedCoordinate::add_forces(double multiplier, Forces& out) const {
  travel_->add_force(multiplier * slope_ * travel_->along(), out);
}

JointWrenches SummedCoordinate::wrenches(double multiplier) const {
  JointWrenches out;
  if (travel_) {
    out.on_second.force = multiplier * slope_ * travel_->along();
    return out;
  }
  const spatial::PairRow f = multiplier * slope_ * J_;
  out.on_first = {f.segment<3>(0).transpose(), f.segment<3>(3).transpose()};
  out.on_second = {f.segment<3>(6).transpose(), f.segment<3>(9).transpose()};
  return out;
}

void size_coupler_row(const model::Model& model, const model::Joint& coupler, SystemRow& out) {
  std::size_t count = 0;
  out.travelling = -1;
  for (const model::CoupledCoordinate& coupled : coupler.coupled) {
    const model::Joint& owner = owner_of(model, coupled);
    count += owner.track ? Travel::num_parts(owner) : 2;
    if (owner.track) out.travelling = coupler.first_row;
  }
  out.more.resize(count - 2);
}

}  // namespace buckens::dynamics
