// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>

#include <hdf5.h>

#include "buckens/files/write_process.h"
#include "buckens/run_store/hdf5_undo.h"

namespace buckens::run_store {

/// Report of the writing file driver to the owner of the file.
struct Hdf5WriteFault {
  int error = 0;       ///< errno of the first failed operation on the file; 0: none failed
  bool ended = false;  ///< true: nothing more reaches the disk; can also be set from outside
  /// Passes on writes that wait until what they overwrite is kept (Hdf5Undo).
  std::function<void()> commit;
};

/// Writes files through our own driver, which never reports a failed write to HDF5.
///
/// HDF5 1.10 does not recover from a failed write: it keeps the unwritten parts, cannot close the
/// file, and crashes at the end of the process. This driver keeps the reason for its owner instead
/// and holds that write and all later ones in memory, so that HDF5 carries on undisturbed until the
/// owner closes the file. The disk keeps what was there, as if the program had been killed at the
/// failed write, for which files in SWMR mode are designed.
///
/// All writes are done by a second process, so that SIGKILL does not tear them: a reader that finds
/// half an object of HDF5's own bookkeeping waits for a writer that is gone.
/// @param access  file access property list
/// @param writer  carries out the writes; must outlive the file
/// @param fault   must outlive the file
/// @param undo    keeps what is overwritten; must outlive the file; may be null
/// @return false if HDF5 refuses
bool set_write_driver(hid_t access, files::WriteProcess& writer, Hdf5WriteFault& fault,
                      Hdf5Undo* undo);

/// Writes a file of this process alone in the same way, but by this process, for files that take
/// another name once they are complete.
bool set_plain_driver(hid_t access, Hdf5WriteFault& fault);

/// Reads a file as it was at a checkpoint. @param undone must outlive the file
/// @return false if HDF5 refuses
bool set_undone_driver(hid_t access, const Undone& undone);

}  // namespace buckens::run_store
