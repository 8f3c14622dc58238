# SPDX-License-Identifier: Apache-2.0
"""Rigid contact of the other pairs: spheres on all solids and in bores, pins, capsules, cylinders; exact motions."""

import math

import numpy
import pytest

G = 9.81


def columns(out, name):
    return numpy.stack([out[f"{name}.{axis}"] for axis in "xyz"], axis=1)


SWING = """
buckens: 1
gravity: [0, 0, -9.81]
bodies: {ball: {rigid: {mass: 1 kg, inertia: [4e-3, 4e-3, 4e-3]}, at: {position: ["0.9*sin(pi/3)", 0, "-0.9*cos(pi/3)"]}}}
loads: {bore: {contact: {between: [ground, ball], shapes: [{bore: {radius: 1, axis: [0, 1, 0]}}, {sphere: 0.1}], static: 0.8}}}
initial: {bodies: {ball: {velocity: [0, 0.3, 0], angular-velocity: [-1.5, 0, -2.598076211353316]}}}
simulation: {duration: 1 s, step: STEP}
output: {every: 20 ms, sensors: {p: {position: ball}, v: {velocity: ball}, w: {angular-velocity: ball}, c: {contact: bore}, lost: {energy: dissipated}, balance: {energy: balance}}}
"""


def rolling_in_a_bore(times, radius, ball, angle, speed):
    """Swing a from the lowest line, its rate, way y along the bore, its rate, spin n about the normal.

    7/5 r a'' = -g sin a, y'' = 2/7 b n a', n' = -y' a'/b (Routh 1905, rough spheres in cylinders), by Runge and Kutta."""
    def rates(s):
        a, a_rate, _, y_rate, n = s
        return numpy.array([a_rate, -5 / 7 * G / radius * math.sin(a), y_rate, 2 / 7 * ball * n * a_rate, -y_rate * a_rate / ball])
    s, h, out = numpy.array([angle, 0, 0, speed, 0.0]), 2e-3, []
    for k in range(1 + round(times[-1] / h)):
        if k % round(times[1] / h) == 0:
            out.append(s)
        k1 = rates(s)
        k2 = rates(s + h / 2 * k1)
        k3 = rates(s + h / 2 * k2)
        s = s + h / 6 * (k1 + 2 * k2 + 2 * k3 + rates(s + h * k3))
    return numpy.array(out)


def test_a_ball_rolls_in_a_bore_and_along_it(sensors):
    errors = []
    for step in ("2 ms", "1 ms"):
        out = sensors(SWING.replace("STEP", step))
        p, v, w = columns(out, "p"), columns(out, "v"), columns(out, "w")
        assert numpy.hypot(p[:, 0], p[:, 2]) == pytest.approx(0.9, abs=1e-8)
        # It rolls: the place of the ball that touches stands still.
        assert numpy.abs(v + numpy.cross(w, p * [1, 0, 1] / 9)).max() < 1e-8
        exact = rolling_in_a_bore(out["t"], 0.9, 0.1, math.pi / 3, 0.3)
        errors.append(numpy.abs(numpy.arctan2(p[:, 0], -p[:, 2]) - exact[:, 0]).max() + numpy.abs(p[:, 1] - exact[:, 2]).max())
    assert errors[1] < 1e-4
    assert errors[0] / errors[1] == pytest.approx(4, abs=0.5)


# Bodies that strike free solids of 3 kg, one pair after the other.
BLOW = """
buckens: 1
bodies:
BODIES
loads:
LOADS
initial:
  bodies:
INITIAL
simulation: {duration: 15 ms, step: 0.1 ms}
output:
  every: 0.1 ms
  sensors:
    lost: {energy: dissipated}
    balance: {energy: balance}
SENSORS
"""


def turn(axis, angle):
    x, y, z = numpy.array(axis) / numpy.linalg.norm(axis)
    K = numpy.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return numpy.eye(3) + math.sin(angle) * K + (1 - math.cos(angle)) * K @ K


BALL, ROD, BRICK = "{sphere: 0.1}", "{capsule: {radius: 0.1, length: 0.6, axis: [1, 0, 0]}}", "{box: [0.3, 0.4, 0.2]}"
BOX, TUBE, PILL = "{box: [0.6, 0.4, 0.2]}", "{cylinder: {radius: 0.2, length: 0.5}}", "{capsule: {radius: 0.2, length: 0.5}}"
EVEN, ON_CORNER, ON_EDGE = ([0, 0, 1], 0.0), ([1, -1, 0], 0.6), ([0, 1, 0], 0.5)
# Edges along y of the solid and along x of the body that cross, both turned about their own edge.
ACROSS = ([0, 1, 0], math.atan2(0.6, 0.8))
# Rods whose axis x is at right angles to the normal, which their axis z is turned to.
ON_TIP, ON_SIDE, ON_RIM = ([-1, 1, 0], math.acos(1 / 3)), ([-0.8, 0.6, 0], math.pi / 2), ([0, 1, 0], math.acos(0.6))
BESIDE = [0.12, 0, -0.1]

