# SPDX-License-Identifier: Apache-2.0
"""The classical method of Runge and Kutta, for references that do not use the program."""


def runge_kutta(slope, y, duration, steps):
    """State after `duration`, where y' = slope(t, y) and y at t = 0; the error falls with the fourth power of the step."""
    h = duration / steps
    for k in range(steps):
        t = k * h
        a = slope(t, y)
        b = slope(t + 0.5 * h, y + 0.5 * h * a)
        c = slope(t + 0.5 * h, y + 0.5 * h * b)
        y = y + h / 6 * (a + 2 * b + 2 * c + slope(t + h, y + h * c))
    return y
