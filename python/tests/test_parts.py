"""Batches in parts: the files of the program, whoever computes them and whatever dies meanwhile."""

import json
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import hodograph as hg

SCENE = hg.Scene.template("crank-rocker")
VARY = {"l_AB": (60, 260), "l_BC": (200, 300)}
SMALL = {"random": 100, "seed": 3, "steps": 36, "find": "a_C", "per_part": 30}
# Each part has four blocks of rows, written one after the other.
LONG = {"random": 30_000, "seed": 7, "steps": 71, "find": "omega_3", "per_part": 7_500, "format": "npy"}


def files(folder):
    return {p.name: p.read_bytes() for p in Path(folder).iterdir()}


@pytest.fixture(scope="module")
def serial(tmp_path_factory):
    parts = hg.Parts.begin(tmp_path_factory.mktemp("serial"), SCENE, VARY, **LONG)
    parts.compute()
    return parts


@pytest.mark.parametrize("form", ["csv", "npy", "parquet"])
def test_files_are_those_of_the_program(form, program, tmp_path):
    vary = [word for name, (low, high) in VARY.items() for word in ("--vary", f"{name}={low}..{high}")]
    asked = ["--random", "100", "--seed", "3", "--steps", "36", "--find", "a_C"]
    shard = ["--per-part", "30", "--format", form, "--shard", "1/1"]
    program("batch", "-", *vary, *asked, *shard, "-o", str(tmp_path / "theirs"), text=SCENE.source)
    parts = hg.Parts.begin(tmp_path / "ours", SCENE, VARY, format=form, **SMALL)
    assert len(parts) == 4 and parts.missing() == [0, 1, 2, 3]
    rows = {name: value for name, value in SMALL.items() if name != "per_part"}
    assert parts.compute([2]) == hg.batch(SCENE, VARY, **rows, mechanisms=(60, 90)).rows
    parts.compute()
    assert files(tmp_path / "ours") == files(tmp_path / "theirs")
    program("shards", "compact", str(tmp_path / "theirs"), "-o", str(tmp_path / f"theirs.{form}"))
    at = parts.compact(tmp_path / f"ours.{form}")
    assert at.read_bytes() == (tmp_path / f"theirs.{form}").read_bytes()
    report = parts.verify()
    said = program("shards", "verify", str(tmp_path / "theirs")).decode()
    assert report.complete and f"{report.rows} rows" in said and f"{report.crc32:08x}" in said


def test_parts_are_continued_and_damage_is_found(tmp_path):
    parts = hg.Parts.begin(tmp_path, SCENE, VARY, **SMALL)
    parts.compute()
    sound = files(tmp_path)
    path = parts.path(1)
    path.write_bytes(path.read_bytes()[:-1] + b"x")
    report = hg.Parts(tmp_path).verify(remove_damaged=True)
    assert report.damaged == [1] and not report.complete and parts.missing() == [1]
    with pytest.raises(hg.PartsError, match="1 of 4"):
        parts.compact(tmp_path / "all.parquet")
    parts.compute()
    assert files(tmp_path) == sound


def test_a_folder_keeps_to_its_batch(tmp_path):
    hg.Parts.begin(tmp_path, SCENE, VARY, **SMALL)
    assert len(hg.Parts.begin(tmp_path, SCENE, VARY, **SMALL)) == 4
    for other in ({"seed": 4}, {"per_part": 31}, {"steps": 35}, {"format": "csv"}):
        with pytest.raises(hg.ArgumentError, match="another batch"):
            hg.Parts.begin(tmp_path, SCENE, VARY, **{**SMALL, **other})
    with pytest.raises(FileNotFoundError):
        hg.Parts(tmp_path / "none")
    with pytest.raises(IndexError):
        hg.Parts(tmp_path).compute([4])
    with pytest.raises(ValueError, match=r"\.parquet"):
        hg.Parts(tmp_path).compact(tmp_path / "all.csv")


def test_pieces_of_a_batch_are_its_rows():
    options = {"random": 90, "seed": 5, "steps": 12, "find": "omega_3"}
    whole = hg.batch(SCENE, VARY, **options)
    pieces = [hg.batch(SCENE, VARY, **options, mechanisms=(k, k + 40)) for k in range(0, 120, 40)]
    for name in whole:
        assert np.array_equal(whole[name], np.concatenate([p[name] for p in pieces])), name


def test_signals_of_the_process_stay_its_own(tmp_path):
    """Parts are written by code of the program, which handles its signals; here they are Python's."""
    parts = hg.Parts.begin(tmp_path, SCENE, VARY, **{**LONG, "random": 3_000_000, "per_part": 3_000_000})
    threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        parts.compute()
    with pytest.raises(hg.StoppedError), hg.time_limit(0.3):
        parts.compute()
    assert parts.missing() == [0] and any(p.suffix == ".part" for p in tmp_path.iterdir())


