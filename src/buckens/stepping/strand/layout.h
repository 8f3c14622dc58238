// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/linalg/simd_level.h"

namespace buckens::stepping::strand {

/// Bodies, joints or pairs of joints that are processed side by side: one cache line of doubles.
inline constexpr int kLanes = 8;
/// Markers of a body that joints may use.
inline constexpr int kSlots = 2;

/// Mechanics in the plane xy: rotation by a unit complex number.
struct Plane {
  static constexpr int T = 2, R = 1, F = 3;  ///< translations, rotations, both
  static constexpr int Q = 2;                ///< numbers of a turn
  static constexpr int M = 2;                ///< numbers of its matrix: cosine and sine
  static constexpr int J = 4;                ///< of an inertia: zz, xx, yy, xy
  static constexpr int P = 3;                ///< patterns c_ab: xx, yy, xy
};

/// Mechanics in space: rotation by a unit quaternion.
struct Space {
  static constexpr int T = 3, R = 3, F = 6;
  static constexpr int Q = 4;  ///< w, x, y, z
  static constexpr int M = 9;  ///< by rows
  static constexpr int J = 6;  ///< xx, yy, zz, xy, xz, yz
  static constexpr int P = 6;  ///< the same
};

/// Tables are made of rows of kLanes numbers. Rows of one marker.
template <class S>
struct SlotRows {
  static constexpr int p = 0;            ///< position
  static constexpr int v = p + S::T;     ///< velocity
  static constexpr int axes = v + S::T;  ///< turn of what was given in body axes
  static constexpr int w = axes + S::M;  ///< angular velocity, world axes
  static constexpr int dp = w + S::R;    ///< displacement in an iteration
  static constexpr int dr = dp + S::T;   ///< rotation in an iteration, world axes
  static constexpr int f = dr + S::R;    ///< force on it, world axes
  static constexpr int m = f + S::T;     ///< moment on it, world axes
  static constexpr int count = m + S::R;
};

/// Rows of a block of bodies. Frame vectors have the rotation first.
template <class S>
struct BodyRows {
  static constexpr int F = S::F;
  static constexpr int q = 0;  ///< pose at the start
  static constexpr int p = q + S::Q;
  static constexpr int rate = p + S::T;   ///< at the start: w, v
  static constexpr int accel = rate + F;  ///< ẇ, v̇
  static constexpr int alg = accel + F;   ///< algorithmic accelerations
  static constexpr int vel = alg + F;     ///< of the step's history
  static constexpr int acc = vel + F;
  static constexpr int u = acc + F;    ///< increment
  static constexpr int corr = u + F;   ///< position correction
  static constexpr int qe = corr + F;  ///< motion at the end
  static constexpr int pe = qe + S::Q;
  static constexpr int we = pe + S::T;
  static constexpr int ve = we + S::R;
  static constexpr int turn = ve + S::T;       ///< matrix of qe
  static constexpr int turn0 = turn + S::M;    ///< the same where the step's matrix was formed
  static constexpr int fr = turn0 + S::M;      ///< load on the frame
  static constexpr int res = fr + F;           ///< residual as displacement
  static constexpr int cu = res + F;           ///< correction in an iteration
  static constexpr int W = cu + F;             ///< inverse of rotation, R×R by rows
  static constexpr int tau = W + S::R * S::R;  ///< of translation
  static constexpr int mass = tau + 1;
  static constexpr int J0 = mass + 1;
  static constexpr int z0 = J0 + S::J;           ///< of both slots, undeformed
  static constexpr int z = z0 + kSlots * S::T;   ///< deformed
  static constexpr int zf = z + kSlots * S::T;   ///< where the step's matrix was formed
  static constexpr int jl = zf + kSlots * S::T;  ///< nodal rates to angular velocity, R×R by rows
  static constexpr int jlf = jl + kSlots * S::R * S::R;
  static constexpr int given = jlf + kSlots * S::R * S::R;  ///< load on the frame by loads, gravity
  static constexpr int slots = given + F;
  static constexpr int count = slots + kSlots * SlotRows<S>::count;
};

/// Rows of a block of beam parts: those of a body and these. Nodal variables are translations and
/// rotations of the first node, then of the second.
template <class S>
struct MeshRows : BodyRows<S> {
  static constexpr int N = kSlots * S::F;
  static constexpr int d = BodyRows<S>::count;  ///< at the start
  static constexpr int d1 = d + N;              ///< ḋ
  static constexpr int d2 = d1 + N;             ///< d̈
  static constexpr int da = d2 + N;             ///< algorithmic
  static constexpr int load = da + N;           ///< coupling load in use
  static constexpr int dv = load + N;           ///< velocity of the step's history
  static constexpr int free = dv + N;           ///< at the end without interface loads
  static constexpr int end = free + N;          ///< at the end without correction
  static constexpr int f = end + N;             ///< answer to interface and centrifugal loads
  static constexpr int dc = f + N;              ///< displacement by the correction
  static constexpr int be = dc + N;             ///< what its strain moves in the step
  static constexpr int mov = be + N;            ///< change at fixed multipliers
  static constexpr int nd = mov + N;            ///< state at the end
  static constexpr int nd1 = nd + N;
  static constexpr int nd2 = nd1 + N;
  static constexpr int nda = nd2 + N;
  static constexpr int J2 = nda + N;  ///< moments in use, quadratic in d
  static constexpr int Jd2 = J2 + S::J;
  static constexpr int l = Jd2 + S::J;
  static constexpr int ld = l + S::R;
  static constexpr int eJ2 = ld + S::R;  ///< as evaluated
  static constexpr int eJd2 = eJ2 + S::J;
  static constexpr int el = eJd2 + S::J;
  static constexpr int eld = el + S::R;
  static constexpr int eload = eld + S::R;
  static constexpr int changed = eload + N;   ///< Σ of squares of the change of the load
  static constexpr int size = changed + 1;    ///< of the load
  static constexpr int moved = size + 1;      ///< largest displacement by the change
  static constexpr int fc = moved + 1;        ///< change of the frame's inertia
  static constexpr int turned = fc + S::R;    ///< rotation by it
  static constexpr int mask = turned + S::R;  ///< 1 where another solve follows, else 0
  static constexpr int seen = mask + 1;       ///< 1 of slots that joints or loads use, else 0
  static constexpr int given_nodes = seen + kSlots;  ///< load on the nodes by loads
  static constexpr int count = given_nodes + N;
};

/// Where entry (i, j) of a symmetric matrix is in a table that holds one half of it.
constexpr int symmetric_place(int i, int j) {
  return i >= j ? i * (i + 1) / 2 + j : j * (j + 1) / 2 + i;
}

/// Rows of what is constant of a block of beam parts. Blocks of equal parts share them; parts that
/// are turned in many ways each have their own, which then come from memory: so matrices that are
/// symmetric have one half here.
template <class S>
struct FixedRows {
  static constexpr int N = MeshRows<S>::N;
  static constexpr int kHalf = N * (N + 1) / 2;
  static constexpr int inverse = 0;             ///< of the diagonal of K̂
  static constexpr int per_load = inverse + N;  ///< the same as displacements
  static constexpr int per_pattern = per_load + N;
  static constexpr int pat = per_pattern + 1;  ///< patterns, P×N
  static constexpr int und = pat + S::P * N;   ///< undeformed, P×P
  static constexpr int A = und + S::P * S::P;  ///< Y K̂⁻¹, symmetric
  static constexpr int B = A + kHalf;          ///< of corrections, symmetric
  static constexpr int Mass = B + kHalf;       ///< symmetric
  static constexpr int Phi = Mass + kHalf;     ///< rigid motions N×F, by columns
  static constexpr int Pi = Phi + N * S::F;    ///< and what finds them
  static constexpr int count = Pi + N * S::F;
};

/// Rows of a block of joints, up to T closed points and R perpendicular directions.
template <class S>
struct JointRows {
  static constexpr int H = S::R;               ///< most directions
  static constexpr int b = 0;                  ///< in the first body, H×T
  static constexpr int c = b + H * S::T;       ///< in the second body
  static constexpr int lambda = c + H * S::T;  ///< T + H
  static constexpr int x = lambda + S::T + H;  ///< b × c in the world, H×R
  static constexpr int xf = x + H * S::R;      ///< the same where the step's matrix was formed
  static constexpr int side = xf + H * S::R;   ///< of both sides, in body axes:
  static constexpr int rot_point = 0;          ///< derivatives of points by the rotation, T×R
  static constexpr int rot_direction = rot_point + S::T * S::R;    ///< of directions, H×R
  static constexpr int node_direction = rot_direction + H * S::R;  ///< by nodal rotations, H×R
  static constexpr int side_count = node_direction + H * S::R;
  static constexpr int count = side + 2 * side_count;
};

/// Weights of a combination of numbers at the start of a step.
struct Weights {
  double d = 0, rate = 0, accel = 0, alg = 0;
};

/// One column of the integrals W_ab of a block of parts.
struct IntegralColumn {
  int a, b, column;
  int first, end;  ///< of its entries

