// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

namespace buckens::python {

/// Tables of variants, their groups, and the runs of a worker, on which buckens.sweep and
/// buckens.study are based.
void define_studies(pybind11::module_& core);

}  // namespace buckens::python
