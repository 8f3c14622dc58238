// SPDX-License-Identifier: Apache-2.0
// How numbers of vectors come to the processes that want them, and back.
#include <algorithm>
#include <numeric>
#include <vector>

#include "ranks_parts.h"

namespace buckens_petsc {

Ranks::Way::Way(const std::vector<int>& variables, const int* first, MPI_Comm comm_of)
    : comm(comm_of) {
  int rank = 0, count = 0;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &count);
  const auto owner = [&](int variable) {
    return static_cast<std::size_t>(std::upper_bound(first, first + count + 1, variable) - first -
                                    1);
  };
  places.resize(variables.size());
  std::iota(places.begin(), places.end(), 0);
  std::stable_sort(places.begin(), places.end(), [&](int a, int b) {
    return owner(variables[static_cast<std::size_t>(a)]) <
           owner(variables[static_cast<std::size_t>(b)]);
  });
  in_counts.assign(static_cast<std::size_t>(count), 0);
  std::vector<int> wanted;
  for (const int place : places) {
    wanted.push_back(variables[static_cast<std::size_t>(place)]);
    ++in_counts[owner(wanted.back())];
  }
  in_first = starts_of(in_counts);
  out_counts.resize(static_cast<std::size_t>(count));
  MPI_Alltoall(in_counts.data(), 1, MPI_INT, out_counts.data(), 1, MPI_INT, comm);
  out_first = starts_of(out_counts);
  given.resize(static_cast<std::size_t>(out_first.back()));
  MPI_Alltoallv(wanted.data(), in_counts.data(), in_first.data(), MPI_INT, given.data(),
                out_counts.data(), out_first.data(), MPI_INT, comm);
  for (int& row : given) row -= first[rank];
  out.resize(given.size());
  in.resize(wanted.size());
}

void Ranks::Way::bring(const double* rows, double* wanted) {
  for (std::size_t k = 0; k < given.size(); ++k) out[k] = rows[given[k]];
  MPI_Alltoallv(out.data(), out_counts.data(), out_first.data(), MPI_DOUBLE, in.data(),
                in_counts.data(), in_first.data(), MPI_DOUBLE, comm);
  for (std::size_t k = 0; k < places.size(); ++k) wanted[places[k]] = in[k];
}

void Ranks::Way::give_back(const double* wanted, double* rows, bool adds) {
  for (std::size_t k = 0; k < places.size(); ++k) in[k] = wanted[places[k]];
  MPI_Alltoallv(in.data(), in_counts.data(), in_first.data(), MPI_DOUBLE, out.data(),
                out_counts.data(), out_first.data(), MPI_DOUBLE, comm);
  for (std::size_t k = 0; k < given.size(); ++k) {
    rows[given[k]] = adds ? rows[given[k]] + out[k] : out[k];
  }
}

}  // namespace buckens_petsc
