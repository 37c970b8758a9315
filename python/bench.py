"""Measures the package: import, solve, sheet, and a sweep beside pylinkage on the same four-bar.

    python bench.py        # pylinkage is optional; the figures count for a wheel built with --release
"""

import math
import subprocess
import sys
import time

import numpy as np

import hodograph as hg


def best(work, times=20):
    """The shortest time of some runs (s)."""
    taken = []
    for _ in range(times):
        begin = time.perf_counter()
        work()
        taken.append(time.perf_counter() - begin)
    return min(taken)


def imported(module):
    """The time of an import beyond that of NumPy (s)."""
    code = f"import numpy, time; t = time.perf_counter(); import {module}; print(time.perf_counter() - t)"
    runs = [subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True) for _ in range(5)]
    return min(float(run.stdout) for run in runs)


TEXT = hg.Scene.template("crank-rocker").source


def solved():
    return hg.Scene(TEXT).solve()["omega_3"].value


def of_pylinkage(steps, c):
    """Returns that four-bar in pylinkage, with C near a place."""
    import pylinkage as pl

    a, d = pl.Ground(0.0, 0.0, name="A"), pl.Ground(0.3, 0.0, name="D")
    crank = pl.Crank(a, radius=0.1, angular_velocity=math.tau / steps, name="B")
    rocker = pl.RRRDyad(crank.output, d, 0.25, 0.2, x=c[0], y=c[1], name="C")
    linkage = pl.Linkage([a, d, crank, rocker], name="four-bar")
    linkage.set_input_velocity(crank, 10.0)
    return linkage


def with_rates(linkage, steps):
    """Positions; velocities and accelerations are computed, too."""
    return np.array([row[0] for row in linkage.step_with_derivatives(iterations=steps)], float)


def main():
    print(f"import beyond numpy   {imported('hodograph') * 1e3:8.2f} ms   (aim 30)")
    print(f"read, solve, a value  {best(solved, 200) * 1e3:8.3f} ms   (aim 1)")
    read = hg.Scene(TEXT)._native
    print(f"  solve alone         {best(lambda: read.solve(), 200) * 1e3:8.3f} ms")
    print(f"sheet as SVG          {best(lambda: hg.Scene(TEXT).figure().svg) * 1e3:8.2f} ms   (aim 10)")

    scene = hg.Scene.template("crank-rocker").set(phi_1=0)
    steps = 3600
    find = ["x_B", "y_B", "x_C", "y_C"]
    ours = best(lambda: scene.sweep("phi_1", 0, 360, steps=steps, find=find))
    print(f"sweep, {steps} positions {ours * 1e3:8.3f} ms: places of B and C")
    rates = best(lambda: scene.sweep("phi_1", 0, 360, steps=steps, find=["v_C", "a_C", "omega_3", "alpha_3"]))
    print(f"  with v, a of C, ω, α {rates * 1e3:7.3f} ms")
    try:
        import pylinkage
    except ImportError:
        print("pylinkage is not installed: no comparison")
        return
    table = scene.sweep("phi_1", 0, 360, steps=steps, find=find)
    at_c = [table[name] for name in ("x_C", "y_C")]
    ways = {
        "step": (ours, lambda linkage: np.array(list(linkage.step(iterations=steps)), float)),
        "step_fast": (ours, lambda linkage: linkage.step_fast(iterations=steps)),
        "step_with_derivatives": (rates, lambda linkage: with_rates(linkage, steps)),
    }
    for word, (ours, way) in ways.items():
        try:
            rows = way(of_pylinkage(steps, [column[0] for column in at_c]))
        except Exception as reason:
            print(f"pylinkage {pylinkage.__version__}, {word}: {type(reason).__name__}: {reason}")
            continue
        linkage = of_pylinkage(steps, [column[0] for column in at_c])
        theirs = best(lambda: way(linkage), 5)
        first = np.argmin(np.hypot(at_c[0] - rows[0, 3, 0], at_c[1] - rows[0, 3, 1]))
        off = np.abs(np.roll(at_c[0][:-1], -first)[: len(rows)] - rows[:, 3, 0]).max()
        print(f"pylinkage {pylinkage.__version__}, {word:21} {theirs * 1e3:9.2f} ms   ratio {theirs / ours:6.1f}; x_C differs by {off:.0e} m")


if __name__ == "__main__":
    main()
