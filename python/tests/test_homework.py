"""Variants and marks are those of the program."""

from typing import get_args

import pytest

import hodograph as hg
from hodograph._homework import Platform


def test_the_files_of_a_class_are_those_of_the_program(program, tmp_path):
    scene = hg.Scene.template("crank-rocker")
    roster = tmp_path / "names.csv"
    roster.write_text("name\nAda\nEmmy\n")
    told = tmp_path / "told"
    program(
        "variants", "-", "--vary", "phi_1=20..160/10", "l_AB=80..120/5", "--seed", "3", "--roster", str(roster),
        "--to", "moodle,qti3", "--frame", "-o", str(told), text=scene.source,
    )  # fmt: skip
    vary = {"phi_1": (20, 160, 10), "l_AB": (80, 120, 5)}
    all = hg.variants(scene, vary, seed=3, students=roster)
    assert [one.student for one in all] == ["Ada", "Emmy"] and len(all) == 2
    made = all.save(tmp_path / "made", platforms=["moodle", "qti3"], frame=True)
    assert {p.name for p in made} == {p.name for p in told.iterdir()}
    for path in made:
        assert path.read_bytes() == (told / path.name).read_bytes(), path.name


def test_the_key_of_a_variant_is_the_solution_of_its_scene():
    scene = hg.Scene.template("crank-rocker")
    one = hg.variants(scene, {"phi_1": (20, 160, 10)}, count=1)[0]
    assert one.scene.parameters["phi_1"].split()[0] == one.values["phi_1"]
    key = {k.question: k for k in one.key}
    answer = one.scene.solve()["omega_3"].value
    assert key["omega_3"].value == pytest.approx(answer, rel=1e-5)
    assert 0 < key["omega_3"].tolerance < abs(answer)
    assert hg.variants(scene, {"phi_1": (20, 160, 10)}, count=1)[0].values == one.values


def test_requests_that_cannot_be_met_are_refused(tmp_path):
    scene = hg.Scene.template("crank-rocker")
    with pytest.raises(hg.HodographError):
        hg.variants(scene, {"phi_1": (20, 40, 10)}, count=30)
    with pytest.raises(hg.ArgumentError):
        hg.variants(scene, {"nobody": (20, 40, 10)})
    with pytest.raises(hg.ArgumentError):
        hg.variants(scene, {"phi_1": (20, 160, 10)}, count=1, students=["Ada", "Emmy"])
    with pytest.raises(hg.ArgumentError) as caught:
        hg.variants(scene, count=1).save(tmp_path, platforms=["moodle", "blackboard"])
    assert "`blackboard`" in str(caught.value) and not list(tmp_path.iterdir())
    for name in get_args(Platform):
        assert name in str(caught.value)


def test_marks_are_those_of_the_program(program, tmp_path):
    scene = hg.Scene.template("crank-rocker")
    all = hg.variants(scene, {"phi_1": (20, 160, 10)}, count=2)
    all.save(tmp_path)
    right, wrong = all[0].key[0], all[1].key[-1]
    answers = tmp_path / "class.csv"
    answers.write_text(
        "student,variant,question,value,unit\n"
        f"Ada,1,{right.question},{right.value},{right.unit}\n"
        f"Emmy,2,{wrong.question},{-wrong.value},{wrong.unit}\n"
    )
    marks = hg.mark(answers, tmp_path / "answers.csv")
    for lang in ("en", "zh"):
        told = program("--lang", lang, "mark", str(answers), "--keys", str(tmp_path / "answers.csv"))
        assert marks.csv(lang) == told.decode()
    assert marks.save(tmp_path / "marks.csv").read_text() == marks.csv()
    ada = next(row for row in marks if row["student"] == "Ada" and row["question"] == right.question)
    assert float(ada["mark"]) == 1
    with pytest.raises(hg.FileError):
        hg.mark("no,table\n1,2\n", tmp_path / "answers.csv")
