// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/hdf5_sealed_driver.h"

#include <algorithm>
#include <iterator>
#include <mutex>
#include <new>

namespace buckens::run_store {

namespace {

/// What the property list hands on.
struct SealedSettings {
  const SealedFile* file;
};

/// An open file. HDF5 knows it by its first member.
struct SealedContent {
  H5FD_t base;
  const SealedFile* file;
  haddr_t allocated;  // HDF5: eoa
};

SealedContent& content_of(H5FD_t* base) { return *reinterpret_cast<SealedContent*>(base); }
const SealedContent& content_of(const H5FD_t* base) {
  return *reinterpret_cast<const SealedContent*>(base);
}

H5FD_t* open_content(const char*, unsigned flags, hid_t access, haddr_t) {
  if ((flags & H5F_ACC_RDWR) != 0) return nullptr;
  const auto* settings = static_cast<const SealedSettings*>(H5Pget_driver_info(access));
  if (settings == nullptr) return nullptr;
  auto* content = new (std::nothrow) SealedContent{{}, settings->file, 0};
  return content == nullptr ? nullptr : &content->base;
}

herr_t close_content(H5FD_t* base) {
  delete &content_of(base);
  return 0;
}

herr_t query_content(const H5FD_t*, unsigned long* flags) {
  *flags = H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE;
  return 0;
}

haddr_t allocated_content(const H5FD_t* base, H5FD_mem_t) { return content_of(base).allocated; }

herr_t set_allocated_content(H5FD_t* base, H5FD_mem_t, haddr_t address) {
  content_of(base).allocated = address;
  return 0;
}

haddr_t end_of_content(const H5FD_t* base, H5FD_mem_t) { return content_of(base).file->size(); }

herr_t read_content(H5FD_t* base, H5FD_mem_t, hid_t, haddr_t address, std::size_t size,
                    void* buffer) {
  return content_of(base).file->read(address, size, buffer) ? 0 : -1;
}

herr_t refuse_to_write(H5FD_t*, H5FD_mem_t, hid_t, haddr_t, std::size_t, const void*) { return -1; }

H5FD_class_t sealed_driver_class() {
  H5FD_class_t driver{};
  driver.name = "buckens_sealed";
  driver.maxaddr = (haddr_t{1} << 62U) - 1;
  driver.fc_degree = H5F_CLOSE_WEAK;
  driver.fapl_size = sizeof(SealedSettings);
  driver.open = open_content;
  driver.close = close_content;
  driver.query = query_content;
  driver.get_eoa = allocated_content;
  driver.set_eoa = set_allocated_content;
  driver.get_eof = end_of_content;
  driver.read = read_content;
  driver.write = refuse_to_write;
  const H5FD_mem_t map[] = H5FD_FLMAP_DICHOTOMY;
  std::copy(std::begin(map), std::end(map), std::begin(driver.fl_map));
  return driver;
}

/// Registered once; again if somebody has closed the HDF5 library in between.
hid_t sealed_driver_id() {
  static std::mutex mutex;
  static const H5FD_class_t driver = sealed_driver_class();
  static hid_t id = H5I_INVALID_HID;
  const std::lock_guard lock(mutex);
  if (id < 0 || H5Iis_valid(id) <= 0) id = H5FDregister(&driver);
  return id;
}

}  // namespace

bool set_sealed_driver(hid_t access, const SealedFile& file) {
  const hid_t id = sealed_driver_id();
  const SealedSettings settings{&file};
  return id >= 0 && H5Pset_driver(access, id, &settings) >= 0;
}

}  // namespace buckens::run_store
