// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace buckens::linalg {

/// While it lives, BLAS, LAPACK, CHOLMOD and SPQR run in the calling thread only.
///
/// These libraries start a thread per processor when a matrix seems worth it, whatever the user of
/// this library asked for; on the many small matrices of a mechanism that costs a hundred times
/// what it gains. Hold one of these while calling them. Everything is restored afterwards: the
/// settings of OpenMP, which belong to the calling thread; and, with an OpenBLAS that has threads
/// of its own, their number, which the whole process shares and which stays at one until the last
/// of these is gone. May be nested. Costs about 20 ns.
class SingleThread {
 public:
  SingleThread();
  ~SingleThread();
  SingleThread(const SingleThread&) = delete;
  SingleThread& operator=(const SingleThread&) = delete;

 private:
  int threads_ = 0;  // as found
  int levels_ = 0;   // of nested parallel regions, as found
};

}  // namespace buckens::linalg