BLOWS = {
    "box-face": (BOX, BALL, EVEN, [0.1, 0.05, 0.1], None, [0, 0, 1]),
    "box-edge": (BOX, BALL, EVEN, [0.3, 0.1, 0.1], None, [0.6, 0, 0.8]),
    "box-corner": (BOX, BALL, EVEN, [-0.3, 0.2, 0.1], None, [-2 / 3, 2 / 3, 1 / 3]),
    "cylinder-side": (TUBE, BALL, EVEN, [0.12, 0.16, 0.1], None, [0.6, 0.8, 0]),
    "cylinder-end": (TUBE, BALL, EVEN, [0.05, -0.1, -0.25], None, [0, 0, -1]),
    "cylinder-rim": (TUBE, BALL, EVEN, [0.2, 0, 0.25], None, [0.8, 0, 0.6]),
    "capsule-side": (PILL, BALL, EVEN, [0, 0.2, -0.1], None, [0, 1, 0]),
    "capsule-end": (PILL, BALL, EVEN, [0.12, 0, 0.41], None, [0.6, 0, 0.8]),
    "capsules-crossing": (PILL, ROD, EVEN, [0, 0.2, -0.1], [0.15, -0.1, 0], [0, 1, 0]),
    "capsules-end": (PILL, ROD, EVEN, [-0.2, 0, 0.1], [0.4, 0, 0], [-1, 0, 0]),
    "rod-on-edge": (BOX, ROD, ACROSS, [0.3, 0.1, 0.1], turn(*ACROSS) @ BESIDE, [0.6, 0, 0.8]),
    "rod-on-corner": (BOX, ROD, ON_TIP, [0.3, 0.2, 0.1], turn(*ON_TIP) @ BESIDE, [2 / 3, 2 / 3, 1 / 3]),
    "rod-across-cylinder": (TUBE, ROD, ON_SIDE, [0.12, 0.16, 0.1], turn(*ON_SIDE) @ BESIDE, [0.6, 0.8, 0]),
    "rod-on-rim": (TUBE, ROD, ON_RIM, [0.2, 0, 0.25], turn(*ON_RIM) @ BESIDE, [0.8, 0, 0.6]),
    "corner-on-face": (BOX, BRICK, ON_CORNER, [0.1, 0.05, 0.1], turn(*ON_CORNER) @ [-0.15, -0.2, -0.1], [0, 0, 1]),
    "edges": (BOX, BRICK, ACROSS, [0.3, 0.05, 0.1], turn(*ACROSS) @ turn([1, 0, 0], 0.6) @ [0.05, -0.2, -0.1], [0.6, 0, 0.8]),
}


class Blow:
    """`foot` is the place from the middle of the solid, `arm` from that of the body, n the normal."""

    spin, inertia = numpy.array([0.2, -0.3, 0.4]), numpy.array([0.04, 0.05, 0.06])

    def __init__(self, name, number):
        self.shape, self.second, (axis, angle), foot, arm, n = BLOWS[name]
        self.foot, self.n = numpy.array(foot), numpy.array(n)
        self.arm = -0.1 * self.n if arm is None else numpy.array(arm)
        self.whole = turn(axis, angle) @ turn([1, 0, 0], 0.6 if name == "edges" else 0)
        self.velocity = numpy.array([1, -0.5, 1.5])
        self.velocity += (-2 - self.velocity @ n - numpy.cross(self.spin, self.arm) @ n) * self.n
        self.instant, self.at, self.number = 10.05e-3 + 0.3e-3 * number, numpy.array([0, 5 * number, 0]), number

    def parts(self, mu):
        """Lines of the model; they touch at the instant."""
        def text(x):
            return str([float(value) for value in x])
        size = numpy.linalg.norm(self.spin)
        start = turn(self.spin, -self.instant * size) @ self.whole
        angle = math.acos((numpy.trace(start) - 1) / 2)
        axis = [start[2, 1] - start[1, 2], start[0, 2] - start[2, 0], start[1, 0] - start[0, 1]]
        k, place = self.number, self.at + self.foot - self.arm - self.instant * self.velocity
        return (f"  s{k}: {{rigid: {{mass: 3 kg, inertia: {text(self.inertia)}}}, at: {{position: {text(self.at)}}}}}\n"
                f"  o{k}: {{rigid: {{mass: 2 kg, inertia: [8e-3, 8e-3, 8e-3]}}, at: {{position: {text(place)}, orientation: {{axis: {text(axis)}, angle: {angle!r}}}}}}}",
                f"  c{k}: {{contact: {{between: [s{k}, o{k}], shapes: [{self.shape}, {self.second}], restitution: 0.6, static: {mu}}}}}",
                f"    o{k}: {{velocity: {text(self.velocity)}, angular-velocity: {text(start.T @ self.spin)}}}",
                "\n".join(f"    {kind}{one}{k}: {{{key}: {one}{k}}}" for kind, key in (("v", "velocity"), ("w", "angular-velocity")) for one in "so"))

    def impulse(self, mu):
        """By hand, and the energy lost."""
        def answer(P):  # jump of the velocity of the body over the solid at the place
            return (P / 2 + P / 3 + numpy.cross(numpy.cross(self.foot, P) / self.inertia, self.foot)
                    + numpy.cross(numpy.cross(self.arm, P) / 8e-3, self.arm))
        t1 = numpy.cross(self.n, [0.1, 0.2, 0.97] if abs(self.n[2]) < 0.7 else [0.97, 0.2, 0.1])
        t1 /= numpy.linalg.norm(t1)
        T = numpy.stack([self.n, t1, numpy.cross(self.n, t1)], axis=1)
        A = T.T @ numpy.stack([answer(e) for e in T.T], axis=1)
        v = T.T @ (self.velocity + numpy.cross(self.spin, self.arm))
        P = numpy.linalg.solve(A, -v - numpy.array([0.6 * v[0], 0, 0]))
        if numpy.hypot(P[1], P[2]) > mu * P[0]:
            u = -v[1:] / numpy.hypot(v[1], v[2])
            for _ in range(300):  # against the slip that is left
                P = -1.6 * v[0] / (A[0, 0] + mu * A[0, 1:] @ u) * numpy.array([1, mu * u[0], mu * u[1]])
                left = (v + A @ P)[1:]
                u = 0.7 * u - 0.3 * left / numpy.linalg.norm(left)
                u /= numpy.linalg.norm(u)
        return T @ P, -P @ (v + A @ P / 2)


