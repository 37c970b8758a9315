"""Limits and vector loops are those of the program."""

import json

import pytest

import hodograph as hg

NAMES = ["crank-rocker", "drag-link", "shaper", "slider-crank", "press-forces", "watt-six-bar", "five-bar", "cam-offset-roller"]


@pytest.mark.parametrize("name", NAMES)
def test_limits_are_those_of_the_program(name, program):
    scene = hg.Scene.template(name)
    report = scene.limits()
    assert dict(report) == json.loads(program("limits", "-", "--json", text=scene.source))
    assert str(report) == report.text() == program("limits", "-", text=scene.source).decode()
    assert report.text("zh") == program("--lang", "zh", "limits", "-", text=scene.source).decode()


def test_ranges_and_flywheels_are_those_of_the_program(program):
    scene = hg.Scene.template("drag-link")
    ranges = scene.limits(ranges=True)
    assert ranges["ranges"] == json.loads(program("limits", "-", "--ranges", "--json", text=scene.source))
    assert ranges.text("zh") == program("--lang", "zh", "limits", "-", "--ranges", text=scene.source).decode()
    press = hg.Scene.template("press-forces")
    flywheel = press.limits("phi_1", flywheel="1/30")
    assert dict(flywheel) == json.loads(program("limits", "-", "--flywheel", "1/30", "--json", text=press.source))
    assert flywheel["energy"]["flywheel"] > 0
    with pytest.raises(ValueError):
        press.limits(ranges=True, flywheel="1/30")


def test_limits_need_no_rates():
    told = json.loads(hg.Scene.template("crank-rocker").source)
    del told["driver"]["omega"]
    report = hg.Scene(told).limits()
    assert report["grashof"]["type"] == "crank-rocker"
    assert report["outputs"][0]["time_ratio"] == pytest.approx(1.0175313779441266, rel=1e-12)


@pytest.mark.parametrize("name", ["crank-rocker", "shaper", "slider-crank", "watt-six-bar", "class-iii-six-bar"])
def test_loops_are_those_of_the_program(name, program):
    scene = hg.Scene.template(name)
    report = scene.loops()
    assert dict(report) == json.loads(program("loops", "-", "--json", text=scene.source))
    assert str(report) == program("loops", "-", text=scene.source).decode()
    assert scene.loops(lang="zh").text() == program("--lang", "zh", "loops", "-", text=scene.source).decode()
    assert report.notes == [] and "φ" in str(report)


def test_reports_of_other_mechanisms_are_refused():
    with pytest.raises(hg.SolveError) as caught:
        hg.Scene.template("planetary-gear").loops()
    assert caught.value.diagnostics[0].message["zh"]
    with pytest.raises(hg.SolveError):
        hg.Scene.template("shaper").limits(ranges=True)
