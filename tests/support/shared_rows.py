# SPDX-License-Identifier: Apache-2.0
"""Program for each process under mpirun: the plug-in divides matrices and pairs among the others. Prints what the first finds.

    mpirun -n 3 python3 shared_rows.py PLUGIN
"""

import ctypes
import random
import sys

from shared_factor import DOUBLE, INT, Columns, Facts, Mesh, Rows, run

ROWS, COLUMNS, PAIRS = 37, 23, 3


def numbers(kind, values):
    return (kind * max(1, len(values)))(*values)


def sparse(lists):
    """Of {place: value} for each column, or row."""
    starts, places, values = [0], [], []
    for entries in lists:
        places += sorted(entries)
        values += [entries[place] for place in sorted(entries)]
        starts.append(len(places))
    arrays = numbers(ctypes.c_int, starts), numbers(ctypes.c_int, places), numbers(ctypes.c_double, values)
    columns = Columns(ctypes.cast(arrays[0], INT), ctypes.cast(arrays[1], INT), ctypes.cast(arrays[2], DOUBLE))
    return columns, (starts, places, values), arrays


def uneven_rows(size, count):
    """Rows of the processes other than the first, which grow from one to the next."""
    others = count - 1
    arrays = numbers(ctypes.c_int, [size * k * k // (others * others) for k in range(count)]), numbers(ctypes.c_int, list(range(size)))
    return Rows(ctypes.cast(arrays[0], INT), ctypes.cast(arrays[1], INT)), arrays


def product(plugin, matrices, vectors, sizes):
    x = [numbers(ctypes.c_double, vector) for vector in vectors]
    y = [numbers(ctypes.c_double, [7.0] * size) for size in sizes]
    pointers = [(DOUBLE * len(some))(*[ctypes.cast(array, DOUBLE) for array in some]) for some in (x, y)]
    plugin.multiply(len(matrices), numbers(ctypes.c_int, matrices), *pointers)
    return [list(array) for array in y]


def difference(a, b):
    return max(abs(p - q) for p, q in zip(a, b, strict=True))


def multiply(plugin, chance, error, count):
    """Whole numbers, so that sums are exact. The last rows are empty."""
    rows = [{c: float(chance.randint(-9, 9)) for c in chance.sample(range(COLUMNS), 4)} for _ in range(ROWS - 3)] + [{}] * 3
    symmetric = [{c: 0.0} for c in range(COLUMNS)]
    for c in range(COLUMNS):
        for r in chance.sample(range(COLUMNS), 3):
            symmetric[c][r] = symmetric[r][c] = float(chance.randint(-9, 9))
    del symmetric[5][5]
    of_rows, _, kept_rows = sparse(rows)
    of_columns, lists, kept_columns = sparse(symmetric)
    A = plugin.divide_rows(ROWS, COLUMNS, ctypes.byref(of_rows), error, 400)
    facts = Facts()
    of, kept_of = uneven_rows(COLUMNS, count)
    B = plugin.divide(COLUMNS, ctypes.byref(of), ctypes.byref(of_columns), ctypes.byref(facts), error, 400)
    values = [value for column in symmetric for value in column.values()]
    print("facts:", facts.entries == len(values) and facts.square_norm == sum(value * value for value in values))
    x, z = ([float(chance.randint(-99, 99)) for _ in range(COLUMNS)] for _ in range(2))
    y, w = product(plugin, [A, B], [x, z], [ROWS, COLUMNS])
    print("rows:", difference(y, [sum(value * x[c] for c, value in row.items()) for row in rows]))
    print("symmetric:", difference(w, [sum(value * z[c] for c, value in row.items()) for row in symmetric]))
    back = [numbers(kind, [0] * len(values)) for kind, values in zip((ctypes.c_int, ctypes.c_int, ctypes.c_double), lists, strict=True)]
    plugin.gather(B, *back)
    print("gathered:", all(list(found) == values for found, values in zip(back, lists, strict=True)))
    del symmetric[0][next(r for r in symmetric[0] if r > 0)]
    lopsided, _, kept_lopsided = sparse(symmetric)
    print("lopsided:", plugin.divide(COLUMNS, ctypes.byref(Rows()), ctypes.byref(lopsided), ctypes.byref(facts), error, 400), error.value.decode())
    plugin.forget(A)
    plugin.forget(B)
    del kept_rows, kept_columns, kept_lopsided, kept_of


def keep_pairs(plugin, chance, error, count):
    """Loads of which each is one unit vector: powers of two are exact in single precision."""
    of, kept_of = uneven_rows(ROWS, count)
    number = plugin.make_pairs(ROWS, ctypes.byref(of), PAIRS, error, 400)
    del kept_of
    loads = [[1.0 if row == place else 0.0 for row in range(ROWS)] for place in (2, 20, 36)]
    answers = [[float(chance.randint(-9, 9)) for _ in range(ROWS)] for _ in range(PAIRS)]
    for pair in range(PAIRS):
        plugin.put_pair(number, pair, numbers(ctypes.c_float, loads[pair]), numbers(ctypes.c_float, answers[pair]))
    r = [float(chance.randint(-9, 9)) for _ in range(ROWS)]
    left, along = numbers(ctypes.c_double, r), numbers(ctypes.c_double, [0.0] * PAIRS)
    square = plugin.project(number, 2, left, along)
    expected = [0.0 if row in (2, 20) else value for row, value in enumerate(r)]
    print("along:", difference(along, [r[2], r[20], 0.0]))
    print("left:", difference(left, expected), square - sum(value * value for value in expected))
    total = numbers(ctypes.c_double, [7.0] * ROWS)
    plugin.combine(number, PAIRS, numbers(ctypes.c_double, [1.0, -2.0, 0.5]), total)
    print("combined:", difference(total, [a - 2 * b + c / 2 for a, b, c in zip(*answers, strict=True)]))
    load, answer = numbers(ctypes.c_float, [0.0] * ROWS), numbers(ctypes.c_float, [0.0] * ROWS)
    plugin.take_pair(number, 1, load, answer)
    print("taken:", difference(load, loads[1]), difference(answer, answers[1]))
    plugin.forget(number)


def divide_mesh(plugin, chance, error, count):
    """A row of bars whose nodes are numbered at random."""
    order = list(range(600))
    chance.shuffle(order)
    nodes = [node for pair in zip(order, order[1:]) for node in pair]
    bars = len(nodes) // 2
    arrays = (numbers(ctypes.c_int, [3] * len(order)), numbers(ctypes.c_long, [2 * e for e in range(bars + 1)]), numbers(ctypes.c_int, nodes))
    mesh = Mesh(len(order), ctypes.cast(arrays[0], INT), bars, ctypes.cast(arrays[1], ctypes.POINTER(ctypes.c_long)), ctypes.cast(arrays[2], INT))
    parts = []
    for _ in range(2):
        part = numbers(ctypes.c_int, [-1] * len(order))
        if plugin.partition(ctypes.byref(mesh), part, error, 400) != 0:
            print("error:", error.value.decode())
        parts.append(list(part))
    sizes = [parts[0].count(k) for k in range(count - 1)]
    print("sizes:", sum(sizes) == len(order) and max(sizes) <= 1.02 * len(order) / (count - 1))
    print("cuts:", sum(parts[0][a] != parts[0][b] for a, b in zip(order, order[1:])))
    print("again:", parts[0] == parts[1])


def work(plugin, count):
    chance = random.Random(5)
    error = ctypes.create_string_buffer(400)
    multiply(plugin, chance, error, count)
    keep_pairs(plugin, chance, error, count)
    divide_mesh(plugin, chance, error, count)


if __name__ == "__main__":
    run(sys.argv[1], work)
