"""Numbers, figures and documents are those of the program."""

import json

import numpy as np
import pytest

import hodograph as hg

SOLVABLE = [t.name for t in hg.templates() if t.kind != "task"]
TASKS = [t.name for t in hg.templates() if t.kind == "task"]
SCENES = [t.name for t in hg.templates() if t.kind == "scene"]
SOME = ["crank-rocker", "shaper", "pump-jack", "cam-offset-roller", "planetary-gear", "four-bar-forces"]


@pytest.mark.parametrize("name", SOLVABLE)
def test_answers_are_those_of_the_program(name, program):
    problem = hg.template(name)
    told = json.loads(program("solve", "-", "--json", text=problem.source))
    solved = problem.solve()
    assert solved.json["answers"] == told["answers"]
    for answer in told["answers"]:
        ours = solved[answer["find"]]
        assert ours.unit == answer["unit"]
        if problem.kind == "scene" and answer["value"] is not None:
            value = answer["value"]
            expected = value["value"] if "value" in value else [value["x"], value["y"]]
            assert np.array_equal(ours.value, expected)
            assert ours.millimetres == answer["measured_mm"]
            assert ours.certificate["numbers"] == answer["certified"]["numbers"]
    assert solved.text() == program("solve", "-", text=problem.source).decode()


@pytest.mark.parametrize("name", TASKS)
def test_candidates_are_those_of_the_program(name, program):
    task = hg.Task.template(name)
    design = task.solve()
    told = json.loads(program("synth", "-", "--json", text=task.source))
    assert design.candidates == told["candidates"]
    assert len(design) == len(told["candidates"]) and all(isinstance(s, hg.Scene) for s in design)


@pytest.mark.parametrize("name", SCENES)
def test_sweeps_are_those_of_the_program(name, program):
    scene = hg.Scene.template(name)
    told = program("sweep", "-", "--steps", "30", "--format", "json", text=scene.source, code=(0, 2))
    if not told:
        with pytest.raises(hg.HodographError):
            scene.sweep(steps=30)
        return
    columns = json.loads(told)["columns"]
    table = scene.sweep(steps=30)
    assert list(table) == [c["name"] for c in columns]
    assert list(table.units.values()) == [c["unit"] for c in columns]
    for column in columns:
        expected = np.array([np.nan if v is None else v for v in column["values"]], float)
        ours = np.where(np.isfinite(table[column["name"]]), table[column["name"]], np.nan)
        assert np.array_equal(ours, expected, equal_nan=True), column["name"]


@pytest.mark.parametrize("name", SOME)
def test_figures_and_documents_are_those_of_the_program(name, program, tmp_path):
    scene = hg.Scene.template(name)
    for lang in ("en", "zh"):
        drawn = program("draw", "-", "-o", "-", "--lang", lang, text=scene.source).decode()
        assert scene.figure(lang=lang).svg == drawn
    sheet = program("worksheet", "-", "-o", "-", "--format", "html", text=scene.source).decode()
    assert scene.worksheet().html == sheet
    out = tmp_path / "lesson.html"
    program("lesson", "-", "-o", str(out), text=scene.source)
    assert scene.lesson().html == out.read_text()


def test_a_bare_number_keeps_the_unit():
    scene = hg.Scene.template("crank-rocker")
    with_unit, bare, numpy = (scene.set(l_AB=v) for v in ("90 mm", 90, np.float64(90)))
    assert with_unit == bare == numpy and bare.parameters["l_AB"] == "90 mm"
    assert scene.parameters["l_AB"] == "100 mm"
    small = scene.set(l_AB=0.1 + 0.2)
    assert small.parameters["l_AB"] == "0.30000000000000004 mm"
    assert scene.set({"l_AB": 1e-7}).parameters["l_AB"] == "1e-07 mm"
    assert scene.set() == scene and hash(scene.set()) == hash(scene)


