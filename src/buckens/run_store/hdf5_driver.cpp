// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/hdf5_driver.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <mutex>
#include <new>
#include <vector>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "buckens/files/output_file.h"

namespace buckens::run_store {

namespace {

/// What the property list of a file hands on to the driver.
struct DriverSettings {
  files::WriteProcess* writer;  // null: this process
  Hdf5WriteFault* fault;        // null: the file is read
  Hdf5Undo* undo;
  const Undone* undone;
};

/// An open file. HDF5 knows it by its first member.
struct DriverFile {
  H5FD_t base;
  int descriptor;
  haddr_t allocated;  // HDF5: eoa
  haddr_t end;        // HDF5: eof
  files::WriteProcess* writer;
  Hdf5WriteFault* fault;
  Hdf5Undo* undo;
  std::vector<FileBytes> held;  // writes that wait, or did not reach the disk
};

DriverFile& file_of(H5FD_t* base) { return *reinterpret_cast<DriverFile*>(base); }
const DriverFile& file_of(const H5FD_t* base) { return *reinterpret_cast<const DriverFile*>(base); }

/// @return 0 or the error number
int write_bytes(const DriverFile& file, haddr_t address, const std::uint8_t* bytes,
                std::size_t size) {
  if (file.writer != nullptr) return file.writer->write(address, bytes, size);
  while (size > 0) {
    const ssize_t count = ::pwrite(file.descriptor, bytes, size, static_cast<off_t>(address));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    address += static_cast<haddr_t>(count);
    bytes += count;
    size -= static_cast<std::size_t>(count);
  }
  return 0;
}

void end_writing(DriverFile& file, int error) {
  if (!file.fault->ended) file.fault->error = error;
  file.fault->ended = true;
}

/// Passes on what waits, once what it overwrites is on the disk.
void commit(DriverFile& file) {
  if (file.undo == nullptr || file.fault->ended || file.held.empty()) return;
  int error = file.undo->sync();
  for (std::size_t k = 0; k < file.held.size() && error == 0; ++k) {
    const FileBytes& write = file.held[k];
    error = write_bytes(file, write.address, write.bytes.data(), write.bytes.size());
  }
  if (error != 0) return end_writing(file, error);
  file.held.clear();
}

H5FD_t* open_undone(const char* name, const Undone& undone) {
  const int descriptor = ::open(name, O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return nullptr;
  auto* file = new (std::nothrow)
      DriverFile{{}, descriptor, 0, undone.length, nullptr, nullptr, nullptr, undone.before};
  if (file == nullptr) ::close(descriptor);
  return file == nullptr ? nullptr : &file->base;
}

H5FD_t* open_file(const char* name, unsigned, hid_t access, haddr_t) {
  const DriverSettings settings = *static_cast<const DriverSettings*>(H5Pget_driver_info(access));
  if (settings.undone != nullptr) return open_undone(name, *settings.undone);
  const int descriptor = files::open_anew(name, O_RDWR);
  if (descriptor < 0) {
    settings.fault->error = errno;
    return nullptr;
  }
  if (settings.writer != nullptr) settings.fault->error = settings.writer->take_file(descriptor);
  auto* file = settings.fault->error != 0
                   ? nullptr
                   : new (std::nothrow) DriverFile{
                         {}, descriptor, 0, 0, settings.writer, settings.fault, settings.undo, {}};
  if (file == nullptr) {
    ::close(descriptor);
    return nullptr;
  }
  if (settings.undo != nullptr) settings.fault->commit = [file] { commit(*file); };
  return &file->base;
}

herr_t close_file(H5FD_t* base) {
  DriverFile& file = file_of(base);
  commit(file);
  if (file.fault != nullptr) file.fault->commit = nullptr;
  if (::close(file.descriptor) != 0 && errno != EINTR && file.fault != nullptr) {
    end_writing(file, errno);
  }
  delete &file;
  return 0;
}

int compare(const H5FD_t* first, const H5FD_t* second) {
  struct stat a {
  }, b{};
  if (::fstat(file_of(first).descriptor, &a) != 0) return -1;
  if (::fstat(file_of(second).descriptor, &b) != 0) return 1;
  if (a.st_dev != b.st_dev) return a.st_dev < b.st_dev ? -1 : 1;
  if (a.st_ino != b.st_ino) return a.st_ino < b.st_ino ? -1 : 1;
  return 0;
}

herr_t query(const H5FD_t*, unsigned long* flags) {
  *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
           H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_SUPPORTS_SWMR_IO |
           H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
  return 0;
}

haddr_t get_allocated(const H5FD_t* base, H5FD_mem_t) { return file_of(base).allocated; }

herr_t set_allocated(H5FD_t* base, H5FD_mem_t, haddr_t address) {
  file_of(base).allocated = address;
  return 0;
}

haddr_t get_end(const H5FD_t* base, H5FD_mem_t) { return file_of(base).end; }

herr_t read_file(H5FD_t* base, H5FD_mem_t, hid_t, haddr_t address, std::size_t size, void* buffer) {
  DriverFile& file = file_of(base);
  auto* bytes = static_cast<std::uint8_t*>(buffer);
  const std::size_t wanted = size;
  std::size_t done = 0;
  if (file.fault == nullptr && address + size > file.end) {
    // What came after the checkpoint is not there.
    size = address < file.end ? static_cast<std::size_t>(file.end - address) : 0;
    std::memset(bytes + size, 0, wanted - size);
  }
  while (done < size) {
    const ssize_t count =
        ::pread(file.descriptor, bytes + done, size - done, static_cast<off_t>(address + done));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return -1;
    if (count == 0) break;
    done += static_cast<std::size_t>(count);
  }
  std::memset(bytes + done, 0, size - done);  // beyond the end of the file
  for (const FileBytes& write : file.held) {
    const haddr_t from = std::max(address, write.address);
    const haddr_t to = std::min(address + size, write.address + write.bytes.size());
    if (from < to) {
      std::memcpy(bytes + (from - address), write.bytes.data() + (from - write.address), to - from);
    }
  }
  return 0;
}

herr_t write_file(H5FD_t* base, H5FD_mem_t kind, hid_t, haddr_t address, std::size_t size,
                  const void* buffer) {
  DriverFile& file = file_of(base);
  const auto* bytes = static_cast<const std::uint8_t*>(buffer);
  file.end = std::max<haddr_t>(file.end, address + size);
  bool waits = false;
  if (!file.fault->ended && file.undo != nullptr) {
    // Where rows are added to a chunk, those before them stay as they are.
    const int error = kind == H5FD_MEM_DRAW ? 0 : file.undo->keep(file.descriptor, address, size);
    if (error != 0) end_writing(file, error);
    waits = file.undo->is_waiting();
  }
  if (!file.fault->ended && !waits) {
    const int error = write_bytes(file, address, bytes, size);
    if (error != 0) end_writing(file, error);
  }
  if (file.fault->ended || waits) {
    try {
      file.held.push_back({address, {bytes, bytes + size}});
    } catch (const std::bad_alloc&) {
      return -1;
    }
  }
  return 0;
}

herr_t flush_file(H5FD_t* base, hid_t, hbool_t) {
  commit(file_of(base));
  return 0;
}

herr_t truncate_file(H5FD_t* base, hid_t, hbool_t) {
  DriverFile& file = file_of(base);
  if (file.fault == nullptr) return 0;
  commit(file);
  if (file.allocated == file.end) return 0;
  if (!file.fault->ended && ::ftruncate(file.descriptor, static_cast<off_t>(file.allocated)) != 0) {
    end_writing(file, errno);
  }
  file.end = file.allocated;
  return 0;
}

/// Keeps others from opening the file before readers are welcome. HDF5 marks files as being written
/// only for drivers that can lock; file systems without locks do without.
herr_t lock_file(H5FD_t* base, hbool_t) {
  const bool taken =
      ::flock(file_of(base).descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  return taken ? -1 : 0;
}

herr_t unlock_file(H5FD_t* base) {
  ::flock(file_of(base).descriptor, LOCK_UN);
  return 0;
}

H5FD_class_t driver_class() {
  H5FD_class_t driver{};
  driver.name = "buckens";
  driver.maxaddr = (haddr_t{1} << 62U) - 1;
  driver.fc_degree = H5F_CLOSE_WEAK;
  driver.fapl_size = sizeof(DriverSettings);
  driver.open = open_file;
  driver.close = close_file;
  driver.cmp = compare;
  driver.query = query;
  driver.get_eoa = get_allocated;
  driver.set_eoa = set_allocated;
  driver.get_eof = get_end;
  driver.read = read_file;
  driver.write = write_file;
  driver.flush = flush_file;
  driver.truncate = truncate_file;
  driver.lock = lock_file;
  driver.unlock = unlock_file;
  const H5FD_mem_t map[] = H5FD_FLMAP_DICHOTOMY;
  std::copy(std::begin(map), std::end(map), std::begin(driver.fl_map));
  return driver;
}

/// Registered once; again if somebody has closed the HDF5 library in between.
hid_t driver_id() {
  static std::mutex mutex;
  static const H5FD_class_t driver = driver_class();
  static hid_t id = H5I_INVALID_HID;
  const std::lock_guard lock(mutex);
  if (id < 0 || H5Iis_valid(id) <= 0) id = H5FDregister(&driver);
  return id;
}

}  // namespace

bool set_write_driver(hid_t access, files::WriteProcess& writer, Hdf5WriteFault& fault,
                      Hdf5Undo* undo) {
  const hid_t id = driver_id();
  const DriverSettings settings{&writer, &fault, undo, nullptr};
  return id >= 0 && H5Pset_driver(access, id, &settings) >= 0;
}

bool set_plain_driver(hid_t access, Hdf5WriteFault& fault) {
  const hid_t id = driver_id();
  const DriverSettings settings{nullptr, &fault, nullptr, nullptr};
  return id >= 0 && H5Pset_driver(access, id, &settings) >= 0;
}

bool set_undone_driver(hid_t access, const Undone& undone) {
  const hid_t id = driver_id();
  const DriverSettings settings{nullptr, nullptr, nullptr, &undone};
  return id >= 0 && H5Pset_driver(access, id, &settings) >= 0;
}

}  // namespace buckens::run_store
