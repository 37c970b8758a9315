"""Columns of sweeps: shared memory, units, other libraries."""

import gc

import numpy as np
import pytest

import hodograph as hg

SCENE = hg.Scene.template("pump-jack")


def address(array):
    return array.__array_interface__["data"][0]


def test_a_column_is_the_memory_of_the_library():
    table = SCENE.sweep(steps=500)
    for column, array in zip(table._native.columns, table.values()):
        told = column.__array_interface__
        assert address(array) == told["data"][0] and told["shape"] == (table.rows,) == array.shape
        assert array.dtype == np.float64 and not array.flags.owndata
        # Two views of a column are one memory, and nobody writes to it.
        assert address(np.asarray(column)) == address(array)
        with pytest.raises(ValueError):
            array[0] = 1


def test_a_column_lives_as_long_as_its_array():
    kept = SCENE.sweep(steps=2000)[next(iter(SCENE.sweep(steps=1)))]
    copy = kept.copy()
    gc.collect()
    _ = [SCENE.sweep(steps=2000) for _ in range(5)]
    assert np.array_equal(kept, copy) and kept.base is not None


def test_other_libraries_read_it():
    table = SCENE.sweep(steps=50)
    pa = pytest.importorskip("pyarrow")
    arrow = table.to_arrow()
    for name in table:
        assert arrow.column(name).chunk(0).buffers()[1].address == address(table[name])
        assert arrow.schema.field(name).metadata[b"unit"].decode() == table.units[name]
    assert pa.compute.max(arrow.column(next(iter(table)))).as_py() == table[next(iter(table))].max()
    pandas = pytest.importorskip("pandas")
    frame = table.to_pandas()
    assert isinstance(frame, pandas.DataFrame) and list(frame) == list(table)
    assert frame.attrs["units"] == table.units
    polars = pytest.importorskip("polars")
    assert np.array_equal(table.to_polars().to_numpy(), np.column_stack(list(table.values())))
    assert isinstance(table.to_polars(), polars.DataFrame)


def test_the_units_of_the_book_are_those_of_the_answers():
    si, book = SCENE.sweep(steps=12), SCENE.sweep(steps=12, units="book")
    assert list(si) == list(book) and si.units["phi_1"] == "rad" and book.units["phi_1"] == "°"
    assert np.allclose(book["phi_1"], np.degrees(si["phi_1"]), rtol=1e-15)
    answers = SCENE.solve()
    now = SCENE.sweep("driver", start=SCENE.parameters["phi_1"], stop="360 deg", steps=1, units="book")
    for find, answer in answers.items():
        if find in now and answer.value is not None and answer.sense is None:
            number = f"{now[find][0]:.6g}"
            assert number[:4] in answer.text.replace("−", "-"), (find, number, answer.text)
            assert now.units[find] in answer.text


def test_a_range_is_read_as_the_scene_reads_it():
    scene = hg.Scene.template("shaper")
    degrees, text = scene.sweep("phi_1", 0, 90, steps=3), scene.sweep("phi_1", "0 rad", "pi/2 rad", steps=3)
    assert np.allclose(degrees["phi_1"], text["phi_1"])
    lengths = scene.sweep("l_BC", 150, "0.2 m", steps=5, find=["v_C", "omega_4"])
    assert np.allclose(lengths["l_BC"], np.linspace(0.15, 0.2, 6)) and lengths.units["l_BC"] == "m"
    assert lengths.vector("v_C").shape == (6, 2) and lengths.rows == 6
    single = scene.sweep("phi_1", 20, 20, steps=0)
    assert np.isclose(single["omega_3"][0], scene.solve()["omega_3"].value, rtol=1e-12)


def test_rows_agree_with_solve():
    scene = hg.Scene.template("crank-rocker")
    table = scene.sweep(steps=8, find="omega_3,v_C")
    for k in range(table.rows):
        there = scene.set(phi_1=f"{45 * k} deg").solve()
        assert np.isclose(table["omega_3"][k], float(there["omega_3"]), rtol=1e-9, atol=1e-12)
        assert np.allclose(table.vector("v_C")[k], there["v_C"].value, rtol=1e-9, atol=1e-12)


def test_missing_rows_are_told():
    rocker = hg.Scene.template("crank-rocker").set(l_CD=130)
    table = rocker.sweep(steps=360)
    assert 0 < table.rows < 361 and table.notes and "zh" in table.notes[0].message