@pytest.mark.parametrize("mu", [0, 0.1, 2])
def test_bodies_strike_free_solids(sensors, mu):
    blows = [Blow(name, k) for k, name in enumerate(BLOWS)]
    model = BLOW
    for word, lines in zip(("BODIES", "LOADS", "INITIAL", "SENSORS"), zip(*(blow.parts(mu) for blow in blows))):
        model = model.replace(word, "\n".join(lines))
    out = sensors(model)
    lost = 0
    for name, blow in zip(BLOWS, blows):
        k, (P, own) = blow.number, blow.impulse(mu)
        after = numpy.flatnonzero(out["t"] > blow.instant + 1e-5)[0]
        # The place of the impact is that of its step, whose bodies turn by 1e-4.
        assert columns(out, f"vo{k}")[after] == pytest.approx(blow.velocity + P / 2, abs=3e-4), name
        assert columns(out, f"vs{k}")[after] == pytest.approx(-P / 3, abs=3e-4), name
        assert columns(out, f"wo{k}")[after] == pytest.approx(blow.spin + numpy.cross(blow.arm, P) / 8e-3, abs=3e-2), name
        assert columns(out, f"ws{k}")[after] == pytest.approx(numpy.cross(blow.foot, -P) / blow.inertia, abs=2e-2), name
        momentum = 2 * columns(out, f"vo{k}") + 3 * columns(out, f"vs{k}")
        assert momentum == pytest.approx(numpy.tile(2 * blow.velocity, (len(momentum), 1)), abs=1e-12), name
        lost += own
        assert out["lost"][after] == pytest.approx(lost, rel=1e-3, abs=1e-9), name
    assert numpy.abs(out["balance"]).max() < 1e-5


# Gravity of an incline of 30 degrees, its plane being the ground; solid cylinders of 0.1 m.
SLOPE = f"""
buckens: 1
gravity: [{G / 2}, 0, {-G * math.sqrt(3) / 2}]
bodies:
  rolls: {{rigid: {{mass: 2 kg, inertia: [0.02, 0.01, 0.02]}}, at: {{position: [0, 0, 0.1]}}}}
  slips: {{rigid: {{mass: 2 kg, inertia: [0.02, 0.01, 0.02]}}, at: {{position: [0, 1, 0.1]}}}}
  slides: {{rigid: {{mass: 2 kg, inertia: [0.02, 0.02, 0.01]}}, at: {{position: [0, 2, 0.08]}}}}
  stands: {{rigid: {{mass: 2 kg, inertia: [0.02, 0.02, 0.01]}}, at: {{position: [0, 3, 0.08]}}}}
loads:
  c1: {{contact: {{between: [ground, rolls], shapes: [{{plane: {{}}}}, {{cylinder: {{radius: 0.1, length: 0.3, axis: [0, 1, 0]}}}}], static: 0.193}}}}
  c2: {{contact: {{between: [slips, ground], shapes: [{{cylinder: {{radius: 0.1, length: 0.3, axis: [0, 1, 0]}}}}, {{plane: {{}}}}], static: 0.19}}}}
  c3: {{contact: {{between: [ground, slides], shapes: [{{plane: {{}}}}, {{cylinder: {{radius: 0.1, length: 0.16}}}}], static: 0.3}}}}
  c4: {{contact: {{between: [ground, stands], shapes: [{{plane: {{}}}}, {{cylinder: {{radius: 0.1, length: 0.16}}}}], static: 0.7}}}}
simulation: {{duration: 1 s, step: 4 ms}}
output:
  every: 20 ms
  sensors:
    rolls: {{position: rolls}}
    turns: {{angular-velocity: rolls}}
    slips: {{position: slips}}
    slides: {{position: slides}}
    tilts: {{angular-velocity: slides}}
    stands: {{position: stands}}
    a: {{contact: c1}}
    b: {{contact: c4}}
    balance: {{energy: balance}}
    lost: {{energy: dissipated}}
"""


