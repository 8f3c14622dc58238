// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/spec/signal_spec.h"

namespace buckens::model {

SignalSpec::SignalSpec() = default;
SignalSpec::SignalSpec(const SignalSpec&) = default;
SignalSpec::SignalSpec(SignalSpec&&) noexcept = default;
SignalSpec& SignalSpec::operator=(const SignalSpec&) = default;
SignalSpec& SignalSpec::operator=(SignalSpec&&) noexcept = default;
SignalSpec::~SignalSpec() = default;

}  // namespace buckens::model
