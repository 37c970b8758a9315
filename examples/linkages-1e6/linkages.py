"""Random four-bars with the features of their motion: README.md describes the columns.

    python linkages.py -o linkages                                    # a million on all processors
    python linkages.py -o linkages --mechanisms 2000 --processes 1    # a small one
    python linkages.py -o linkages --ray                              # as tasks of Ray
    python linkages.py -o linkages --shard 3/100                      # one task of many; --join at the end
"""

from __future__ import annotations

import argparse
import hashlib
import os
import sys
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path

import numpy as np

import hodograph as hg

LENGTHS = ("l_AB", "l_BC", "l_CD", "l_AD")
RANGES = {name: (20, 200) for name in LENGTHS} | {"along_E": (-200, 400), "left_E": (-200, 200)}
"""The parameters (mm): driver, coupler, follower, frame; the place of E on the coupler, from B toward
C and to the left."""

POSITIONS = 72
"""Positions of the driver, 5° apart."""

CHUNK = 2048
"""Mechanisms in memory at once: some thirty megabytes."""

PER_PART = 16 * CHUNK
"""Mechanisms of a part, unless told otherwise."""

CLASSES = ("crank-rocker", "double crank", "rocker-crank", "double rocker, coupler turns", "double rocker", "change point")

ROW = np.dtype(
    [("mechanism", "<u4"), *((name, "<f4") for name in RANGES), ("class", "u1")]
    + [(name, "<f4") for name in ("transmission_least", "transmission_greatest", "swing", "time_ratio")]
    + [(name, "<f4") for name in ("path_length", "path_area", "path_width", "path_height")]
    + [("path_crossings", "i1")]
    + [(name, "<f4") for name in ("speed_greatest", "speed_least", "acceleration_greatest", "hodograph_length")]
)


def scene() -> hg.Scene:
    """The four-bar with its coupler point; the driver turns at 1 rad/s."""
    return hg.Scene({
        "parameters": {"l_AB": "60 mm", "l_BC": "120 mm", "l_CD": "100 mm", "l_AD": "150 mm", "along_E": "50 mm", "left_E": "50 mm"},
        "links": {"1": ["A", "B"], "2": ["B", "C", "E"], "3": ["D", "C"], "4": ["A", "D"]},
        "ground": "4",
        "points": {"E": {"base": "BC", "x": "along_E", "y": "left_E"}},
        "lengths": {"AB": "l_AB", "BC": "l_BC", "CD": "l_CD", "AD": "l_AD"},
        "driver": {"link": "1", "angle": "60 deg", "omega": "1 rad/s"},
        "side": {"C": "left of BD"},
        "find": ["v_E"],
    })  # fmt: skip


def class_of(a, b, c, d):
    """The index in `CLASSES` for lengths of driver, coupler, follower, frame (Grashof's theorem)."""
    sides = np.stack([a, b, c, d])
    ordered = np.sort(sides, axis=0)
    excess = ordered[0] + ordered[3] - ordered[1] - ordered[2]
    by_shortest = np.array([0, 3, 2, 1])[np.argmin(sides, axis=0)]
    return np.where(excess < 0, by_shortest, np.where(excess > 0, 4, 5)).astype(np.uint8)


def angle_opposite(side, p, q):
    """The angle of a triangle between the sides p and q (rad); NaN where there is none."""
    with np.errstate(invalid="ignore"):
        return np.arccos((p * p + q * q - side * side) / (2 * p * q))


def whole_turn(a, b, c, d, kind):
    """Extreme transmission angles, swing of the follower (rad) and time ratio by closed formulas."""
    turns = kind <= 1
    nan = np.full(len(a), np.nan)
    least = np.where(turns, angle_opposite(np.abs(d - a), b, c), nan)
    greatest = np.where(turns, angle_opposite(d + a, b, c), nan)
    rocks = kind == 0
    # Crank and coupler in one line: the dead centres of the follower.
    out, back = b + a, np.where(rocks, b - a, nan)
    swing = angle_opposite(out, c, d) - angle_opposite(back, c, d)
    theta = np.abs(angle_opposite(c, back, d) - angle_opposite(c, out, d))
    return least, greatest, swing, (np.pi + theta) / (np.pi - theta)


