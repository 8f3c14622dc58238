// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

namespace buckens::python {

/// Tables of variants, their groups, and the runs of a worker: what buckens.sweep and buckens.study
/// are made of.
void define_studies(pybind11::module_& core);

}  // namespace buckens::python