def test_a_scene_is_read_from_a_dict_a_text_and_a_path(tmp_path):
    scene = hg.Scene.template("slider-crank")
    path = scene.save(tmp_path / "slider.json")
    same = [hg.Scene(json.loads(scene.source)), hg.Scene(scene.source), hg.Scene(path), hg.read(str(path))]
    values = {repr(s.solve()) for s in same}
    assert values == {repr(scene.solve())}
    assert isinstance(hg.read(hg.Task.template("time-ratio").source), hg.Task)


def test_an_answer_has_all_its_sides():
    r = hg.Scene.template("shaper").solve()
    omega, v = r["omega_3"], r["v_C"]
    assert float(omega) == omega.value == omega.drawing and omega.digits == 6
    assert omega.sense == "counter-clockwise" and v.sense is None
    assert r["alpha_3"].unit == "rad/s²" and omega.measured_between == ("o", "a_3")
    assert v.value.shape == (2,) and v.direction == 180 and v.magnitude == -v.value[0]
    assert abs(omega.analysis - omega.value) <= 1e-12 and omega.scale == 0.01
    assert r.verdict == "answered" and list(r)[0] == "v_C" and len(r) == 10
    assert "omega_3" in r._repr_html_() and "46.15 mm" in str(r)
    with pytest.raises(KeyError, match="v_Q"):
        r["v_Q"]
    with pytest.raises(TypeError):
        float(v)


def test_digits_are_certified():
    r = hg.Scene.template("crank-rocker").solve(digits=30)
    assert r["omega_3"].digits == 30 and len(r["omega_3"].certificate["numbers"]["value"]["text"]) > 30


def test_a_pose_is_drawn_without_rates():
    scene = hg.Scene.template("crank-rocker")
    still = json.loads(scene.source)
    del still["driver"]["omega"]
    still = hg.Scene(still)
    assert still.figure("centres").svg.startswith("<svg")
    with pytest.raises(hg.HodographError):
        still.solve()


def test_figures_have_pages_and_files(tmp_path):
    scene = hg.Scene.template("crank-rocker")
    steps = scene.figure(steps=True)
    assert len(steps.pages) > 3
    assert steps.save(tmp_path / "steps.pdf")[0].read_bytes().startswith(b"%PDF")
    assert len(steps.save(tmp_path / "steps.png")) == len(steps.pages)
    one = scene.figure("mechanism", vectors="velocity", dimensions=True, path=["E"])
    assert one.size_mm[0] > 20 and one.png(dpi=50).startswith(b"\x89PNG")
    first, second = (scene.figure(f)._repr_svg_() for f in ("velocity", "acceleration"))
    ids = [set(part.split('"')[0] for part in svg.split(' id="')[1:]) for svg in (first, second)]
    assert ids[0] and not ids[0] & ids[1]
    with pytest.raises(ValueError, match="svg"):
        one.save(tmp_path / "m.jpg")
    with pytest.raises(ValueError, match="pages"):
        steps.svg


def test_worksheets_have_their_drawings_beside_them(tmp_path):
    sheet = hg.Scene.template("crank-rocker").worksheet(lang="zh", solution=False)
    for ending, least in (("pdf", 1), ("html", 1), ("md", 2), ("typ", 2)):
        files = sheet.save(tmp_path / f"w.{ending}")
        assert len(files) >= least and all(f.stat().st_size for f in files)
    assert "<iframe" in sheet._repr_html_()


def test_live_figures_follow_the_driver():
    scene = hg.Scene.template("crank-rocker")
    live = scene.live("mechanism", "velocity")
    start = live.svgs
    omega = live.answers["omega_3"]
    live.drag(live.values[0] + 0.5)
    assert live.svgs != start and live.answers["omega_3"] != omega and len(live.names) == 2
    degrees = np.degrees(live.values[0])
    assert live.answers["omega_3"] == scene.set(phi_1=f"{degrees} deg").solve()["omega_3"].text
    with pytest.raises(hg.HodographError):
        live.drag([1.0, 2.0])


def test_a_scene_is_pickled_and_compared():
    import pickle

    scene = hg.Scene.template("shaper")
    assert pickle.loads(pickle.dumps(scene)) == scene != scene.set(l_BC=170)