def greatest(values):
    """The greatest value of each row of equidistant values over a period, by the parabola through
    the greatest and its neighbours."""
    at = np.argmax(values, axis=1)
    rows, n = np.arange(len(values)), values.shape[1]
    before, peak, after = values[rows, at - 1], values[rows, at], values[rows, (at + 1) % n]
    bend = 2 * peak - before - after
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(bend > 0, peak + (after - before) ** 2 / (8 * bend), peak)


def least_speed(vx, vy, ax, ay, step):
    """The least speed of each row, with each acceleration constant for half a step on both sides."""
    with np.errstate(invalid="ignore", divide="ignore"):
        after = np.nan_to_num(-(vx * ax + vy * ay) / (ax * ax + ay * ay))
    after = np.clip(after, -step / 2, step / 2)
    return np.hypot(vx + ax * after, vy + ay * after).min(axis=1)


def crossings(x, y):
    """The number of points in which the closed polygon of each row crosses itself."""
    n = x.shape[1]

    def side(k, step):
        """True where vertex i + k + step is left of the edge i."""
        px, py = np.roll(x, -k - step, axis=1), np.roll(y, -k - step, axis=1)
        return dx * (py - y) - dy * (px - x) > 0

    dx, dy = np.roll(x, -1, axis=1) - x, np.roll(y, -1, axis=1) - y
    apart = {k: side(k, 0) for k in range(2, n + 1)}
    count = np.zeros(len(x), np.int64)
    for k in range(2, n // 2 + 1):
        # The edge i has the ends of the edge i + k on both sides, and that edge the ends of i.
        first = apart[k] != apart[k + 1]
        # Seen from the edge j = i + k, the vertex i is j + n - k and its successor j + n - k + 1.
        second = np.roll(apart[n - k] != apart[n - k + 1], -k, axis=1)
        both = (first & second).sum(axis=1)
        count += both // 2 if 2 * k == n else both
    return count


def motion(table, first, chosen):
    """The features of the path of E and of its hodograph for the chosen mechanisms."""
    row = table["mechanism"].astype(np.int64) - first
    complete = np.bincount(row, minlength=len(chosen)) == POSITIONS
    chosen = chosen & complete
    take = chosen[row]
    x, y, vx, vy, v, ax, ay, a = (
        table[name][take].reshape(-1, POSITIONS)
        for name in ("x_E", "y_E", "v_E.x", "v_E.y", "v_E", "a_E.x", "a_E.y", "a_E")
    )
    step = 2 * np.pi / POSITIONS
    # Integrals over a period by the trapezoidal rule, which converges faster than any power of the step.
    features = {
        "path_length": v.sum(axis=1) * step,
        "path_area": (x * vy - y * vx).sum(axis=1) * (step / 2),
        "path_width": greatest(x) + greatest(-x),
        "path_height": greatest(y) + greatest(-y),
        "path_crossings": crossings(x, y),
        "speed_greatest": greatest(v),
        "speed_least": least_speed(vx, vy, ax, ay, step),
        "acceleration_greatest": greatest(a),
        "hodograph_length": a.sum(axis=1) * step,
    }
    return chosen, features


def rows(of: hg.Scene, mechanisms: int, seed: int, first: int, last: int) -> np.ndarray:
    """The rows of the mechanisms from `first` to before `last` of a data set."""
    drawn = hg.batch(of, RANGES, random=mechanisms, seed=seed, find="phi_1", mechanisms=(first, last))
    out = np.zeros(last - first, ROW)
    out["mechanism"] = np.arange(first, last)
    for name in RANGES:
        out[name] = drawn[name]
    a, b, c, d = (drawn[name] for name in LENGTHS)
    out["class"] = kind = class_of(a, b, c, d)
    for name, values in zip(("transmission_least", "transmission_greatest", "swing", "time_ratio"), whole_turn(a, b, c, d, kind)):
        out[name] = values
    table = hg.batch(
        of, RANGES, random=mechanisms, seed=seed, start=0, stop=360 - 360 / POSITIONS, steps=POSITIONS - 1,
        find=("x_E", "y_E", "v_E", "a_E"), mechanisms=(first, last),
    )  # fmt: skip
    chosen, features = motion(table, first, kind <= 1)
    for name, values in features.items():
        out[name] = -1 if name == "path_crossings" else np.nan
        out[name][chosen] = values
    return out


def part_path(folder: str, part: int) -> Path:
    return Path(folder, f"part-{part:06}.npy")


def compute(folder: str, mechanisms: int, seed: int, per_part: int, part: int) -> int:
    """Computes a part of the data set, if it is missing; returns the number of its mechanisms."""
    os.environ.setdefault("RAYON_NUM_THREADS", "1")
    path = part_path(folder, part)
    first, last = part * per_part, min((part + 1) * per_part, mechanisms)
    if not path.exists():
        of = scene()
        with tempfile.NamedTemporaryFile(dir=folder, prefix=path.name, suffix=".tmp", delete=False) as file:
            made = np.lib.format.open_memmap(file.name, "w+", ROW, (last - first,))
            for k in range(first, last, CHUNK):
                end = min(k + CHUNK, last)
                made[k - first : end - first] = rows(of, mechanisms, seed, k, end)
            made.flush()
        os.chmod(file.name, 0o644)
        # The name appears when the part is complete: repeated and interrupted work gives the same bytes.
        os.replace(file.name, path)
    return last - first


def join(folder: str, mechanisms: int, per_part: int) -> str:
    """Joins all parts into one table; returns its SHA-256."""
    count = -(-mechanisms // per_part)
    missing = [k for k in range(count) if not part_path(folder, k).exists()]
    if missing:
        sys.exit(f"{len(missing)} of {count} parts are missing: {missing[:20]}")
    out = Path(folder, "linkages.npy")
    made = np.lib.format.open_memmap(f"{out}.tmp", "w+", ROW, (mechanisms,))
    for k in range(count):
        part = np.load(part_path(folder, k), mmap_mode="r")
        made[k * per_part : k * per_part + len(part)] = part
    made.flush()
    os.replace(f"{out}.tmp", out)
    for left in Path(folder).glob("part-*.tmp"):
        left.unlink()
    with open(out, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def described(folder: str, mechanisms: int, seed: int, per_part: int) -> None:
    """Writes what the folder holds, or refuses a folder that holds something else."""
    words = f"{mechanisms} mechanisms, seed {seed}, parts of {per_part}\n"
    Path(folder).mkdir(parents=True, exist_ok=True)
    at = Path(folder, "linkages.txt")
    if at.exists() and at.read_text() != words:
        sys.exit(f"{folder} holds another data set: {at.read_text()}")
    at.write_text(words)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", required=True, metavar="FOLDER")
    parser.add_argument("--mechanisms", type=int, default=1_000_000, metavar="N")
    parser.add_argument("--seed", type=int, default=7)
    parser.add_argument("--per-part", type=int, default=PER_PART, metavar="N", help="mechanisms of a part")
    parser.add_argument("--processes", type=int, default=os.cpu_count(), metavar="N")
    parser.add_argument("--ray", action="store_true", help="run as tasks of Ray; --processes starts so many workers without a cluster")
    parser.add_argument("--shard", metavar="I/N", help="compute every N-th part only, from the I-th")
    parser.add_argument("--join", action="store_true", help="join the parts that tasks have computed")
    given = parser.parse_args()
    described(given.output, given.mechanisms, given.seed, given.per_part)
    parts = range(-(-given.mechanisms // given.per_part))
    if given.shard:
        number, of = map(int, given.shard.split("/"))
        parts = parts[number - 1 :: of]
    if given.join:
        parts = range(0)
    task = partial(compute, os.path.abspath(given.output), given.mechanisms, given.seed, given.per_part)
    begin = time.perf_counter()
    if given.ray:
        import hodograph.ray

        done = sum(hodograph.ray.run(task, parts, workers=given.processes))
    elif given.processes > 1 and len(parts) > 1:
        with ProcessPoolExecutor(given.processes) as pool:
            done = sum(pool.map(task, parts))
    else:
        done = sum(map(task, parts))
    took = time.perf_counter() - begin
    if done:
        print(f"{done} mechanisms in {took:.1f} s: {done / took:.0f} per second")
    if not given.shard:
        print(f"{given.output}/linkages.npy: SHA-256 {join(given.output, given.mechanisms, given.per_part)}")


if __name__ == "__main__":
    main()
