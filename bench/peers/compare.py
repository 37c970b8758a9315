"""The same four-bar sweep by this program and by its peers: the same numbers, and how long a position takes.

The crank-rocker of templates/ (100, 250, 200, 300 mm, 10 rad/s): position, velocity and acceleration of joint C. The ways
take turns, several times over; medians of the processor time count, which other work on the machine disturbs little. Run it by
run.sh, which installs the peers.
"""

import json
import math
import os
import statistics
import subprocess
import sys
import tempfile

os.environ.setdefault("MPLBACKEND", "Agg")
# One core for all: what is compared is the work of a position.
os.environ["RAYON_NUM_THREADS"] = "1"

import numpy as np
import pyarrow.parquet
from mechanism import Joint, Mechanism, Vector
from pylinkage.actuators import Crank
from pylinkage.components import Ground
from pylinkage.dyads import RRRDyad
from pylinkage.simulation import Linkage

A, B, C, D = 0.1, 0.25, 0.2, 0.3
OMEGA = 10.0
ROUNDS = 7
FIND = "x_C,y_C,v_C,a_C"
COLUMNS = ["x_C [m]", "y_C [m]", "v_C.x [m/s]", "v_C.y [m/s]", "a_C.x [m/s²]", "a_C.y [m/s²]"]


def hodograph(binary, scene, steps, folder, ending="npy"):
    """A whole command: start, read, compile, compute, write. Returns the path of the table."""
    out = os.path.join(folder, f"sweep.{ending}")
    subprocess.run([binary, "sweep", scene, "--steps", str(steps), "--find", FIND, "-o", out], check=True, stderr=subprocess.DEVNULL)
    return out


def by_pylinkage(steps):
    """Its numba solver, compiled before: positions, velocities, accelerations of the joints."""
    left, right = Ground(0.0, 0.0), Ground(D, 0.0)
    step = math.tau / steps
    crank = Crank(left, radius=A, angular_velocity=step, initial_angle=0.0)
    x, y = start()
    joint = RRRDyad(crank.output, right, distance1=B, distance2=C, x=x, y=y)
    linkage = Linkage([left, right, crank, joint])
    linkage.set_input_velocity(crank, OMEGA)
    linkage.compile()
    at = linkage.components.index(joint)
    return lambda: np.hstack([part[:, at, :] for part in linkage.step_fast_with_kinematics(steps)])


def start():
    """Joint C at crank angle 0, above the frame."""
    d = D - A
    along = (B * B - C * C + d * d) / (2 * d)
    return A + along, math.sqrt(B * B - along * along)


def by_mechanism(angles):
    """Its loop equations by fsolve: one solution for positions, one for velocities, one for accelerations."""
    o, b, c, d = (Joint(name) for name in "OBCD")
    crank = Vector((o, b), r=A)
    coupler, rocker = Vector((b, c), r=B), Vector((d, c), r=C)
    frame = Vector((o, d), r=D, theta=0.0)

    def loops(x, i):
        return (crank(i) + coupler(x[0]) - rocker(x[1]) - frame()).flatten()

    x, y = start()
    guess = np.array([math.atan2(y, x - A), math.atan2(y, x - D)])
    n = len(angles)
    m = Mechanism(
        vectors=(crank, coupler, rocker, frame), origin=o, loops=loops, pos=angles, vel=np.full(n, OMEGA), acc=np.zeros(n),
        guess=(guess, np.array([1.0, 1.0]), np.array([1.0, 1.0])),
    )
    m.iterate()
    return np.column_stack([c.x_positions, c.y_positions, c.x_velocities, c.y_velocities, c.x_accelerations, c.y_accelerations])


def timed(call):
    """Seconds of the processor, children included."""
    start = os.times()
    result = call()
    end = os.times()
    return sum(end[:4]) - sum(start[:4]), result


def difference(name, ours, theirs):
    """The largest difference, against the largest number of its kind."""
    off = max(np.abs(ours[:, k : k + 2] - theirs[:, k : k + 2]).max() / np.abs(ours[:, k : k + 2]).max() for k in (0, 2, 4))
    print(f"{name}: the same to {off:.1e} of the largest position, velocity, acceleration")


def table(path):
    array = np.load(path)
    return np.column_stack([array[c] for c in COLUMNS])


def main():
    binary, scene, library = sys.argv[1:4]
    fast, slow, turn_steps = 1_000_000, 360, 3_600
    with tempfile.TemporaryDirectory() as folder:
        turn = table(hodograph(binary, scene, slow, folder))
        arrow = pyarrow.parquet.read_table(hodograph(binary, scene, slow, folder, "parquet"))
        assert all(np.array_equal(arrow[c].to_numpy(), turn[:, k]) for k, c in enumerate(COLUMNS)), "Parquet differs from .npy"
        # pylinkage begins one step after the start; a turn later it is there again.
        theirs = by_pylinkage(slow)()
        difference("pylinkage", turn[1:], theirs)
        difference("mechanism", turn, by_mechanism(np.linspace(0.0, math.tau, slow + 1)))
        linkage = by_pylinkage(fast)
        times = {name: [] for name in ("compiled", "library", "cache", "long", "command", "pylinkage", "mechanism")}
        for _ in range(ROUNDS):
            turn_of = str(turn_steps)
            ways = {"cache": ["chunk"], "compiled": ["compiled", turn_of], "library": ["sweep", turn_of], "long": ["compiled", "100000"]}
            for name, arguments in ways.items():
                seconds, out = timed(lambda: subprocess.run([library, *arguments], check=True, capture_output=True, text=True))
                times[name].append(seconds / json.loads(out.stdout)["positions"])
            times["command"].append(timed(lambda: hodograph(binary, scene, fast, folder))[0] / (fast + 1))
            times["pylinkage"].append(timed(linkage)[0] / fast)
            times["mechanism"].append(timed(lambda: by_mechanism(np.linspace(0.0, math.tau, slow + 1)))[0] / (slow + 1))
    ns = {name: statistics.median(t) * 1e9 for name, t in times.items()}
    print("\n| position, velocity and acceleration of joint C | processor ns a position | times the compiled | times the command |")
    print("|---|---|---|---|")
    rows = [
        ("cache", "hodograph, library, the compiled program in cache: computing alone, one core"),
        ("compiled", f"hodograph, library, compiled before, {turn_steps:,} positions again and again to a table in memory, one core"),
        ("long", "hodograph, library, compiled before, 100,000 positions again and again, the same"),
        ("library", f"hodograph, library, {turn_steps:,} positions again and again, scene to table in memory, one core"),
        ("command", f"hodograph sweep, {fast:,} positions, with starting and writing .npy, one core"),
        ("pylinkage", f"pylinkage with numba, compiled before, {fast:,} positions in memory"),
        ("mechanism", f"mechanism, {slow + 1} positions in memory"),
    ]
    for key, words in rows:
        print(f"| {words} | {ns[key]:,.1f} | {ns[key] / ns['compiled']:,.1f} | {ns[key] / ns['command']:,.1f} |")


main()
