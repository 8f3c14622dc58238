# SPDX-License-Identifier: Apache-2.0
"""Program for each process under mpirun: the plug-in factorises small matrices on all of them. Prints what the first finds.

    mpirun -n 2 python3 shared_factor.py PLUGIN [NEGATIVE]

The matrix is that of a row of springs, 2 on its diagonal and −1 beside it; with NEGATIVE its pivots change sign there.
"""

import ctypes
import sys

SIZE = 400
INT, DOUBLE, FLOAT = (ctypes.POINTER(kind) for kind in (ctypes.c_int, ctypes.c_double, ctypes.c_float))


# Of src/buckens/linalg/grid_plugin.h, whose structures stand below.
VERSION = 13


class Columns(ctypes.Structure):
    _fields_ = [("starts", INT), ("rows", INT), ("values", DOUBLE)]


GIVE = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_int, ctypes.c_int, ctypes.POINTER(Columns))


class Matrix(ctypes.Structure):
    _fields_ = [("size", ctypes.c_int), ("all", Columns), ("give", GIVE), ("source", ctypes.c_void_p), ("block", ctypes.c_int),
                ("num_motions", ctypes.c_int), ("motions", DOUBLE), ("options", ctypes.c_char_p), ("order", INT),
                ("terms", INT), ("weights", DOUBLE), ("num_terms", ctypes.c_int), ("is_indefinite", INT)]


class Rows(ctypes.Structure):
    _fields_ = [("first", INT), ("variables", INT)]


class Mesh(ctypes.Structure):
    _fields_ = [("num_nodes", ctypes.c_int), ("weights", INT), ("num_elements", ctypes.c_long), ("starts", ctypes.POINTER(ctypes.c_long)),
                ("nodes", INT)]


class Facts(ctypes.Structure):
    _fields_ = [("entries", ctypes.c_long), ("square_norm", ctypes.c_double), ("content", ctypes.c_ulonglong * 2)]


ADD_CONTENT = ctypes.CFUNCTYPE(None, ctypes.c_int, ctypes.POINTER(Columns), INT, ctypes.POINTER(ctypes.c_ulonglong))


class Maker(ctypes.Structure):
    """Nobody asks for columns here, or for work on rows of vectors."""
    _fields_ = [("make", ctypes.c_void_p), ("add_content", ADD_CONTENT), ("begin_rows", ctypes.c_void_p), ("end_rows", ctypes.c_void_p),
                ("work_rows", ctypes.c_void_p), ("rows", ctypes.c_void_p)]


class Limits(ctypes.Structure):
    _fields_ = [("absolute", ctypes.c_double), ("least", ctypes.c_double), ("most", ctypes.c_double), ("most_iterations", ctypes.c_int)]


class Outcome(ctypes.Structure):
    _fields_ = [("iterations", ctypes.c_int), ("first", ctypes.c_double), ("last", ctypes.c_double), ("has_converged", ctypes.c_int)]


MAKE = ctypes.CFUNCTYPE(ctypes.c_void_p, ctypes.POINTER(Matrix), ctypes.c_char_p, ctypes.c_int)
SOLVE = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, DOUBLE, DOUBLE, ctypes.POINTER(Limits), ctypes.POINTER(Outcome),
                         ctypes.c_char_p, ctypes.c_int)


