// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace buckens::linalg {

/// Whether this build contains libraries under the GNU GPL (CMake option BUCKENS_GPL): SPQR,
/// CHOLMOD's supernodal module, and the use of Gmsh's library for STEP files.
bool has_gpl_parts();

}  // namespace buckens::linalg
