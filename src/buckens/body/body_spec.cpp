// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/body_spec.h"

namespace buckens::body {

BodySpec::BodySpec() = default;
BodySpec::BodySpec(const BodySpec&) = default;
BodySpec::BodySpec(BodySpec&&) noexcept = default;
BodySpec& BodySpec::operator=(const BodySpec&) = default;
BodySpec& BodySpec::operator=(BodySpec&&) noexcept = default;
BodySpec::~BodySpec() = default;

}  // namespace buckens::body
