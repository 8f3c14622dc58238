# SPDX-License-Identifier: Apache-2.0
"""What is asked of the figures of docs/developers/benchmarks.json: goal, measured value, bound and peer."""

# Measured on another machine, see benchmarks.md: Strands.
PEERS = {"planar_beam_step/128": "Exudyn 0.28 ms", "divided_beam_step/128": "Chrono 1.28 ms",
         "rigid_chain_step/1000": "Exudyn 7.2, Chrono 15.8 ms"}


class Goals:
    def __init__(self, results):
        self.blocks = {}  # by section and block
        self.named = {}   # results of Google Benchmark
        self.preparations = {}  # by block, threads and whether the factor is stored
        for key, section in results.items():
            for row in section["rows"]:
                if "error" in row:
                    continue
                if "name" in row:
                    self.named[row["name"]] = row
                elif "stored" in row:
                    self.preparations[f"{row['element']} {row['divisions']}", row["threads"], row["stored"]] = row
                elif "method" not in row or row["method"] == "subspace":
                    block = f"{row['element']} {row['divisions']}"
                    on_two = " on two threads" if row.get("method") and row.get("threads") == 2 else ""
                    self.blocks.setdefault(key.split(":")[0] + on_two, {})[block] = row
        self.rows = []

    def add(self, what, goal, measured, bound=None, peer="–", unit="", spread=None):
        """What must not be exceeded, where it has been measured, to three digits. `spread`: median, and a lower and an upper value."""
        if measured is None:
            return

        def rounded(value):
            return float(f"{value:.3g}")

        def shown(value):
            return "–" if value is None else f"{rounded(value):g}{unit}"

        # What is shown as the goal meets it.
        is_met = rounded(measured) <= rounded(goal)
        usual = "–" if spread is None else f"{shown(spread[0])} ({shown(spread[1])} to {shown(spread[2])})"
        self.rows.append([what, f"≤ {shown(goal)}", shown(measured), usual, shown(bound), peer,
                          "yes" if is_met else "**no**"])

    def of(self, section, block):
        return self.blocks.get(section, {}).get(block)

    def level(self, block, level, threads=1):
        row = self.of("steps", block)
        for step in row["steps"]["levels"] if row else []:
            if step["level"] == level and step["threads"] == threads:
                return step
        return {}

    def step(self, block, level, threads=1):
        return self.level(block, level, threads).get("step")

    def spread(self, block, reference):
        """Median and quartiles of steps with `full`, in solves."""
        quartiles = self.level(block, "full").get("quartiles")
        return [quartiles[k] / reference for k in (2, 1, 3)] if quartiles else None

    @staticmethod
    def range(row, scale):
        """Median and range of repetitions."""
        times = row.get("all_seconds")
        return [scale * times[k] for k in (len(times) // 2, 0, -1)] if times else None

    def solve(self, block, sides="1"):
        row = self.of("solves", block)
        return row["panels"]["1"][sides] if row else None

    def bound(self, block, threads):
        """Of one solve: the factor is read twice."""
        row = self.of("solves", block)
        return 2.0 * row["panels"]["bytes"] / row["bandwidth"][threads] if row else None

    def full_coupling(self):
        for block in ("hex8 21 x 21 x 21", "tet10 11 x 10 x 10", "hex8 274 x 10 x 10", "tet10 137 x 5 x 5"):
            self.step_of(block, 1.25, self.bound(block, "1"))
        # Factors that stay in the cache beat the bandwidth.
        for block in ("hex8 9 x 9 x 9", "tet10 5 x 5 x 4", "hex8 14 x 14 x 14", "tet10 7 x 7 x 7"):
            self.step_of(block, 1.5, self.solve(block))

    def step_of(self, block, goal, one_solve):
        row, step = self.of("steps", block), self.step(block, "full")
        reference = row["steps"].get("cholmod") if row else None
        if step and reference and one_solve:
            self.add(f"{block}, `full`: step ÷ CHOLMOD's solve", goal, step / reference, one_solve / reference,
                     spread=self.spread(block, reference))

    def strands(self):
        for name, what, goal in (("planar_beam_step/128", "planar beam, 128 frames", 0.14),
                                 ("divided_beam_step/128", "beam in space, 128 frames", 0.45),
                                 ("planar_beam_step/2048", "planar beam, 2048 frames", 2.5),
                                 ("divided_beam_step/2048", "beam in space, 2048 frames", 8.0),
                                 ("rigid_chain_step/1000", "rigid chain, 1000 links", 1.5),
                                 ("divided_tree_step/11", "tree of 2047 divided beams", 15.0)):
            if name in self.named:
                row = self.named[name]
                self.add(f"{what}: step", goal, 1e3 * row["seconds"], peer=PEERS.get(name, "–"), unit=" ms",
                         spread=self.range(row, 1e3))
        for count in (10000, 100000):
            row = self.named.get(f"rigid_chain_step/{count}")
            if row:
                links = f"{count:,}".replace(",", " ")
                self.add(f"rigid chain, {links} links: per link", 2.0, 1e6 * row["seconds"] / count, unit=" µs",
                         spread=self.range(row, 1e6 / count))

    def variants(self):
        for block, row in self.blocks.get("variants", {}).items():
            for level in ("none", "full"):
                times = row[level]
                for count, goal in (("6", 1.4), ("32", 4.0)):
                    one = self.solve(block)
                    if count not in times or one is None:
                        continue
                    many = self.solve(block, count)
                    # As if an additional variant had nothing but its column of the solve.
                    bound = (times["1"] + many - one) / times["1"]
                    self.add(f"{block}, `{level}`: {count} variants ÷ one", goal, times[count] / times["1"], bound)

    def factors(self):
        for block in ("hex8 274 x 10 x 10", "tet10 137 x 5 x 5", "hex8 31 x 31 x 31", "tet10 16 x 16 x 15"):
            row = self.of("solves", block)
            if not row or not isinstance(row["factorisation"], dict) or "cholmod" not in row:
                continue
            for threads, goal in (("1", 1.0), ("2", 0.55)):
                self.add(f"{block}: factor on {threads} thread{'s' if threads == '2' else ''} ÷ CHOLMOD's on one", goal,
                         row["factorisation"][threads] / row["cholmod"]["factorisation"])

    def threads(self):
        goal = 1.0 / (2 * 0.9)  # an efficiency of 0.9
        for block in ("hex8 274 x 10 x 10", "tet10 137 x 5 x 5", "hex8 31 x 31 x 31", "tet10 16 x 16 x 15"):
            one, two = self.step(block, "full"), self.step(block, "full", 2)
            tree = self.of("tree", block)
            share = next((t["share"] for t in tree["by_threads"] if t["threads"] == 2), None) if tree else None
            bandwidth = (self.of("solves", block) or {}).get("bandwidth")
            if one and two:
                bounds = [share, bandwidth["1"] / bandwidth["2"] if bandwidth else None]
                self.add(f"{block}, `full`: step on 2 threads ÷ on one", goal, two / one,
                         max((b for b in bounds if b), default=None))

    def preparation(self):
        rows = self.preparations
        for block in sorted({block for block, _, _ in rows}):
            one, two = rows.get((block, 1, False)), rows.get((block, 2, False))
            if one and two:
                self.add(f"{block}: set-up on 2 threads ÷ on one", 1.0 / (2 * 0.9), two["seconds"] / one["seconds"])
            stored = rows.get((block, 2, True))
            if stored and stored["dof"] > 200000:
                self.add(f"{block}: first step with a stored factor", 10.0, stored["seconds"], unit=" s", spread=self.range(stored, 1.0))

    def modes(self):
        for block, goal in (("hex8 274 x 10 x 10", 7.0), ("tet10 137 x 5 x 5", 7.0), ("hex8 31 x 31 x 31", 15.0),
                            ("tet10 16 x 16 x 15", 15.0)):
            for threads in ("", " on two threads"):
                row = self.of("modes" + threads, block)
                if row and "seconds" in row:
                    self.add(f"{block}: 20 free vibrations{threads}", goal, row["seconds"], unit=" s", spread=self.range(row, 1.0))


def goal_rows(results):
    goals = Goals(results)
    for part in (goals.full_coupling, goals.strands, goals.variants, goals.threads, goals.preparation, goals.factors, goals.modes):
        part()
    return goals.rows