class Plugin(ctypes.Structure):
    _fields_ = [("version", ctypes.c_int), ("name", ctypes.c_void_p), ("make", MAKE), ("solve", SOLVE),
                ("bytes", ctypes.CFUNCTYPE(ctypes.c_double, ctypes.c_void_p)), ("release", ctypes.CFUNCTYPE(None, ctypes.c_void_p)),
                ("join", ctypes.CFUNCTYPE(None, INT, INT)), ("serve", ctypes.CFUNCTYPE(None, ctypes.POINTER(Maker))), ("leave", ctypes.CFUNCTYPE(None)),
                ("traffic", ctypes.c_void_p),
                ("divide", ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_int, ctypes.POINTER(Rows), ctypes.POINTER(Columns), ctypes.POINTER(Facts),
                                            ctypes.c_char_p, ctypes.c_int)),
                ("divide_rows", ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_int, ctypes.c_int, ctypes.POINTER(Columns), ctypes.c_char_p,
                                                 ctypes.c_int)),
                ("make_rows", ctypes.c_void_p), ("make_columns", ctypes.c_void_p), ("add_up", ctypes.c_void_p),
                ("multiply", ctypes.CFUNCTYPE(None, ctypes.c_int, INT, ctypes.POINTER(DOUBLE), ctypes.POINTER(DOUBLE))),
                ("inner_product", ctypes.c_void_p), ("diagonal", ctypes.c_void_p), ("near_diagonal", ctypes.c_void_p), ("marks", ctypes.c_void_p), ("edges", ctypes.c_void_p),
                ("gather", ctypes.CFUNCTYPE(None, ctypes.c_int, INT, INT, DOUBLE)),
                ("forget", ctypes.CFUNCTYPE(None, ctypes.c_int)),
                ("make_pairs", ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_int, ctypes.POINTER(Rows), ctypes.c_int, ctypes.c_char_p, ctypes.c_int)),
                ("project", ctypes.CFUNCTYPE(ctypes.c_double, ctypes.c_int, ctypes.c_int, DOUBLE, DOUBLE)),
                ("combine", ctypes.CFUNCTYPE(None, ctypes.c_int, ctypes.c_int, DOUBLE, DOUBLE)),
                ("put_pair", ctypes.CFUNCTYPE(None, ctypes.c_int, ctypes.c_int, FLOAT, FLOAT)),
                ("take_pair", ctypes.CFUNCTYPE(None, ctypes.c_int, ctypes.c_int, FLOAT, FLOAT)),
                ("runs", ctypes.c_void_p), ("begin_rows", ctypes.c_void_p), ("work_rows", ctypes.c_void_p), ("put_rows", ctypes.c_void_p),
                ("take_rows", ctypes.c_void_p), ("solve_rows", ctypes.c_void_p),
                ("partition", ctypes.CFUNCTYPE(ctypes.c_int, ctypes.POINTER(Mesh), INT, ctypes.c_char_p, ctypes.c_int)),
                ("find_modes", ctypes.c_void_p)]


def column_giver(negative):
    kept = {}

    def give(_, first, end, columns):
        kept.clear()
        if not columns:
            return
        starts, rows, values = [0], [], []
        for k in range(first, end):
            rows += [k] + ([k + 1] if k + 1 < SIZE else [])
            values += [-2.0 if k == negative else 2.0] + ([-1.0] if k + 1 < SIZE else [])
            starts.append(len(rows))
        kept["starts"] = (ctypes.c_int * len(starts))(*starts)
        kept["rows"] = (ctypes.c_int * max(1, len(rows)))(*rows)
        kept["values"] = (ctypes.c_double * max(1, len(values)))(*values)
        columns[0].starts = ctypes.cast(kept["starts"], INT)
        columns[0].rows = ctypes.cast(kept["rows"], INT)
        columns[0].values = ctypes.cast(kept["values"], DOUBLE)

    return GIVE(give)


def factorise(plugin, negative):
    # Every second variable first, and so on: what a factor in this order must do to its right-hand sides and answers is seen.
    order = (ctypes.c_int * SIZE)(*range(1, SIZE, 2), *range(0, SIZE, 2))
    give = column_giver(negative)
    matrix = Matrix(size=SIZE, give=give, block=1, order=ctypes.cast(order, INT))
    error = ctypes.create_string_buffer(400)
    factor = plugin.make(ctypes.byref(matrix), error, 400)
    if not factor:
        print("error:", error.value.decode())
        return
    exact = [float((7 * k) % 11 - 5) for k in range(SIZE)]
    right = [2 * exact[k] - (exact[k - 1] if k > 0 else 0) - (exact[k + 1] if k + 1 < SIZE else 0) for k in range(SIZE)]
    b, x = (ctypes.c_double * SIZE)(*right), (ctypes.c_double * SIZE)()
    outcome = Outcome()
    for _ in range(2):
        if plugin.solve(factor, b, x, ctypes.byref(Limits(0, 0, 0, 1)), ctypes.byref(outcome), error, 400) != 0:
            print("error:", error.value.decode())
    print("entries:", plugin.bytes(factor) / 8)
    print("difference:", max(abs(x[k] - exact[k]) for k in range(SIZE)))
    plugin.release(factor)


def run(plugin_file, work):
    """Calls work(plugin, number of processes) on the first one, while the others serve."""
    library = ctypes.CDLL(plugin_file)
    library.buckens_grid_plugin.restype = ctypes.POINTER(Plugin)
    plugin = library.buckens_grid_plugin()[0]
    if plugin.version != VERSION:
        sys.exit(f"the plug-in has version {plugin.version}, and the structures here are of {VERSION}: compare them with grid_plugin.h")
    rank, count = ctypes.c_int(), ctypes.c_int()
    plugin.join(ctypes.byref(rank), ctypes.byref(count))
    if rank.value > 0:
        maker = Maker(add_content=ADD_CONTENT(lambda count, columns, variables, content: None))
        plugin.serve(ctypes.byref(maker))
        return
    work(plugin, count.value)
    plugin.leave()


if __name__ == "__main__":
    run(sys.argv[1], lambda plugin, _: factorise(plugin, int(sys.argv[2]) if len(sys.argv) > 2 else None))
