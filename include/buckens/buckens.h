// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The public interface of the library: what programs include, and all that is installed.
///
/// This list alone decides what is public: these headers and those that they include are installed.
/// See docs/developers/cpp.md and examples/cpp.

#include "buckens/analysis/simulation/simulation.h"
#include "buckens/base/errors.h"
#include "buckens/base/log.h"
#include "buckens/base/member_types.h"
#include "buckens/base/version.h"
#include "buckens/model/build/function_signals.h"
#include "buckens/model/builder.h"
#include "buckens/model_file/load_model.h"
#include "buckens/results/table.h"
#include "buckens/run_store/run_directory.h"
#include "buckens/run_store/run_reader.h"
#include "buckens/run_store/state_file.h"

namespace buckens {

using analysis::Simulation;
using analysis::SimulationOptions;
using analysis::StepView;
using model::BuiltModel;
using model::give_functions;
using model::ModelBuilder;
using model::SignalFunction;
using model_file::load_model;
using results::RunSummary;
using results::Table;
using run_store::read_state;
using run_store::RunDirectory;
using run_store::RunReader;
using run_store::write_state;

using base::Field;
using base::Member;
using base::member_of;

}  // namespace buckens
