// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace buckens::linalg {

/// While it lives, BLAS, LAPACK, CHOLMOD and SPQR work in the calling thread alone.
///
/// These libraries start a thread per processor when a matrix seems worth it, whatever the user of
/// this library asked for; on the many small matrices of a mechanism that costs a hundred times
/// what it gains. Whoever calls them holds one of these meanwhile. Everything is as it was
/// afterwards: settings of OpenMP, which belong to the calling thread; with an OpenBLAS that has
/// threads of its own, their number, which the process has in common and which stays at one until
/// the last of these is gone. May be nested. Costs some 20 ns.
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
