// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/base/marker_ref.h"
#include "buckens/model/check/finding.h"
#include "buckens/model/spec/model_description.h"
#include "buckens/model_file/values.h"

namespace buckens::model_file {

/// @throws InputError naming the nearest known key if the map at `place` has a key not in `known`
void check_keys(const ReadPlace& place, const std::vector<std::string_view>& known);

/// Names become parts of paths and column titles: letters, digits, _ and - only.
void check_name(const YamlEntry& entry, const std::string& path);

/// `unknown <kind> "<name>". Did you mean ...?`
[[noreturn]] void fail_unknown(const ReadPlace& place, std::string_view kind,
                               const std::string& name, const std::vector<std::string>& known);

/// Reads "body/marker" or {ground: [x, y, z]} and checks that body and marker exist.
base::MarkerRef read_marker(const ReadPlace& place, const ReadContext& context);

/// Reads `chord`, `frame` or a marker.
model::DeflectionBase read_deflection_base(const ReadPlace& place, const ReadContext& context);

/// Throws a finding in the spec read from `place`.
/// @throws InputError with the place of the field in the file
void fail_if_found(const model::Found& found, const ReadPlace& place);

// To be called when a named entry has been read: makes parameters known to expressions, and gives
// bodies what they are `like`.
void finish_entry(model::ParameterSpec& parameter, const ReadPlace& place, ReadContext& context);
void finish_entry(body::BodySpec& body, const ReadPlace& place, ReadContext& context);
void finish_entry(loads::LoadSpec& load, const ReadPlace& place, ReadContext& context);
void finish_entry(model::InitialBodySpec& initial, const ReadPlace& place, ReadContext& context);

}  // namespace buckens::model_file