def test_cylinders_on_an_incline_roll_slide_and_stand(sensors):
    out = sensors(SLOPE)
    t, slope, weight = out["t"], G / 2, G * math.sqrt(3) / 2
    # Above 1/3 tan 30 = 0.19245 a solid cylinder rolls with 2/3 of the slope.
    assert out["rolls.x"] == pytest.approx(slope / 3 * t**2, abs=1e-10)
    assert out["turns.y"] == pytest.approx(2 / 3 * slope / 0.1 * t, abs=1e-9)
    assert out["a.normal"][1:] == pytest.approx(2 * weight, rel=1e-9)
    assert out["a.friction"][1:] == pytest.approx(2 * slope / 3, rel=1e-9)
    assert out["slips.x"] == pytest.approx(0.5 * (slope - 0.19 * weight) * t**2, abs=1e-9)
    assert out["slides.x"] == pytest.approx(0.5 * (slope - 0.3 * weight) * t**2, abs=1e-9)
    assert numpy.abs(out["tilts.y"]).max() < 1e-9
    assert numpy.abs(out["stands.x"]).max() < 1e-12
    assert out["b.friction"][1:] == pytest.approx(2 * slope, rel=1e-9)
    assert numpy.abs(out["balance"]).max() < 1e-4 * out["lost"][-1]


def test_hoops_roll_down_an_incline_only_with_friction_of_half_its_slope(sensors):
    """J = m R²: friction m g sin 30/2 rolls it, so that it takes mu = tan 30/2 = 0.28867513; either side of the eighth digit but one."""
    limit = math.tan(math.pi / 6) / 2
    assert limit == pytest.approx(0.28867513, abs=5e-9)
    shares = (1 + 1e-7, 1 - 1e-7, 0.9)
    shape = "{cylinder: {radius: 0.1, length: 0.3, axis: [0, 1, 0]}}"
    bodies = "".join(f"  h{k}: {{rigid: {{mass: 2 kg, inertia: [0.03, 0.02, 0.03]}}, at: {{position: [0, {k}, 0.1]}}}}\n" for k in range(3))
    loads = "".join(f"  c{k}: {{contact: {{between: [ground, h{k}], shapes: [{{plane: {{}}}}, {shape}], static: {limit * share!r}}}}}\n"
                    for k, share in enumerate(shares))
    seen = ", ".join(f"p{k}: {{position: h{k}}}, w{k}: {{angular-velocity: h{k}}}" for k in range(3))
    out = sensors(f"buckens: 1\ngravity: [{G / 2}, 0, {-G * math.sqrt(3) / 2}]\nbodies:\n{bodies}loads:\n{loads}"
                  f"simulation: {{duration: 1 s, step: 4 ms}}\noutput: {{every: 20 ms, sensors: {{{seen}, balance: {{energy: balance}}}}}}\n")
    t = out["t"]
    for k, share in enumerate(shares):
        friction = min(share, 1) * G / 4  # per kg
        # Constant accelerations are integrated exactly.
        # What lets go by 1e-7 of its weight may stick in the first of 250 steps, short of 1e-9 m/s.
        assert out[f"p{k}.x"] == pytest.approx(0.5 * (G / 2 - friction) * t**2, abs=5e-10)
        assert out[f"w{k}.y"] == pytest.approx(friction / 0.1 * t, abs=5e-9)
    slip = [out[f"p{k}.x"][-1] - 0.1 * 0.5 * out[f"w{k}.y"][-1] for k in range(3)]
    # Slip grows by 2 (1 - share) g/4: of a ten-millionth, 2.5e-7 m after a second.
    assert abs(slip[0]) < 1e-10 and slip[1] == pytest.approx(G / 4 * 1e-7, rel=5e-3)
    assert numpy.abs(out["balance"]).max() < 1e-5


