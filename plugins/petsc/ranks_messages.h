// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>

#include <mpi.h>

#include "ranks.h"

namespace buckens_petsc {

// MPI counts with int.
constexpr std::size_t kMostAtOnce = std::size_t{1} << 28;
constexpr int kDataTag = 1;

inline MPI_Datatype type_of(const int*) { return MPI_INT; }
inline MPI_Datatype type_of(const double*) { return MPI_DOUBLE; }
inline MPI_Datatype type_of(const long*) { return MPI_LONG; }
inline MPI_Datatype type_of(const char*) { return MPI_BYTE; }

/// To a process that calls receive() with as many.
template <class T>
void send(const T* values, std::size_t count, int to, MPI_Comm comm) {
  for (std::size_t first = 0; first < count; first += kMostAtOnce) {
    const auto some = static_cast<int>(std::min(kMostAtOnce, count - first));
    MPI_Send(values + first, some, type_of(values), to, kDataTag, comm);
  }
}

template <class T>
void receive(T* values, std::size_t count, int from, MPI_Comm comm) {
  for (std::size_t first = 0; first < count; first += kMostAtOnce) {
    const auto some = static_cast<int>(std::min(kMostAtOnce, count - first));
    MPI_Recv(values + first, some, type_of(values), from, kDataTag, comm, MPI_STATUS_IGNORE);
  }
}

template <class T>
void Ranks::send_counted(const T* values, std::size_t count, int to) {
  send(values, count, to, work_);
  traffic_.messages += 1;
  traffic_.bytes += static_cast<double>(count * sizeof(T));
}

}  // namespace buckens_petsc