class Killer(threading.Thread):
    """Kills, once for each part, the process that writes it, after its first block of rows."""

    def __init__(self, folder):
        super().__init__(daemon=True)
        self.folder, self.killed, self.over = Path(folder), [], threading.Event()

    def __enter__(self):
        self.start()
        return self

    def __exit__(self, *_):
        self.over.set()
        self.join()

    def run(self):
        while not self.over.is_set():
            for path in self.folder.glob("*.part"):
                if path.name not in self.killed and size(path) > 1 << 20:
                    self.kill(path)
            time.sleep(0.002)

    def kill(self, path):
        for link in Path("/proc").glob("[0-9]*/fd/*"):
            try:
                if os.readlink(link) == str(path) and int(link.parts[2]) != os.getpid():
                    os.kill(int(link.parts[2]), signal.SIGKILL)
                    self.killed.append(path.name)
                    return
            except OSError:
                pass


def size(path):
    try:
        return path.stat().st_size
    except OSError:
        return 0


def same(parts, serial, killer):
    """Every row is there once, with the bytes of the serial run, although workers were killed."""
    assert len(killer.killed) >= 2, killer.killed
    assert files(parts.folder) == files(serial.folder)
    report, other = parts.verify(), serial.verify()
    assert report == other and report.complete
    table = np.load(parts.compact(parts.folder.parent / "all.npy"))
    keys = np.stack([table["mechanism"], table["phi_1 [rad]"]], axis=1)
    assert len(np.unique(keys, axis=0)) == len(table) == report.rows
    assert report.rows + report.positions_without_row == LONG["random"] * 72


def listening():
    """The addresses on which this process and its descendants listen."""
    parents = {}
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            parents[int(stat.parts[2])] = int(stat.read_text().rsplit(")", 1)[1].split()[1])
        except OSError:
            pass
    own = {os.getpid()}
    while more := {p for p, parent in parents.items() if parent in own} - own:
        own |= more
    inodes = set()
    for link in (f for p in own for f in Path(f"/proc/{p}/fd").glob("*")):
        try:
            inodes.add(os.readlink(link))
        except OSError:
            pass
    found = set()
    for kind in ("tcp", "tcp6"):
        for line in Path(f"/proc/net/{kind}").read_text().splitlines()[1:]:
            word = line.split()
            if word[3] == "0A" and f"socket:[{word[9]}]" in inodes:
                found.add(word[1].split(":")[0])
    return found


LOOPBACK = {"0100007F", "0000000000000000FFFF00000100007F", "00000000000000000000000001000000"}


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
def test_ray_computes_the_same_bytes_although_workers_are_killed(serial, tmp_path):
    pytest.importorskip("ray")
    import hodograph.ray

    folder = tmp_path / "parts"
    with hodograph.ray.local(2), Killer(folder) as killer:
        report = hodograph.ray.batch(folder, SCENE, VARY, workers=2, output=tmp_path / "ray.npy", **LONG)
        addresses = listening()
    assert addresses and addresses <= LOOPBACK, addresses
    assert report == serial.verify()
    same(hg.Parts(folder), serial, killer)
    assert (tmp_path / "ray.npy").read_bytes() == (tmp_path / "all.npy").read_bytes()


def test_ray_that_is_missing_is_named(tmp_path):
    code = "import sys; sys.modules['ray'] = None; import hodograph.ray as r; r.batch('x', None, {})"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, cwd=tmp_path)
    assert "hodograph.ray needs Ray: pip install ray" in done.stderr and not list(tmp_path.iterdir())


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
def test_dask_computes_the_same_bytes_although_workers_are_killed(serial, tmp_path):
    distributed = pytest.importorskip("distributed")
    folder = tmp_path / "parts"
    parts = hg.Parts.begin(folder, SCENE, VARY, **LONG)
    options = {"n_workers": 2, "threads_per_worker": 1, "host": "127.0.0.1", "dashboard_address": None}
    with Killer(folder) as killer, distributed.LocalCluster(**options) as cluster, distributed.Client(cluster) as client:
        tasks = client.map(hg.compute_part, [str(folder)] * len(parts), parts.missing(), pure=False)
        client.gather(tasks)
        addresses = listening()
    assert addresses and addresses <= LOOPBACK, addresses
    same(parts, serial, killer)


def test_the_description_is_a_document(tmp_path):
    hg.Parts.begin(tmp_path, SCENE, VARY, **SMALL)
    told = json.loads((tmp_path / "batch.json").read_text())
    assert told["mechanisms_per_part"] == 30 and told["arguments"]["random"] == 100