def test_a_wheel_leans_and_rolls_in_a_circle(sensors):
    """Steady: dH/dt = W z x H is the moment of the force in the place that touches, which stands still."""
    m, R, half, lean, radius = 1.0, 0.1, 0.01, math.radians(20), 0.5
    across, along = m * R * R / 4, m * R * R / 2
    a = numpy.array([math.cos(lean), 0, math.sin(lean)])
    l = -half * a + R * numpy.array([math.sin(lean), 0, -math.cos(lean)])
    z = numpy.array([0, 0, 1])
    spin = -(radius + numpy.cross(z, l)[1]) / numpy.cross(a, l)[1]  # per W
    w = z + spin * a
    H = across * (w - (w @ a) * a) + along * (w @ a) * a
    # Per W^2 and from the weight.
    W2 = numpy.cross(l, [0, 0, m * G])[1] / (numpy.cross(z, H) - numpy.cross(l, [-m * radius, 0, 0]))[1]
    W = math.sqrt(W2)
    own = W * turn([0, 1, 0], lean - math.pi / 2) @ w  # in axes of the body
    errors = []
    for step in (2e-3, 1e-3):
        out = sensors(f"""
buckens: 1
gravity: [0, 0, {-G}]
bodies: {{wheel: {{rigid: {{mass: {m}, inertia: [{across}, {across}, {along}]}}, at: {{position: [{radius}, 0, {-l[2]}], orientation: {{axis: [0, 1, 0], angle: {math.pi / 2 - lean}}}}}}}}}
loads: {{floor: {{contact: {{between: [ground, wheel], shapes: [{{plane: {{}}}}, {{cylinder: {{radius: {R}, length: {2 * half}}}}}], static: 0.6}}}}}}
initial: {{bodies: {{wheel: {{velocity: [0, {W * radius}, 0], angular-velocity: [{own[0]}, 0, {own[2]}]}}}}}}
simulation: {{duration: 1 s, step: {step}}}
output: {{every: 20 ms, sensors: {{p: {{position: wheel}}, c: {{contact: floor}}, lost: {{energy: dissipated}}, balance: {{energy: balance}}}}}}
""")
        t = out["t"]
        path = radius * numpy.stack([numpy.cos(W * t), numpy.sin(W * t), -l[2] / radius + 0 * t], axis=1)
        errors.append(numpy.abs(columns(out, "p") - path).max())
    assert errors[1] < 1e-4
    assert errors[0] / errors[1] == pytest.approx(4, abs=1)
    assert out["c.normal"][1:] == pytest.approx(m * G, rel=1e-3)
    assert out["c.friction"][1:] == pytest.approx(m * W2 * radius, rel=1e-2)


def test_a_cylinder_falls_on_its_end(sensors):
    out = sensors("""
buckens: 1
gravity: [0, 0, -9.81]
bodies: {drum: {rigid: {mass: 3 kg, inertia: [0.03, 0.03, 0.015]}, at: {position: [0, 0, 0.4]}}}
loads: {a: {contact: {between: [ground, drum], shapes: [{plane: {}}, {cylinder: {radius: 0.1, length: 0.2}}], restitution: 0.5}}}
simulation: {duration: 0.8 s, step: 1 ms}
output: {every: 5 ms, sensors: {p: {position: drum}, w: {angular-velocity: drum}, c: {contact: a}, balance: {energy: balance}}}
""")
    t, first = out["t"], math.sqrt(2 * 0.3 / G)
    flies = (t > first + 1e-3) & (t < 2 * first - 1e-3)
    since = t[flies] - first
    assert out["p.z"][flies] == pytest.approx(0.1 + 0.5 * G * first * since - G / 2 * since**2, abs=1e-9)
    assert numpy.abs(out["w.x"]).max() < 1e-8 and numpy.abs(out["w.y"]).max() < 1e-8


def test_a_pin_bounces_in_a_bore_and_jams_under_a_couple(sensors):
    out = sensors("""
buckens: 1
gravity: [0, 0, -9.81]
bodies:
  pin: {rigid: {mass: 0.2 kg, inertia: [1e-5, 1e-5, 1e-5]}, at: {position: [0, 0, 0]}}
  tilts: {rigid: {mass: 0.2 kg, inertia: [1e-4, 1e-5, 1e-4]}, at: {position: [1, 0, 0]}}
loads:
  a: {contact: {between: [ground, pin], shapes: [{bore: {radius: 10.2 mm, axis: [0, 1, 0]}}, {cylinder: {radius: 10 mm, length: 30 mm, axis: [0, 1, 0]}}], restitution: 0.8}}
  b: {contact: {between: [{ground: [1, 0, 0]}, tilts], shapes: [{bore: {radius: 10.2 mm, axis: [0, 1, 0]}}, {cylinder: {radius: 10 mm, length: 30 mm, axis: [0, 1, 0]}}]}}
  couple: {torque: {on: tilts, value: [3, 0, 0]}}
simulation: {duration: 50 ms, step: 0.1 ms}
output: {every: 0.5 ms, sensors: {p: {position: pin}, w: {angular-velocity: pin}, r: {rotation: tilts}, q: {position: tilts}, c: {contact: b}, balance: {energy: balance}}}
""")
    t, c = out["t"], 2e-4
    z, speed, start = [], 0.0, 0.0
    height = c  # above the lowest place, of the pin's middle
    for now in t:
        while True:
            lands = start + (speed + math.sqrt(speed**2 + 2 * G * height)) / G
            if now <= lands:
                break
            speed, start, height = 0.8 * math.sqrt(speed**2 + 2 * G * height), lands, 0.0
        z.append(height + speed * (now - start) - G / 2 * (now - start)**2 - c)
    assert out["p.z"] == pytest.approx(numpy.array(z), abs=1e-10)
    assert numpy.abs(out["w.x"]).max() < 1e-7
    # Both ends on opposite sides; 0.2 of the force against the weight comes from below.
    assert out["c.normal"][-1] == pytest.approx(2 * 3 / 0.03, rel=1e-3)
    assert out["r.x"][-1] == pytest.approx(math.asin(c / 0.015), rel=1e-3)
    assert numpy.abs(out["balance"]).max() < 0.01 * 3 * out["r.x"][-1]


