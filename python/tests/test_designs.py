"""Motion cycles, cams, comparisons, numbers of teeth are those of the program."""

import json

import pytest

import hodograph as hg


@pytest.mark.parametrize("name", ["slider-crank", "shaper", "cam-offset-roller"])
def test_cycles_are_those_of_the_program(name, program):
    scene = hg.Scene.template(name)
    cycle = scene.cycle()
    assert dict(cycle) == json.loads(program("cycle", "-", "--json", text=scene.source))
    assert str(cycle) == program("cycle", "-", text=scene.source).decode()
    assert cycle.text("zh") == program("--lang", "zh", "cycle", "-", text=scene.source).decode()
    for form in ("bars", "straight", "polar"):
        drawn = program("cycle", "-", "-o", "-", "--format", "svg", "--form", form, text=scene.source)
        assert cycle.figure(form).svg == drawn.decode(), form


def test_a_cycle_has_the_outputs_that_are_chosen():
    cycle = hg.Scene.template("shaper").cycle()
    assert len(cycle["outputs"]) >= 2
    first = cycle["outputs"][0]["output"]
    assert [o["output"] for o in hg.Scene.template("shaper").cycle(find=first)["outputs"]] == [first]
    with pytest.raises(hg.ArgumentError):
        hg.Scene.template("shaper").cycle(find="phi_99")
    with pytest.raises(hg.ArgumentError):
        hg.Scene.template("shaper").cycle("phi_99")


@pytest.mark.parametrize("name", ["cam-offset-roller", "cam-eccentric"])
def test_cams_are_those_of_the_program(name, program, tmp_path):
    scene = hg.Scene.template(name)
    cam = scene.cam()
    assert [dict(cam)] == json.loads(program("cam", "-", "--json", text=scene.source))
    assert str(cam) == program("cam", "-", text=scene.source).decode()
    for ending in ("csv", "dxf"):
        out = tmp_path / f"program.{ending}"
        program("cam", "-", "--profile", str(out), "--steps", "90", text=scene.source)
        assert cam.save_profile(tmp_path / f"own.{ending}", steps=90).read_bytes() == out.read_bytes()


def test_the_least_base_circle_is_that_of_the_program(program, tmp_path):
    scene = hg.Scene.template("cam-offset-roller")
    cam = scene.cam(alpha=30, alpha_back="60 deg")
    asked = ["cam", "-", "--alpha", "30deg", "--alpha-back", "60deg"]
    assert dict(cam) == json.loads(program(*asked, "--json", text=scene.source))[0]
    assert cam.text("zh") == program("--lang", "zh", *asked, text=scene.source).decode()
    program(*asked, "-o", str(tmp_path), "--format", "svg", text=scene.source)
    pages = cam.figure()
    assert pages.names == ["cam-motion", "cam-profile", "cam-alpha"]
    for word, page in zip(pages.names, pages.pages):
        (drawn,) = tmp_path.glob(f"*-{word}.svg")
        assert page.svg == drawn.read_text(), word
    with pytest.raises(hg.ArgumentError):
        scene.cam(alpha=95)
    with pytest.raises(hg.HodographError):
        scene.cam(2)


def test_comparisons_are_those_of_the_program(program, tmp_path):
    one = hg.Scene.template("crank-rocker")
    other = one.set(l_AB=90)
    paths = [str(one.save(tmp_path / "one.json")), str(other.save(tmp_path / "other.json"))]
    for find in (None, "omega_3,a_C"):
        both = hg.compare(one, other, find=find, names=["one.json", "other.json"])
        asked = ["compare", *paths, *(["--find", find] if find else [])]
        assert dict(both) == json.loads(program(*asked, "--json"))
        assert str(both) == program(*asked).decode()
        assert both.text("zh") == program("--lang", "zh", *asked).decode()
        assert both.csv() == program(*asked, "-o", "-", "--format", "csv").decode()
        assert both.figure().svg == program(*asked, "-o", "-", "--format", "svg").decode()
        assert both.figure(lang="zh").svg == program("--lang", "zh", *asked, "-o", "-", "--format", "svg").decode()


def test_faults_of_a_comparison_are_those_of_their_scene():
    scene = hg.Scene.template("crank-rocker")
    with pytest.raises(ValueError):
        hg.compare(scene)
    with pytest.raises(hg.ArgumentError):
        hg.compare(scene, scene, over="phi_9")
    with pytest.raises(hg.HodographError) as caught:
        hg.compare(scene, hg.Scene.template("excavator"))
    assert caught.value.diagnostics[0].message["zh"]


def test_numbers_of_teeth_are_those_of_the_program(program):
    pairs = hg.teeth(3.15, distance=150, modules=[2, 2.5], within="2%")
    asked = ["teeth", "--ratio", "3.15", "--distance", "150mm", "--module", "2,2.5", "--within", "2%"]
    assert dict(pairs) == json.loads(program(*asked, "--json"))
    assert str(pairs) == program(*asked).decode()
    trains = hg.teeth("63/2", stages=3, teeth=(18, 90))
    asked = ["teeth", "--ratio", "63/2", "--stages", "3", "--teeth", "18..90"]
    assert dict(trains) == json.loads(program(*asked, "--json"))
    assert trains.text("zh") == program("--lang", "zh", *asked).decode()
    with pytest.raises(ValueError):
        hg.teeth(3)
    for wrong in ({"stages": 5}, {"stages": 1}, {"stages": 3, "taper": 2.5}):
        with pytest.raises(hg.ArgumentError, match="from (2 to 4|0.5 to 2)"):
            hg.teeth(3, **wrong)
    with pytest.raises(hg.ArgumentError, match="`hodograph teeth --ratio 3 --distance 150mm"):
        hg.teeth(0.5, stages=2)
