"""Faults are exceptions with their places; wrong types are TypeErrors."""

import json
import re

import pytest

import hodograph as hg

SCENE = hg.Scene.template("crank-rocker")


def test_a_fault_shows_its_place(program):
    text = SCENE.source.replace('"lengths"', '"lenghts"')
    with pytest.raises(hg.FileError) as caught:
        hg.Scene(text)
    fault = caught.value
    assert isinstance(fault, ValueError) and isinstance(fault, hg.HodographError)
    spelled = next(d for d in fault.diagnostics if d.code == "unknown-key")
    line = text.splitlines()[spelled.line - 1]
    assert line[spelled.column - 1 :].startswith('"lenghts"')
    assert spelled.end_column == spelled.column + len('"lenghts"')
    assert spelled.help["en"] == "did you mean `lengths`?" and spelled.message["zh"]
    assert "lenghts" in str(fault) and "did you mean" in str(fault) and "建议" in fault.texts["zh"]
    assert fault.json["schema"] == "hodograph/errors/1"


def test_all_faults_are_told_at_once():
    with pytest.raises(hg.FileError) as caught:
        hg.Scene({"links": 3, "ground": 4, "find": ["v_?"]})
    assert len(caught.value.diagnostics) >= 3


def test_a_file_is_named(tmp_path):
    path = tmp_path / "構件.json"
    path.write_text('{"links": 1}')
    with pytest.raises(hg.FileError) as caught:
        hg.Scene(path)
    assert caught.value.diagnostics[0].file == str(path) and "構件.json" in str(caught.value)
    with pytest.raises(FileNotFoundError):
        hg.Scene(tmp_path / "none.json")


@pytest.mark.parametrize(
    ("wrong", "code"),
    [
        (lambda: SCENE.set(l_XY=3), "unknown-parameter"),
        (lambda: SCENE.sweep("phi_9", 0, 1), "unknown-parameter"),
        (lambda: SCENE.sweep("phi_1", "0 mm"), "dimension"),
        (lambda: SCENE.sweep(find=["v_C", "v_Q"]), "unknown-point"),
        (lambda: SCENE.sweep("l_AB", steps=3), "range"),
        (lambda: SCENE.figure("mechanism", path=["Q"]), "unknown-point"),
        (lambda: SCENE.figure("nothing"), "no-figure"),
        (lambda: SCENE.figure(style="none"), "unknown-style"),
        (lambda: SCENE.figure(width="3 kg"), "dimension"),
        (lambda: SCENE.figure(page="a44"), "paper"),
        (lambda: SCENE.figure(lang="de"), "lang"),
        (lambda: SCENE.solve(digits=0), "digits"),
        (lambda: SCENE.solve(digits=10**6), "digits"),
        (lambda: SCENE.solve(drafting="3 s"), "dimension"),
        (lambda: hg.Scene.template("shapr"), "unknown-template"),
    ],
)
def test_an_argument_is_at_fault(wrong, code):
    with pytest.raises(hg.HodographError) as caught:
        result = wrong()
        getattr(result, "json", None)
    assert isinstance(caught.value, hg.ArgumentError), str(caught.value)
    assert caught.value.code == code, str(caught.value)


@pytest.mark.parametrize(
    ("wrong", "word"),
    [
        (lambda: SCENE.sweep("l_AB", steps=3), "give start and stop"),
        (lambda: hg.Scene.template("shaper").limits(ranges=True), "leave ranges out"),
        (lambda: hg.Scene({**json.loads(SCENE.source), "find": []}).figure("velocity"), "name"),
        (lambda: SCENE.sweep(start="3 s"), "start"),
        (lambda: SCENE.limits("phi_9"), "over"),
        (lambda: hg.batch(SCENE, {"l_AB": ("1...", 2)}), "two dots"),
        (lambda: SCENE.figure("mechanism", width="1 mm"), ""),
    ],
)
def test_remedies_name_arguments_of_python(wrong, word):
    with pytest.raises(hg.HodographError) as caught:
        wrong()
    texts = caught.value.texts
    assert word in texts["en"], texts["en"]
    for text in texts.values():
        assert not re.search("(?<![a-z0-9-])--[a-z]", text), text


def test_the_place_of_a_question_is_in_the_question():
    with pytest.raises(hg.ArgumentError) as caught:
        SCENE.sweep(find=["v_C", "v_Q"])
    (fault,) = caught.value.diagnostics
    assert (fault.file, fault.line, fault.column) == ("find", 1, 5)


@pytest.mark.parametrize(
    "wrong",
    [
        lambda: hg.Scene(3),
        lambda: hg.Scene(None),
        lambda: SCENE.set(l_AB=True),
        lambda: SCENE.set(l_AB=[1]),
        lambda: SCENE.sweep(0, 1, 2),
        lambda: SCENE.sweep(steps="many"),
        lambda: SCENE.sweep(find=[3]),
        lambda: SCENE.figure(3),
        lambda: SCENE.figure(digits="four"),
        lambda: hg.Scene(hg.Task.template("time-ratio").source),
        lambda: hg.Task(SCENE.source),
        lambda: SCENE.live("mechanism").drag("1"),
    ],
)
def test_wrong_types_are_type_errors(wrong):
    with pytest.raises(TypeError):
        wrong()


def test_a_scene_that_cannot_be_solved():
    with pytest.raises(hg.HodographError) as caught:
        SCENE.set(l_AD=900).solve()
    assert "cannot-assemble" in {d.code for d in caught.value.diagnostics}


@pytest.mark.parametrize("text", ["{", "{}", "[", '{"links": {}}', "{\x00}", '{"a": ' * 2000, "{" + "}" * 99])
def test_no_text_panics(text):
    for kind in (hg.Scene, hg.Task, hg.Motion, hg.read):
        with pytest.raises((hg.HodographError, TypeError, FileNotFoundError)):
            kind("{" + text if not text.startswith("{") else text)


def test_mutilated_scenes_never_panic():
    text = SCENE.source
    for k in range(0, len(text), 7):
        for cut in (text[:k] + text[k + 3 :], text[:k] + "9" + text[k:], text[:k] + '"' + text[k + 1 :]):
            try:
                hg.read(cut if cut.startswith("{") else "{" + cut).solve()
            except (hg.HodographError, TypeError):
                pass


def test_names_of_numbers_that_are_not_finite():
    for value in (float("nan"), float("inf"), -float("inf")):
        with pytest.raises((hg.HodographError, ValueError, OverflowError)):
            SCENE.set(l_AB=value)


def test_the_schema_describes_the_templates():
    for kind in ("scene", "task", "motion", "equation"):
        assert hg.schema(kind)["$schema"]
    with pytest.raises(ValueError):
        hg.schema("book")
    assert {t.kind for t in hg.templates()} == {"scene", "task", "motion", "equation"}
    assert json.dumps(hg.figures(), ensure_ascii=False).count("zh") == len(hg.figures())