def test_capsules_lie_on_each_other(sensors):
    """One in the groove between two others, another across both of them."""
    out = sensors("""
buckens: 1
gravity: [0, 0, -9.81]
bodies:
  log: {rigid: {mass: 2 kg, inertia: [0.03, 0.01, 0.03]}, at: {position: [0, 0, "0.2*sqrt(3)/2"]}}
  bar: {rigid: {mass: 3 kg, inertia: [0.01, 0.03, 0.03]}, at: {position: [0.02, 2, 0.2]}}
loads:
  a: {contact: {between: [{ground: [-0.1, 0, 0]}, log], shapes: [{capsule: {radius: 0.1, length: 0.4, axis: [0, 1, 0]}}, {capsule: {radius: 0.1, length: 0.3, axis: [0, 1, 0]}}], static: 0.5}}
  b: {contact: {between: [{ground: [0.1, 0, 0]}, log], shapes: [{capsule: {radius: 0.1, length: 0.4, axis: [0, 1, 0]}}, {capsule: {radius: 0.1, length: 0.3, axis: [0, 1, 0]}}], static: 0.5}}
  c: {contact: {between: [{ground: [-0.1, 2, 0]}, bar], shapes: [{capsule: {radius: 0.1, length: 0.4, axis: [0, 1, 0]}}, {capsule: {radius: 0.1, length: 0.3, axis: [1, 0, 0]}}], static: 0.5}}
  d: {contact: {between: [{ground: [0.1, 2, 0]}, bar], shapes: [{capsule: {radius: 0.1, length: 0.4, axis: [0, 1, 0]}}, {capsule: {radius: 0.1, length: 0.3, axis: [1, 0, 0]}}], static: 0.5}}
simulation: {duration: 0.5 s, step: 5 ms}
output: {every: 50 ms, sensors: {log: {position: log}, bar: {position: bar}, a: {contact: a}, b: {contact: b}, c: {contact: c}, d: {contact: d}, balance: {energy: balance}}}
""")
    assert numpy.abs(columns(out, "log") - [0, 0, 0.1 * math.sqrt(3)]).max() < 1e-10
    assert numpy.abs(columns(out, "bar") - [0.02, 2, 0.2]).max() < 1e-10
    # The vertical part of both sides carries the log; friction, if any, has the same sign on both.
    assert out["a.normal"][1:] == pytest.approx(out["b.normal"][1:], rel=1e-6)
    assert out["c.normal"][1:] == pytest.approx(3 * G * 0.4, rel=1e-9)
    assert out["d.normal"][1:] == pytest.approx(3 * G * 0.6, rel=1e-9)


def test_a_block_slides_on_a_board_until_both_go_on_together(sensors):
    """The board, on a smooth floor, has its speed from friction alone."""
    out = sensors("""
buckens: 1
planar: zx
gravity: [0, 0, -9.81]
bodies:
  board: {rigid: {mass: 4 kg, inertia: [0.1, 0.4, 0.5]}, at: {position: [0, 0, 0.05]}}
  block: {rigid: {mass: 1 kg, inertia: [4e-3, 5e-3, 6e-3]}, at: {position: [-0.2, 0, 0.2]}}
loads:
  floor: {contact: {between: [ground, board], shapes: [{plane: [0, 0, 1]}, {box: [1, 0.3, 0.1]}]}}
  top: {contact: {between: [board, block], shapes: [{box: [1, 0.3, 0.1]}, {box: [0.2, 0.1, 0.2]}], static: 0.3}}
initial: {bodies: {block: {velocity: [1.2, 0, 0]}}}
simulation: {duration: 0.6 s, step: 2 ms}
output: {every: 10 ms, sensors: {a: {velocity: board}, b: {velocity: block}, p: {position: block}, w: {angular-velocity: block}, c: {contact: top}, f: {contact: floor}, lost: {energy: dissipated}, balance: {energy: balance}}}
""")
    t = out["t"]
    end = 1.2 / (0.3 * G * 1.25)
    slides = (t > 0) & (t < end - 3e-3)
    # Both are put down in the first step, with friction in the blow; from there on they slow down exactly.
    assert numpy.diff(out["a.x"][slides]) == pytest.approx(0.3 * G / 4 * 0.01, abs=1e-8)
    assert numpy.diff(out["b.x"][slides]) == pytest.approx(-0.3 * G * 0.01, abs=1e-8)
    assert out["a.x"][slides] == pytest.approx(0.3 * G / 4 * t[slides], abs=0.3 * G / 4 * 2e-3)
    assert 4 * out["a.x"] + out["b.x"] == pytest.approx(numpy.full(len(t), 1.2), abs=1e-10)
    assert out["a.x"][t > end + 3e-3] == pytest.approx(0.24, abs=1e-9)
    assert out["b.x"][t > end + 3e-3] == pytest.approx(0.24, abs=1e-9)
    assert numpy.abs(out["w.y"]).max() < 1e-8
    assert out["p.z"] == pytest.approx(numpy.full(len(t), 0.2), abs=1e-10)
    # What the first step leaves in the multipliers dies out like those of the method.
    assert out["c.normal"][1:] == pytest.approx(G, rel=5e-4)
    assert out["f.normal"][1:] == pytest.approx(5 * G, rel=5e-4)
    assert out["c.normal"][-1] == pytest.approx(G, rel=1e-7)
    # The steps in which sliding begins and ends: mu g h of 1.2 m/s, once more or less.
    assert out["lost"][-1] == pytest.approx(0.5 * 0.8 * 1.2**2, rel=2e-3)
    assert numpy.abs(out["balance"]).max() < 1e-3


