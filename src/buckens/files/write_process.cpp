// SPDX-License-Identifier: Apache-2.0
#include "buckens/files/write_process.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

#include "buckens/base/errors.h"
#include "buckens/files/output_file.h"

namespace buckens::files {

namespace {

/// Head of a message; `size` bytes follow. A descriptor travels beside a head of size 0.
struct WriteOrder {
  std::uint64_t address;
  std::uint64_t size;
};

/// Ancillary part of a message that carries one descriptor.
struct DescriptorParcel {
  alignas(cmsghdr) char bytes[CMSG_SPACE(sizeof(int))] = {};
};

bool send_all(int socket, const void* from, std::size_t size) {
  const auto* bytes = static_cast<const char*>(from);
  while (size > 0) {
    const ssize_t count = ::send(socket, bytes, size, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

/// Two pieces as one message: the other process wakes once.
bool send_both(int socket, iovec head, iovec body) {
  iovec parts[] = {head, body};
  msghdr message{};
  message.msg_iov = parts;
  message.msg_iovlen = 2;
  ssize_t count = 0;
  do {
    count = ::sendmsg(socket, &message, MSG_NOSIGNAL);
  } while (count < 0 && errno == EINTR);
  if (count < 0) return false;
  auto sent = static_cast<std::size_t>(count);
  for (const iovec& part : parts) {
    const std::size_t done = std::min(sent, part.iov_len);
    sent -= done;
    if (!send_all(socket, static_cast<const char*>(part.iov_base) + done, part.iov_len - done)) {
      return false;
    }
  }
  return true;
}

bool receive_all(int socket, void* to, std::size_t size) {
  auto* bytes = static_cast<char*>(to);
  while (size > 0) {
    const ssize_t count = ::recv(socket, bytes, size, 0);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

// ---- the second process
// The first one may have had other threads, whose locks are copied as they were. So only system
// calls are used here: no heap memory, no streams, no exceptions.

constexpr int kSocket = 0;  // the only descriptor kept

void leave_everything(int socket) {
  ::setsid();  // the terminal's signals go to its group of processes
  for (const int signal : {SIGINT, SIGTERM, SIGQUIT, SIGHUP, SIGPIPE, SIGXFSZ, SIGTSTP}) {
    ::signal(signal, SIG_IGN);
  }
  ::dup2(socket, kSocket);
  if (::close_range(kSocket + 1, ~0U, 0) != 0) {
    const long limit = ::sysconf(_SC_OPEN_MAX);
    for (int descriptor = kSocket + 1; descriptor < limit; ++descriptor) ::close(descriptor);
  }
}

/// Memory for one message, which grows with the largest.
class Room {
 public:
  char* of_size(std::size_t size) {
    if (size <= size_) return bytes_;
    void* grown = bytes_ == nullptr ? ::mmap(nullptr, size, PROT_READ | PROT_WRITE,
                                             MAP_PRIVATE | MAP_ANONYMOUS, -1, 0)
                                    : ::mremap(bytes_, size_, size, MREMAP_MAYMOVE);
    if (grown == MAP_FAILED) return nullptr;
    size_ = size;
    return bytes_ = static_cast<char*>(grown);
  }

 private:
  char* bytes_ = nullptr;
  std::size_t size_ = 0;
};

/// Receives a header and, if there is one, a descriptor. @return false at the end of requests
bool receive_order(WriteOrder& order, int& file) {
  DescriptorParcel parcel;
  iovec part{&order, sizeof order};
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = parcel.bytes;
  message.msg_controllen = sizeof parcel.bytes;
  ssize_t count = 0;
  do {
    count = ::recvmsg(kSocket, &message, 0);
  } while (count < 0 && errno == EINTR);
  if (count <= 0) return false;
  const cmsghdr* head = CMSG_FIRSTHDR(&message);
  if (head != nullptr && head->cmsg_type == SCM_RIGHTS) {
    if (file >= 0) ::close(file);
    std::memcpy(&file, CMSG_DATA(head), sizeof file);
  }
  const auto got = static_cast<std::size_t>(count);
  return receive_all(kSocket, reinterpret_cast<char*>(&order) + got, sizeof order - got);
}

int write_all(int file, const WriteOrder& order, const char* bytes) {
  std::uint64_t done = 0;
  while (done < order.size) {
    const ssize_t count =
        ::pwrite(file, bytes + done, order.size - done, static_cast<off_t>(order.address + done));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    if (count == 0) return ENOSPC;
    done += static_cast<std::uint64_t>(count);
  }
  return 0;
}

[[noreturn]] void serve(int socket) {
  leave_everything(socket);
  int file = -1;
  Room room;
  WriteOrder order{};
  while (receive_order(order, file)) {
    char* bytes = order.size > 0 ? room.of_size(order.size) : nullptr;
    int error = 0;
    if (order.size > 0 && bytes == nullptr) ::_exit(1);  // the rest of the message has no place
    if (order.size > 0 && !receive_all(kSocket, bytes, order.size)) break;  // never half of it
    if (order.size > 0) error = write_all(file, order, bytes);
    if (!send_all(kSocket, &error, sizeof error)) break;
  }
  ::_exit(0);
}

}  // namespace

WriteProcess::WriteProcess() {
  const auto fail = [](int error) {
    throw IoError(
        fmt::format("cannot start the process that writes the results: {}", system_reason(error)));
  };
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) fail(errno);
  child_ = ::fork();
  if (child_ == 0) serve(ends[1]);
  const int error = errno;
  ::close(ends[1]);
  socket_ = ends[0];
  if (child_ < 0) {
    ::close(socket_);
    fail(error);
  }
}

WriteProcess::~WriteProcess() {
  ::close(socket_);
  while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

int WriteProcess::answer() const {
  int error = 0;
  return receive_all(socket_, &error, sizeof error) ? error : EPIPE;
}

int WriteProcess::take_file(int descriptor) {
  DescriptorParcel parcel;
  WriteOrder order{0, 0};
  iovec part{&order, sizeof order};
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = parcel.bytes;
  message.msg_controllen = sizeof parcel.bytes;
  cmsghdr* head = CMSG_FIRSTHDR(&message);
  head->cmsg_level = SOL_SOCKET;
  head->cmsg_type = SCM_RIGHTS;
  head->cmsg_len = CMSG_LEN(sizeof descriptor);
  std::memcpy(CMSG_DATA(head), &descriptor, sizeof descriptor);
  ssize_t count = 0;
  do {
    count = ::sendmsg(socket_, &message, MSG_NOSIGNAL);
  } while (count < 0 && errno == EINTR);
  if (count < 0) return errno;
  const auto sent = static_cast<std::size_t>(count);
  if (!send_all(socket_, reinterpret_cast<const char*>(&order) + sent, sizeof order - sent)) {
    return EPIPE;
  }
  return answer();
}

int WriteProcess::write(std::uint64_t address, const void* bytes, std::size_t size) {
  WriteOrder order{address, size};
  if (size == 0) return 0;
  // The system only reads from what it sends.
  if (!send_both(socket_, {&order, sizeof order}, {const_cast<void*>(bytes), size})) return EPIPE;
  return answer();
}

}  // namespace buckens::files
