"""The data set of examples/linkages-1e6: each feature is found a second time in another way."""

import importlib.util
import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import hodograph as hg

SCRIPT = Path(__file__).resolve().parents[2] / "examples" / "linkages-1e6" / "linkages.py"
COUNT, SEED = 2000, 7


@pytest.fixture(scope="module")
def data():
    spec = importlib.util.spec_from_file_location("linkages", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def rows(data):
    return data.rows(data.scene(), COUNT, SEED, 0, COUNT)


def of_row(data, row):
    """The scene of a row."""
    return data.scene().set({name: f"{float(row[name]) * 1e3!r} mm" for name in data.RANGES})


def chain(data, turned):
    """The batch of the same random chains with another link as the frame: angles of all links, by
    mechanism; NaN where a position does not exist."""
    names = [data.LENGTHS[(k + turned) % 4] for k in range(4)]
    scene = hg.Scene({
        "parameters": dict(zip(data.RANGES, ("60 mm", "120 mm", "100 mm", "150 mm", "0 mm", "0 mm"))),
        "links": {"1": ["A", "B"], "2": ["B", "C"], "3": ["D", "C"], "4": ["A", "D"]}, "ground": "4",
        "lengths": dict(zip(("AB", "BC", "CD", "AD"), names)),
        "driver": {"link": "1", "angle": "60 deg", "omega": "1 rad/s"}, "side": {"C": "left of BD"},
        "find": ["phi_1", "phi_3"],
    })  # fmt: skip
    table = hg.batch(scene, data.RANGES, random=COUNT, seed=SEED, start=0, stop=359, steps=359)
    phi_3 = np.full((COUNT, 360), np.nan)
    at = np.rint(np.degrees(table["phi_1"])).astype(int) % 360
    phi_3[table["mechanism"].astype(int), at] = table["phi_3"]
    return phi_3


def test_classes_are_those_of_the_links_that_turn(data, rows):
    full = [np.isfinite(chain(data, k)).all(axis=1) for k in range(4)]
    phi_3 = np.unwrap(np.where(full[0][:, None], chain(data, 0), 0), axis=1, period=2 * math.pi)
    turns = np.abs(phi_3[:, -1] - phi_3[:, 0]) > math.pi
    # By the link beside which each link turns fully: driver, coupler, follower, frame.
    told = np.select([full[0] & turns, full[0], full[1] & full[2], full[2] & full[3]], [1, 0, 3, 2], 4)
    sides = np.sort(np.stack([rows[name] for name in data.LENGTHS]).astype(float), axis=0)
    clear = np.abs(sides[0] + sides[3] - sides[1] - sides[2]) > 1e-3
    assert clear.mean() > 0.9 and len(np.unique(told)) == 5
    assert np.array_equal(told[clear], rows["class"][clear])


def test_time_ratio_swing_and_transmission_are_those_of_solved_positions(data, rows):
    chosen = np.flatnonzero(rows["class"] == 0)[:12]
    for row in rows[chosen]:
        limits = of_row(data, row).limits()
        (output,) = [o for o in limits["outputs"] if o["output"] == "phi_3"]
        assert row["time_ratio"] == pytest.approx(output["time_ratio"], rel=1e-5)
        assert row["swing"] == pytest.approx(output["stroke"], rel=1e-5)
        assert data.CLASSES[row["class"]] == limits["grashof"]["type"]
    for row in rows[np.flatnonzero(rows["class"] <= 1)[:12]]:
        table = of_row(data, row).sweep("phi_1", 0, 360, steps=360, find=["x_B", "y_B", "x_C", "y_C"])
        d = float(row["l_AD"])
        angle = np.arctan2(table["y_C"], table["x_C"] - d) - np.arctan2(
            table["y_C"] - table["y_B"], table["x_C"] - table["x_B"]
        )
        angle = np.abs((angle + math.pi) % (2 * math.pi) - math.pi)
        assert row["transmission_least"] == pytest.approx(angle.min(), abs=1e-5)
        assert row["transmission_greatest"] == pytest.approx(angle.max(), abs=1e-5)
    idle = rows["class"] > 1
    assert np.isnan(rows["transmission_least"][idle]).all() and np.isnan(rows["time_ratio"][rows["class"] != 0]).all()


def polygon(x, y):
    """Length and area of a closed polygon, and its crossings by all pairs of edges."""
    z = x + 1j * y
    edge = np.roll(z, -1) - z
    area = float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y) / 2)
    cross = lambda p, q: p.real * q.imag - p.imag * q.real  # noqa: E731
    left = cross(edge[:, None], z[None, :] - z[:, None]) > 0
    parted = left != np.roll(left, -1, axis=1)
    apart = np.abs(np.subtract.outer(np.arange(len(z)), np.arange(len(z))))
    near = (apart <= 1) | (apart == len(z) - 1)
    return float(np.abs(edge).sum()), area, int((parted & parted.T & ~near).sum() // 2)


def test_paths_and_hodographs_are_those_of_fine_polygons(data, rows):
    chosen = np.flatnonzero(rows["class"] <= 1)
    smooth = rows["acceleration_greatest"][chosen] < 4 * np.median(rows["acceleration_greatest"][chosen])
    for row in rows[chosen[smooth][:15]]:
        table = of_row(data, row).sweep("phi_1", 0, 360, steps=1440, find=["x_E", "y_E", "v_E", "a_E"])
        t = {name: values[:-1] for name, values in table.items()}
        length, area, crossed = polygon(t["x_E"], t["y_E"])
        hodograph, _, _ = polygon(t["v_E.x"], t["v_E.y"])
        near = lambda value, rel=2e-3: pytest.approx(value, rel=rel)  # noqa: E731
        assert row["path_length"] == near(length)
        assert row["path_area"] == pytest.approx(area, abs=2e-4 * length**2)
        assert row["path_width"] == near(np.ptp(t["x_E"])) and row["path_height"] == near(np.ptp(t["y_E"]), 4e-3)
        assert row["path_crossings"] == crossed
        assert row["speed_greatest"] == near(t["v_E"].max(), 1e-2)
        assert row["acceleration_greatest"] == near(t["a_E"].max(), 2e-2)
        assert row["speed_least"] == pytest.approx(t["v_E"].min(), abs=5e-3 * t["v_E"].max())
        assert row["hodograph_length"] == near(hodograph)


def test_crossings_have_the_parity_of_the_turns_of_the_tangent(data, rows):
    """Whitney: a closed curve that crosses itself n times turns its tangent by an odd number of
    times if n is even."""
    table = hg.batch(data.scene(), data.RANGES, random=COUNT, seed=SEED, start=0, stop=355, steps=71, find=["x_E", "y_E"])
    chosen = rows["path_crossings"] >= 0
    take = chosen[table["mechanism"].astype(int)]
    z = (table["x_E"] + 1j * table["y_E"])[take].reshape(-1, 72)
    edge = np.roll(z, -1, axis=1) - z
    turns = np.rint(np.angle(np.roll(edge, -1, axis=1) / edge).sum(axis=1) / (2 * math.pi)).astype(int)
    assert chosen.sum() > 400 and len(np.unique(rows["path_crossings"][chosen])) >= 3
    assert np.array_equal((turns + 1) % 2, rows["path_crossings"][chosen] % 2)


def run(folder, *arguments):
    command = [sys.executable, str(SCRIPT), "-o", str(folder), "--mechanisms", "1500", "--per-part", "400", *arguments]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_bytes_do_not_depend_on_chunks_tasks_and_interruptions(data, rows, monkeypatch, tmp_path):
    tables = []
    for name, chunk, order in (("one", 600, (0, 1, 2, 3)), ("two", 128, (3, 1, 0, 1, 2))):
        monkeypatch.setattr(data, "CHUNK", chunk)
        folder = tmp_path / name
        folder.mkdir()
        (folder / "part-000001.npyabc.tmp").write_bytes(b"of a task that was killed")
        for part in order:
            data.compute(str(folder), COUNT, SEED, 600, part)
        tables.append((data.join(str(folder), COUNT, 600), (folder / "linkages.npy").read_bytes()))
        assert not list(folder.glob("*.tmp"))
    assert tables[0] == tables[1]
    assert np.load(tmp_path / "one" / "linkages.npy").tobytes() == rows.tobytes()


def test_commands_for_one_machine_a_cluster_and_ray_agree(tmp_path):
    whole = run(tmp_path / "whole", "--processes", "2")
    digest = whole.rsplit(maxsplit=1)[1]
    for shard in ("2/2", "1/2"):
        run(tmp_path / "tasks", "--shard", shard)
    assert run(tmp_path / "tasks", "--join").rsplit(maxsplit=1)[1] == digest
    if importlib.util.find_spec("ray"):
        assert run(tmp_path / "ray", "--ray", "--processes", "2").rsplit(maxsplit=1)[1] == digest
