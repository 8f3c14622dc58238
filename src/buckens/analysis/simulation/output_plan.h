// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "buckens/model/build/build_model.h"
#include "buckens/results/channel.h"
#include "buckens/results/field_layout.h"

namespace buckens::analysis {

/// How often a simulation records, and the resulting counts.
struct OutputPlan {
  double every = 0;          ///< time between records [s]
  double finest = 0;         ///< the same, or the step if extremes follow each one [s]
  long fields_stride = 1;    ///< number of records per field record
  double records = 0;        ///< of the whole run
  double field_records = 0;  ///< of the whole run, 0 without fields

  /// Size of results.h5 [bytes], without the undeformed shape.
  double bytes(const results::RecordLayout& layout, const results::FieldLayout& fields) const;
};

/// @throws InputError if there are too many records, or the time between fields is not a multiple
/// of that between records
OutputPlan plan_output(const model::ModelDescription& description);

/// Advice if results.h5 becomes very large, otherwise empty.
std::string judge_size(double bytes);

/// "1.3 GB".
std::string size_text(double bytes);

}  // namespace buckens::analysis
