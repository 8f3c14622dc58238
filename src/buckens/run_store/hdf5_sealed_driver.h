// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <hdf5.h>

#include "buckens/run_store/sealed_file.h"

namespace buckens::run_store {

/// HDF5 reads the content of this file through it, whatever name it opens. It locks nothing: a file
/// that has been found sound is not written to any more, and may be read by many.
/// @param access file access property list
/// @param file   must outlive what is opened
/// @return false if HDF5 refuses
bool set_sealed_driver(hid_t access, const SealedFile& file);

}  // namespace buckens::run_store
