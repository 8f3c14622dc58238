/** Numbers that come from the components of a vector or of a symmetric tensor at an offset. */

export function magnitude(v: ArrayLike<number>, at: number): number {
  return Math.sqrt(v[at]! ** 2 + v[at + 1]! ** 2 + v[at + 2]! ** 2);
}

/** Von Mises stress of xx, yy, zz, xy, yz, zx. */
export function misesOf(s: ArrayLike<number>, at: number): number {
  const [xx, yy, zz] = [s[at]!, s[at + 1]!, s[at + 2]!];
  const shear = s[at + 3]! ** 2 + s[at + 4]! ** 2 + s[at + 5]! ** 2;
  return Math.sqrt(0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3 * shear);
}

/** Von Mises stress of x, y, xy in a plane. */
export function planeMisesOf(s: ArrayLike<number>, at: number): number {
  const [x, y, xy] = [s[at]!, s[at + 1]!, s[at + 2]!];
  return Math.sqrt(x * x - x * y + y * y + 3 * xy * xy);
}

/**
 * Eigenvalue 0 (largest), 1 or 2 of xx, yy, zz, xy, yz, zx by the angle of the deviator's third
 * invariant (Smith, Comm. ACM 4, 1961).
 */
export function principalOf(s: ArrayLike<number>, at: number, which: number): number {
  const [xx, yy, zz] = [s[at]!, s[at + 1]!, s[at + 2]!];
  const [xy, yz, zx] = [s[at + 3]!, s[at + 4]!, s[at + 5]!];
  const mean = (xx + yy + zz) / 3;
  const [a, b, c] = [xx - mean, yy - mean, zz - mean];
  const size = Math.sqrt((a * a + b * b + c * c + 2 * (xy * xy + yz * yz + zx * zx)) / 6);
  if (!(size > 0)) return mean;
  const determinant = a * (b * c - yz * yz) - xy * (xy * c - yz * zx) + zx * (xy * yz - b * zx);
  const cosine = Math.min(1, Math.max(-1, determinant / (2 * size ** 3)));
  const angle = Math.acos(cosine) / 3;
  const turn = [0, -2 * Math.PI / 3, (2 * Math.PI) / 3][which]!;
  return mean + 2 * size * Math.cos(angle + turn);
}
