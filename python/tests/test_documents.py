"""The code in the guide, the docstrings and the notebooks runs; the types hold."""

import ast
import doctest
import importlib
import inspect
import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

import hodograph as hg
from hodograph import _native

ROOT = Path(__file__).resolve().parents[2]
NOTEBOOKS = sorted((ROOT / "python" / "notebooks").glob("*.ipynb"))


def test_the_guide_runs(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"```python\n(.*?)```", (ROOT / "docs" / "python.md").read_text(), re.S)
    names = {}
    for block in blocks:
        exec(block, names)
    assert len(blocks) >= 8 and (tmp_path / "centres.pdf").stat().st_size > 1000


def test_the_guide_to_many_machines_runs(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (block,) = re.findall(r"```python\n(.*?)```", (ROOT / "docs" / "cluster.md").read_text(), re.S)
    exec(block, {})
    assert (tmp_path / "linkages.parquet").stat().st_size > 1e6


def test_the_page_of_the_package_runs():
    (block,) = re.findall(r"```python\n(.*?)```", (ROOT / "python" / "README.md").read_text(), re.S)
    exec(block, {})


@pytest.mark.parametrize("name", ["", "._problem", "._errors", "._table", "._answers", "._figure", "._parts", "._report", "._designs", "._homework", ".ray"])
def test_docstrings_run(name):
    module = importlib.import_module("hodograph" + name)
    assert doctest.testmod(module).failed == 0


def shown(value):
    """Returns the HTML by which a notebook shows a value."""
    for name in ("_repr_svg_", "_repr_html_"):
        made = getattr(value, name, lambda: None)()
        if made:
            return made
    return repr(value)


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda p: p.stem)
def test_notebooks_run(path, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names = {"display": shown}
    cells = [c for c in json.loads(path.read_text())["cells"] if c["cell_type"] == "code"]
    assert len(cells) >= 5
    drawn = 0
    for cell in cells:
        body = ast.parse("".join(cell["source"])).body
        last = body.pop() if body and isinstance(body[-1], ast.Expr) else None
        exec(compile(ast.Module(body, []), str(path), "exec"), names)
        if last is not None:
            drawn += "<svg" in shown(eval(compile(ast.Expression(last.value), str(path), "eval"), names))
    assert drawn >= 2


def test_there_are_three_notebooks():
    assert [p.stem for p in NOTEBOOKS] == ["design-study", "homework", "lecture"]


def test_everything_public_is_described():
    for name in hg.__all__:
        thing = getattr(hg, name)
        assert inspect.getdoc(thing), name
        if inspect.isclass(thing) and thing.__module__.startswith("hodograph"):
            for key, member in vars(thing).items():
                if not key.startswith("_") and callable(getattr(member, "fget", member)):
                    assert inspect.getdoc(member), f"{name}.{key}"


def test_stubs_name_what_the_native_module_has():
    stub = Path(hg.__file__).with_name("_native.pyi")
    told = {n.name: n for n in ast.parse(stub.read_text()).body if isinstance(n, (ast.ClassDef, ast.FunctionDef))}
    there = {n for n in dir(_native) if not n.startswith("_")}
    assert set(told) == there
    for name, node in told.items():
        if isinstance(node, ast.ClassDef):
            members = {m.name for m in node.body if isinstance(m, ast.FunctionDef)} - {"__init__", "__len__"}
            own = {m for m in vars(getattr(_native, name)) if not m.startswith("__")}
            assert members - {"__array_interface__"} == own, name
        else:
            expected = [a.arg for a in node.args.args]
            assert list(inspect.signature(getattr(_native, name)).parameters) == expected, name


def test_the_types_hold():
    pytest.importorskip("mypy")
    # The package by its name: a path into the environment makes its other modules sources, too.
    command = [sys.executable, "-m", "mypy", "--config-file", str(ROOT / "python" / "pyproject.toml"), "-p", "hodograph"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def test_numpy_is_imported_when_it_is_used():
    code = "import sys, hodograph as hg; hg.Scene.template('shaper').solve()['omega_3'].value; assert 'numpy' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)
