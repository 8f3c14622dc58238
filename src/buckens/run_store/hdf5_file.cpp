// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/hdf5_file.h"

#include <string_view>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "buckens/base/errors.h"
#include "buckens/files/output_file.h"

namespace buckens::run_store {

namespace {

/// How often HDF5 looks again at bookkeeping whose check sum is wrong, because another process may
/// be about to write it. The pause begins with a nanosecond and doubles each time: with its own
/// choice of 100 a damaged file would keep it for centuries, this is less than a tenth of a second.
constexpr unsigned kReadAttempts = 25;

/// Called for each entry of the error stack, innermost first; keeps the best explanation.
herr_t take_reason(unsigned, const H5E_error2_t* entry, void* argument) {
  auto& reason = *static_cast<std::string*>(argument);
  const std::string_view text = entry->desc != nullptr ? entry->desc : "";
  constexpr std::string_view kMark = "error message = '";
  const std::size_t mark = text.find(kMark);
  if (mark != text.npos) {
    const std::string_view rest = text.substr(mark + kMark.size());
    reason = rest.substr(0, rest.find('\''));
    return 1;  // what the system says ends the search
  }
  if (reason.empty()) reason = text;
  return 0;
}

/// Keeps all bookkeeping of the file in memory: where it has to make room while others may read,
/// HDF5 1.10 uses blocks that it has freed (a run of 1000 bodies ended in "corrupted double-linked
/// list"). Per data set this is some 5 kB.
void keep_bookkeeping(hid_t access) {
  H5AC_cache_config_t cache = {};
  cache.version = H5AC__CURR_CACHE_CONFIG_VERSION;
  if (H5Pget_mdc_config(access, &cache) < 0) return;
  cache.incr_mode = H5C_incr__off;
  cache.flash_incr_mode = H5C_flash_incr__off;
  cache.decr_mode = H5C_decr__off;
  cache.evictions_enabled = false;
  H5Pset_mdc_config(access, &cache);
}

/// Settings of access: the newest format, which SWMR needs, and locks where the file system has
/// them.
Hdf5Handle access_settings() {
  Hdf5Handle settings(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_libver_bounds(settings.get(), H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
#if H5_VERSION_GE(1, 10, 7)
  H5Pset_file_locking(settings.get(), true, true);
#endif
  return settings;
}

}  // namespace

Hdf5Handle::Hdf5Handle(Hdf5Handle&& other) noexcept
    : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}

Hdf5Handle& Hdf5Handle::operator=(Hdf5Handle&& other) noexcept {
  if (this != &other) {
    reset();
    id_ = std::exchange(other.id_, H5I_INVALID_HID);
    close_ = other.close_;
  }
  return *this;
}

bool Hdf5Handle::reset() noexcept {
  if (!is_valid()) return true;
  return close_(std::exchange(id_, H5I_INVALID_HID)) >= 0;
}

Hdf5Quiet::Hdf5Quiet() {
  H5Eget_auto2(H5E_DEFAULT, &print_, &print_argument_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Hdf5Quiet::~Hdf5Quiet() { H5Eset_auto2(H5E_DEFAULT, print_, print_argument_); }

std::string hdf5_reason() {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_reason, &reason);
  return reason.empty() ? "unknown reason" : reason;
}

Hdf5File Hdf5File::create(const std::filesystem::path& path, files::WriteProcess& writer,
                          Hdf5Undo* undo) {
  const Hdf5Quiet quiet;
  Hdf5File file;
  file.path_ = path;
  file.fault_ = std::make_unique<Hdf5WriteFault>();
  const Hdf5Handle access = access_settings();
  keep_bookkeeping(access.get());
  if (!set_write_driver(access.get(), writer, *file.fault_, undo)) file.fail("create the file");
  const hid_t id = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get());
  file.file_ = Hdf5Handle(file.check(id, "create the file"), H5Fclose);
  return file;
}

Hdf5File Hdf5File::open_for_reading(const std::filesystem::path& path,
                                    std::shared_ptr<Hdf5Texts> texts,
                                    std::shared_ptr<const Undone> undone) {
  const Hdf5Quiet quiet;
  Hdf5File file;
  file.undone_ = std::move(undone);
  file.texts_ = std::move(texts);
  file.path_ = path;
  const Hdf5Handle access = access_settings();
  if (file.undone_ && !set_undone_driver(access.get(), *file.undone_)) file.fail("open the file");
  H5Pset_metadata_read_attempts(access.get(), kReadAttempts);
  const hid_t id = H5Fopen(path.c_str(), H5F_ACC_RDONLY | H5F_ACC_SWMR_READ, access.get());
  file.file_ = Hdf5Handle(file.check(id, "open the file"), H5Fclose);
  return file;
}

Hdf5File::~Hdf5File() {
  const Hdf5Quiet quiet;
  file_.reset();
}

void Hdf5File::start_swmr() {
  const Hdf5Quiet quiet;
  check(H5Fstart_swmr_write(id()), "prepare the file for readers");
  check_written();
}

void Hdf5File::flush() {
  const Hdf5Quiet quiet;
  check(H5Fflush(id(), H5F_SCOPE_GLOBAL), "write the file");
  check_written();
}

void Hdf5File::check_written() const {
  if (fault_ && fault_->commit) fault_->commit();
  if (fault_ && fault_->error != 0) {
    throw IoError(fmt::format("{}: cannot write the file: {}", path_.string(),
                              files::system_reason(fault_->error)));
  }
}

void Hdf5File::rename(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::rename(path_, path, error);
  if (error) {
    throw IoError(fmt::format("{}: cannot rename the file to {}: {}.", path_.string(),
                              path.filename().string(), error.message()));
  }
  path_ = path;
}

void Hdf5File::close() {
  if (!is_open()) return;
  const Hdf5Quiet quiet;
  const bool closed = file_.reset();
  check_written();
  if (!closed) fail("complete the file");
}

void Hdf5File::abandon() noexcept {
  if (fault_) fault_->ended = true;
}

void Hdf5File::fail(const std::string& what) const {
  const bool known = fault_ && fault_->error != 0;
  throw IoError(fmt::format("{}: cannot {}: {}", path_.string(), what,
                            known ? files::system_reason(fault_->error) : hdf5_reason() + "."));
}

hid_t Hdf5File::check(hid_t result, const std::string& what) const {
  if (result < 0) fail(what);
  return result;
}

}  // namespace buckens::run_store