  bool operator==(const IntegralColumn&) const = default;
};
/// What is constant in a step and the same for all bodies.
struct Constants {
  double s1 = 0, s2 = 0, c = 0, mass = 0, damping = 0, side_load = 0;
  Weights velocity, acceleration, predicted, with_mass, beside;
  double alg_before = 0, alg_old = 0, alg_new = 1;
  double L = 0;
  double gravity[3] = {0, 0, 0};
  bool is_damped = false;
  // Terms kept, 1 or 0.
  double jvar = 1, cor_ref = 1, cent0 = 1, quad_ref = 1, cent1 = 1, cor_fe = 1, eul_fe = 1;
};
/// A block of bodies.
struct BodyBlock {
  double* rows = nullptr;
  const double* fixed = nullptr;  ///< FixedRows of parts
  bool has_mesh = false;
  bool has_given = false;  ///< loads act on some of them: those in `given` count
  int num_columns = 0;
  const IntegralColumn* columns = nullptr;
  const int* entries = nullptr;    ///< row of each entry
  const double* values = nullptr;  ///< kLanes of each entry
};
/// A block of joints with the same number of directions.
struct JointBlock {
  double* rows = nullptr;
  int num_directions = 0;
  int num_lanes = 0;
  double* slot[2][kLanes] = {};  ///< SlotRows of both ends
  double* body[2][kLanes] = {};  ///< BodyRows of both ends
  int which[2][kLanes] = {};     ///< slot on the body
  int first_row[kLanes] = {};    ///< of λ
};
/// Two joints, or one twice, on the same body.
struct PairBlock {
  int num_lanes = 0;
  bool has_mesh = false;
  const double* side[2][kLanes] = {};  ///< side rows of the joints
  const double* body[kLanes] = {};
  const double* fixed[kLanes] = {};  ///< FixedRows of parts
  int which[2][kLanes] = {};         ///< slots on the body
  double sign[2][kLanes] = {};       ///< −1 of first ends, 1 of second ones
  int directions[2][kLanes] = {};
  double* out[kLanes] = {};  ///< block of S by columns
  int stride[kLanes] = {};
};

/// Largest changes in an iteration.
struct Largest {
  double frame = 0, interface = 0, motion = 0;
};

/// Work on blocks, compiled for one set of vector instructions.
struct Kernels {
  void (*start)(const Constants&, BodyBlock&);
  /// Motion at the end and of the markers; forgets loads on them.
  /// @return largest square of half an angle by which a body or a node has turned
  double (*move)(const Constants&, BodyBlock&);
  /// Keeps the configuration at which the matrix is formed.
  void (*freeze)(const Constants&, BodyBlock&);
  /// Loads on frames and nodes from those on markers.
  void (*collect)(const Constants&, BodyBlock&);
  /// Residuals. @return their size
  double (*find_residual)(const Constants&, BodyBlock&);
  /// Answer to a correction by loads on markers; displacement of markers by residuals.
  void (*correct)(const Constants&, BodyBlock&);
  /// Adds all changes, with the answer to loads on markers.
  Largest (*advance)(const Constants&, BodyBlock&);
  /// Nodal state at the end.
  void (*complete)(const Constants&, BodyBlock&);
  /// Coupling with that state, and how far it is from what was used.
  void (*evaluate_coupling)(const Constants&, BodyBlock&);
  /// Takes the moments over, and the loads with a solve where the mask says so.
  void (*take_over)(const Constants&, BodyBlock&);

  /// Residuals of rows and forces on markers.
  void (*evaluate_joints)(JointBlock&, double* g, double* g_dot);
  void (*freeze_joints)(JointBlock&);
  /// Loads markers by row forces in the directions at which the matrix was formed.
  void (*apply)(JointBlock&, const double* x);
  /// Changes of rows by displacements of markers.
  void (*find_changes)(JointBlock&, double* out);
  /// Adds to S.
  void (*add_pairs)(const PairBlock&);
};

/// Kernels of one level, which the processor must support.
const Kernels& plane_kernels(linalg::SimdLevel level);
const Kernels& space_kernels(linalg::SimdLevel level);

// One source each, compiled for its instruction set.
extern const Kernels kPortablePlane, kPortableSpace;
#if defined(__x86_64__)
extern const Kernels kAvx2Plane, kAvx2Space, kAvx512Plane, kAvx512Space;
#endif

}  // namespace buckens::stepping::strand
