"""Batches are those of the program."""

import io

import numpy as np
import pytest

import hodograph as hg

SCENE = hg.Scene.template("crank-rocker")


@pytest.mark.parametrize(
    ("arguments", "options"),
    [
        (["--steps", "5", "--find", "omega_3"], {"steps": 5, "find": "omega_3"}),
        (["--random", "40", "--seed", "7"], {"random": 40, "seed": 7}),
    ],
)
def test_rows_are_those_of_the_program(arguments, options, program, tmp_path):
    out = tmp_path / "rows.npy"
    vary = ["--vary", "l_AB=80..120:4", "--vary", "l_BC=200..260 mm:3"]
    program("batch", "-", *vary, *arguments, "-o", str(out), text=SCENE.source)
    told = np.load(io.BytesIO(out.read_bytes()))
    table = hg.batch(SCENE, {"l_AB": (80, 120, 4), "l_BC": (200, "260 mm", 3)}, **options)
    assert [f"{n} [{u}]" if u else n for n, u in table.units.items()] == list(told.dtype.names)
    for name, field in zip(table, told.dtype.names):
        assert np.array_equal(table[name], told[field].astype(float)), name


def test_a_seed_gives_the_same_rows():
    vary = {"l_AB": (80, 120), "l_BC": (200, 260)}
    one, same, other = (hg.batch(SCENE, vary, random=500, seed=s) for s in (7, 7, 8))
    assert all(np.array_equal(one[n], same[n]) for n in one)
    assert not np.array_equal(one["l_AB"], other["l_AB"]) and one.rows == 500


def test_ranges_at_fault_are_told_together():
    with pytest.raises(hg.ArgumentError) as caught:
        hg.batch(SCENE, {"l_XY": (1, 2), "l_AB": ("1 kg", 2)})
    assert {d.file for d in caught.value.diagnostics} == {"vary"}
    for wrong in ({"l_AB": 3}, {"l_AB": "80..90"}, {"l_AB": (1,)}):
        with pytest.raises(TypeError):
            hg.batch(SCENE, wrong)
