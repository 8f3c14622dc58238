// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <hdf5.h>

#include "buckens/files/write_process.h"

namespace buckens::run_store {

/// What the file driver for writing reports to the owner of the file.
struct Hdf5WriteFault {
  int error = 0;       ///< errno of the first failed operation on the file; 0: none failed
  bool ended = false;  ///< true: nothing reaches the disk any more; can also be set from outside
};

/// Makes files be written through a driver of our own, which never tells HDF5 of a failed write.
///
/// HDF5 1.10 does not get over a write that fails: it keeps the unwritten parts, cannot close the
/// file, and crashes at the end of the process. This driver keeps the reason for its owner instead
/// and holds that write and all later ones in memory, so that HDF5 carries on undisturbed until the
/// owner closes the file. On disk stays what was there: as if the program had been killed at the
/// failed write, which files in SWMR mode are made for.
///
/// All writes are carried out by a second process, so that SIGKILL tears none of them: a reader
/// that meets half an object of HDF5's own bookkeeping waits for a writer that is gone.
/// @param access  file access property list
/// @param writer  carries out the writes; must outlive the file
/// @param fault   must outlive the file
/// @return false if HDF5 refuses
bool set_write_driver(hid_t access, files::WriteProcess& writer, Hdf5WriteFault& fault);

}  // namespace buckens::run_store
