"""Lessons of a method, sheets, frames, exports and imports are those of the program, byte for byte."""

import pytest

import hodograph as hg

METHODS = [("centres", "crank-rocker"), ("composite", "shaper"), ("curvature", "crank-rocker"),
           ("cam", "cam-offset-roller"), ("trains", "planetary-gear"), ("loops", "slider-crank")]  # fmt: skip


@pytest.mark.parametrize("method, name", METHODS)
def test_lessons_of_a_method_are_those_of_the_program(method, name, program):
    scene = hg.Scene.template(name)
    told = program("lesson", "-", "--method", method, "--positions", "8", "-o", "-", text=scene.source)
    assert scene.lesson(method=method, positions=8).html == told.decode()


def test_methods_that_a_scene_does_not_have_are_refused():
    with pytest.raises(hg.HodographError):
        hg.Scene.template("crank-rocker").lesson(method="cam")
    with pytest.raises(hg.HodographError):
        hg.Scene.template("crank-rocker").lesson(method="dance")
    with pytest.raises(hg.HodographError):
        hg.Motion.template("pursuit").lesson(method="centres")


def test_sheets_with_questions_and_tables_are_those_of_the_program(program):
    scene = hg.Scene.template("crank-rocker")
    html = ["-o", "-", "--format", "html"]
    told = program("worksheet", "-", "--questions", *html, text=scene.source)
    assert scene.worksheet(questions=True).html == told.decode()
    told = program("worksheet", "-", "--solution", "--table", "12", *html, text=scene.source)
    assert scene.worksheet(problem=False, table=12).html == told.decode()
    with pytest.raises(ValueError):
        scene.worksheet(questions=True, loops=True)
    with pytest.raises(ValueError):
        scene.worksheet(solution=False, table=12)
    with pytest.raises(hg.HodographError):
        hg.Motion.template("pursuit").worksheet(questions=True)


def test_the_sheet_to_draw_on_is_that_of_the_program(program, tmp_path):
    scene = hg.Scene.template("shaper")
    program("worksheet", "-", "--frame", "--page", "a3", "-o", str(tmp_path / "told.pdf"), text=scene.source)
    made = scene.frame(page="a3").save(tmp_path / "made.pdf")
    assert [m.name for m in made] == ["made.pdf", "made-overlay.pdf"]
    for path in made:
        assert path.read_bytes() == path.with_name(path.name.replace("made", "told")).read_bytes()
    with pytest.raises(hg.ArgumentError):
        scene.frame(page="80mm")


@pytest.mark.parametrize("ending", ["dxf", "ggb", "tikz", "pptx", "py", "json", "txt"])
def test_exports_are_those_of_the_program(ending, program, tmp_path):
    scene = hg.Scene.template("crank-rocker")
    program("export", "-", "-o", str(tmp_path / f"told.{ending}"), text=scene.source)
    made = scene.export(tmp_path / f"made.{ending}")
    assert made.read_bytes() == (tmp_path / f"told.{ending}").read_bytes()


def test_a_figure_and_a_format_can_be_chosen(program, tmp_path):
    scene = hg.Scene.template("shaper")
    program("export", "-", "--figure", "velocity", "-o", str(tmp_path / "told.dxf"), text=scene.source)
    made = scene.export(tmp_path / "made.dxf", name="velocity")
    assert made.read_bytes() == (tmp_path / "told.dxf").read_bytes()
    four_bar = hg.Scene.template("crank-rocker")
    assert four_bar.export(tmp_path / "linkage", format="pmks").read_text() == program(
        "export", "-", "--to", "pmks", "-o", "-", text=four_bar.source
    ).decode()
    with pytest.raises(ValueError):
        scene.export(tmp_path / "linkage")
    with pytest.raises(ValueError):
        scene.export(tmp_path / "linkage.dxf", format="pmks")
    with pytest.raises(hg.SolveError):
        hg.Scene.template("planetary-gear").export(tmp_path / "gears.ggb")
    with pytest.raises(hg.HodographError):
        hg.Task.template("time-ratio").export(tmp_path / "task.ggb")


@pytest.mark.parametrize("ending", ["json", "txt"])
def test_imports_are_those_of_the_program(ending, program, tmp_path):
    path = hg.Scene.template("crank-rocker").export(tmp_path / f"linkage.{ending}")
    scene = hg.import_linkage(path)
    assert scene.source == program("import", str(path)).decode()
    assert scene.notes[0].code == "imported"
    assert hg.import_linkage(path.read_text()) == scene
    assert scene.solve()["omega_3"].value is not None
    with pytest.raises(hg.FileError):
        hg.import_linkage("{\n", format="pylinkage")
