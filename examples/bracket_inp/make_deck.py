#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes bracket.inp, a small deck as Abaqus/CAE would write it: an angle bracket of steel that carries
a device of 0.2 kg on its upper edge. Lengths in mm, masses in t, hence forces in N and stresses in MPa.

    python3 make_deck.py > bracket.inp
"""

X = [0, 2.5, 5] + [5 + 5 * k for k in range(1, 12)]   # along the foot
Y = [5 * k for k in range(9)]                          # across
Z = X                                                  # up
FOOT = UPRIGHT = 2                                     # cells through the thickness
DEVICE = 2e-4


def main():
    cells = [(i, j, k) for k in range(len(Z) - 1) for j in range(len(Y) - 1) for i in range(len(X) - 1)
             if k < FOOT or i < UPRIGHT]
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    places = sorted({(k + c, j + b, i + a) for i, j, k in cells for a, b, c in corners})
    number = {place: n for n, place in enumerate(places, 1)}
    nodes_of = [[number[k + c, j + b, i + a] for a, b, c in corners] for i, j, k in cells]
    top = [number[p] for p in places if p[0] == len(Z) - 1]
    base = [n for n, (i, j, k) in enumerate(cells, 1) if k == 0]

    print("*Heading")
    print("Angle bracket with a device on its upper edge; mm, t, N")
    print("** Written by make_deck.py")
    print("*Part, name=Bracket")
    print("*Node")
    for (k, j, i), n in number.items():
        print(f"{n:7}, {X[i]:10.4f}, {Y[j]:10.4f}, {Z[k]:10.4f}")
    print("*Element, type=C3D8I, elset=Angle")
    for n, nodes in enumerate(nodes_of, 1):
        print(f"{n:5}, " + ", ".join(f"{node:4}" for node in nodes))
    print("*Nset, nset=Edge")
    for first in range(0, len(top), 12):
        print(", ".join(str(n) for n in top[first:first + 12]) + ("," if first + 12 < len(top) else ""))
    print("*Element, type=MASS, elset=Device")
    for n, node in enumerate(top, len(cells) + 1):
        print(f"{n}, {node}")
    print("*Mass, elset=Device")
    print(f"{DEVICE / len(top):.9e},")
    print("*Solid Section, elset=Angle, material=Steel")
    print(",")
    print("*End Part")
    print("**")
    print("*Assembly, name=Assembly")
    print("*Instance, name=Bracket-1, part=Bracket")
    print("*End Instance")
    print("*Elset, elset=_Base_S1, internal, instance=Bracket-1")
    for first in range(0, len(base), 12):
        print(", ".join(str(n) for n in base[first:first + 12]) + ("," if first + 12 < len(base) else ""))
    print("*Surface, type=ELEMENT, name=Base")
    print("_Base_S1, S1")
    print("*End Assembly")
    print("*Material, name=Steel")
    print("*Density")
    print("7.85e-9,")
    print("*Elastic")
    print("210000., 0.3")
    print("*Damping, beta=1e-5")
    print("** What follows belongs to Abaqus; Buckens leaves it out and says so.")
    print("*Step, name=Modes, perturbation")
    print("*Frequency")
    print("6,")
    print("*Boundary")
    print("Base, ENCASTRE")
    print("*End Step")


if __name__ == "__main__":
    main()