def test_a_block_slides_on_a_box_and_stops(sensors):
    out = sensors("""
buckens: 1
gravity: [0, 0, -9.81]
bodies: {block: {rigid: {mass: 1 kg, inertia: [4e-3, 5e-3, 6e-3]}, at: {position: [-0.2, 0, 0.2]}}}
loads: {top: {contact: {between: [{ground: [0, 0, 0.05]}, block], shapes: [{box: [1, 0.3, 0.1]}, {box: [0.2, 0.1, 0.2]}], static: 0.3}}}
initial: {bodies: {block: {velocity: [1.2, 0, 0]}}}
simulation: {duration: 0.5 s, step: 2 ms}
output: {every: 10 ms, sensors: {v: {velocity: block}, p: {position: block}, w: {angular-velocity: block}, c: {contact: top}}}
""")
    end = 1.2 / (0.3 * G)
    slides = out["t"] < end - 3e-3
    assert out["v.x"][slides] == pytest.approx(1.2 - 0.3 * G * out["t"][slides], abs=1e-9)
    assert numpy.abs(out["v.x"][out["t"] > end + 3e-3]).max() < 1e-12
    assert out["p.x"][-1] == pytest.approx(-0.2 + 1.2 * end / 2, abs=0.3 * G * 2e-3**2)
    assert numpy.abs(out["w.y"]).max() < 1e-12
    assert out["c.normal"][1:] == pytest.approx(G, rel=1e-9)


STACK = """
buckens: 1
gravity: [0, 0, -9.81]
bodies:
  under: {rigid: {mass: 2 kg, inertia: [0.01, 0.02, 0.03]}, at: {position: [0, 0, 0.1]}}
  over: {rigid: {mass: 1 kg, inertia: [0.01, 0.02, 0.03]}, at: {position: [SHIFT, 0, HEIGHT], orientation: {axis: [0, 0, 1], angle: ANGLE}}}
loads:
  floor: {contact: {between: [ground, under], shapes: [{plane: {}}, {box: [0.6, 0.2, 0.2]}], static: 0.5}}
  c: {contact: {between: [under, over], shapes: [{box: [0.6, 0.2, 0.2]}, {box: [0.6, 0.2, 0.2]}], static: 0.5, restitution: 0.5}}
simulation: {duration: DURATION, step: 2 ms}
output: {every: 10 ms, sensors: {p: {position: over}, w: {angular-velocity: over}, q: {position: under}, c: {contact: c}, f: {contact: floor}, lost: {energy: dissipated}, balance: {energy: balance}}}
"""


@pytest.mark.parametrize("shift, angle", [(0, 0), (0.29, 0), (0, 90), (0.1, 35), (0.01, 3)])
def test_a_box_rests_on_a_box(sensors, shift, angle):
    """In line, with an overhang, crosswise, askew."""
    out = sensors(STACK.replace("SHIFT", repr(shift)).replace("ANGLE", f"{angle} deg").replace("HEIGHT", "0.3").replace("DURATION", "0.1 s"))
    assert numpy.abs(columns(out, "p") - [shift, 0, 0.3]).max() < 1e-10
    assert numpy.abs(columns(out, "q") - [0, 0, 0.1]).max() < 1e-10
    assert out["c.normal"][1:] == pytest.approx(G, rel=1e-8)
    assert out["f.normal"][1:] == pytest.approx(3 * G, rel=1e-8)
    assert numpy.abs(out["balance"]).max() < 1e-9


def test_a_box_that_hangs_over_too_far_falls(sensors):
    """It turns about the edge of the other: (I + m (c^2 + b^2)) w' = m g c at first."""
    out = sensors("""
buckens: 1
gravity: [0, 0, -9.81]
bodies: {over: {rigid: {mass: 1 kg, inertia: [0.01, 0.02, 0.03]}, at: {position: [0.32, 0, 0.3]}}}
loads: {c: {contact: {between: [{ground: [0, 0, 0.1]}, over], shapes: [{box: [0.6, 0.3, 0.2]}, {box: [0.6, 0.2, 0.2]}], static: 0.8}}}
simulation: {duration: 60 ms, step: 2 ms}
output: {every: 2 ms, sensors: {w: {angular-velocity: over}, c: {contact: c}, balance: {energy: balance}}}
""")
    angular = G * 0.02 / (0.02 + 0.02**2 + 0.1**2)
    assert out["w.y"][1:] == pytest.approx(angular * out["t"][1:], rel=2e-2)
    assert numpy.abs(out["w.x"]).max() < 1e-9
    assert numpy.abs(out["balance"]).max() < 1e-4


