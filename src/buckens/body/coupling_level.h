// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace buckens::body {

/// Which inertial coupling terms between frame and nodal variables are kept.
///
/// `full`: all of them, from the exact kinetic energy FM (13). `none`: the body's frame moves like
/// that of a rigid body, its mesh vibrates as at rest; derives from a kinetic energy with J₀.
enum class CouplingLevel { full, none };

}  // namespace buckens::body