def test_a_box_falls_on_a_box_and_comes_to_rest(sensors):
    out = sensors(STACK.replace("SHIFT", "0").replace("ANGLE", "90 deg").replace("HEIGHT", "0.4").replace("DURATION", "0.9 s"))
    t, first = out["t"], math.sqrt(2 * 0.1 / G)
    assert out["p.z"][t < first] == pytest.approx(0.4 - G / 2 * t[t < first]**2, abs=1e-10)
    # The floor takes part in the blow: the lower one stays where it is.
    flies = (t > first + 2e-3) & (t < 2 * first - 2e-3)
    since = t[flies] - first
    assert out["p.z"][flies] == pytest.approx(0.3 + 0.5 * G * first * since - G / 2 * since**2, abs=1e-8)
    assert out["p.z"][-1] == pytest.approx(0.3, abs=1e-9)
    assert numpy.abs(out["w.x"]).max() < 1e-7
    assert out["lost"][-1] == pytest.approx(G * 0.1, rel=1e-3)
    assert numpy.abs(out["balance"]).max() < 1e-3


def test_planar_models_have_these_pairs_too(sensors):
    """Against shapes on the ground, without friction and mostly through mass centres: v' = v - 1.6 (v.n) n."""
    out = sensors("""
buckens: 1
planar: zx
bodies:
  ball: {rigid: {mass: 2 kg, inertia: [0.01, 0.01, 0.01]}, at: {position: [0.38, 0, 0.22]}}
  disc: {rigid: {mass: 2 kg, inertia: [0.01, 0.01, 0.01]}, at: {position: [2.08, 0, 0.5]}}
  rod: {rigid: {mass: 2 kg, inertia: [0.01, 0.01, 0.01]}, at: {position: [4.1, 0, 0.22]}}
  brick: {rigid: {mass: 2 kg, inertia: [0.01, 0.01, 0.01]}, at: {position: [6.25, 0, 0.32]}}
loads:
  a: {contact: {between: [ground, ball], shapes: [{box: [0.6, 1, 0.2]}, {sphere: 0.1}], restitution: 0.6}}
  b: {contact: {between: [{ground: [2, 0, 0]}, disc], shapes: [{capsule: {radius: 0.1, length: 0.6, axis: [0, 0, 1]}}, {sphere: 0.1}], restitution: 0.6}}
  c: {contact: {between: [{ground: [4, 0, 0]}, rod], shapes: [{capsule: {radius: 0.1, length: 0.6, axis: [1, 0, 0]}}, {capsule: {radius: 0.1, length: 0.4, axis: [1, 0, 0]}}], restitution: 0.6}}
  d: {contact: {between: [{ground: [6, 0, 0]}, brick], shapes: [{box: [0.4, 1, 0.4]}, {box: [0.4, 1, 0.2]}], restitution: 0.6}}
initial:
  bodies: {ball: {velocity: [-1, 0, -1]}, disc: {velocity: [0, 0, -1]}, rod: {velocity: [0.5, 0, -1]}, brick: {velocity: [0, 0, -1]}}
simulation: {duration: 60 ms, step: 0.1 ms}
output: {every: 1 ms, sensors: {a: {velocity: ball}, b: {velocity: disc}, c: {velocity: rod}, wc: {angular-velocity: rod}, d: {velocity: brick}, wd: {angular-velocity: brick}, balance: {energy: balance}}}
""")
    # Where the ball is 0.1 from the corner, and the disc 0.2 from the end of the axis.
    for name, at, way, corner, reach in (("a", [0.38, 0.22], [-1, -1], [0.3, 0.1], 0.1), ("b", [2.08, 0.5], [0, -1], [2, 0.3], 0.2)):
        r, v = numpy.array(at) - corner, numpy.array(way, float)
        b, c = r @ v, r @ r - reach**2
        n = (r + v * (-b - math.sqrt(b * b - v @ v * c)) / (v @ v)) / reach
        after = v - 1.6 * (v @ n) * n
        assert [out[f"{name}.x"][-1], out[f"{name}.z"][-1]] == pytest.approx(after, abs=1e-6)
    # Lying on each other along a line, which bounces off as a whole.
    assert out["c.z"][-1] == pytest.approx(0.6, abs=1e-9) and out["c.x"][-1] == pytest.approx(0.5, abs=1e-12)
    # The brick strikes 0.05 beside its middle, the edge of the other: its own corner leaves faster than that.
    P = 1.6 / (1 / 2 + 0.05**2 / 0.01)
    assert out["d.z"][-1] == pytest.approx(P / 2 - 1, abs=1e-9)
    assert out["wd.y"][-1] == pytest.approx(0.05 * P / 0.01, abs=1e-9)
    assert numpy.abs(out["balance"]).max() < 1e-6
