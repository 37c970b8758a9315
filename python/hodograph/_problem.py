"""Files of all kinds: scenes, design tasks, motions without a mechanism."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, TypeVar, cast

from . import _native
from ._answers import Answers, Design
from ._errors import Diagnostic, HodographError, diagnostics
from ._figure import Figure, Frame, Lesson, Worksheet
from ._live import Live
from ._report import Cam, Cycle, Report, _look
from ._table import Table

Lang = Literal["en", "zh"]
Notation = Literal["en", "cn"]
Method = Literal["centres", "composite", "curvature", "cam", "trains", "loops"]
Format = Literal["dxf", "ggb", "tikz", "pptx", "pylinkage", "pylinkage-json", "pmks"]
Self = TypeVar("Self", bound="Problem")

_STILL = {"centres", "curvature", "centrodes", "inversions"}


def _text(source: Any) -> tuple[str, str]:
    """The text of a source, and the name to show."""
    if isinstance(source, Mapping):
        return json.dumps(source, ensure_ascii=False, indent=2), "input"
    if isinstance(source, str) and source.lstrip("\ufeff \t\r\n").startswith("{"):
        return source, "input"
    if not isinstance(source, (str, os.PathLike)):
        raise TypeError(f"a scene is a dict, a text in JSON or a path, not {type(source).__name__}")
    path = Path(source)
    whole = _native.included(path.read_bytes(), lambda name: (path.parent / name).read_bytes())
    return whole.decode("utf-8", "replace"), str(path)


def _quantity(name: str, value: Any) -> tuple[str, str]:
    if isinstance(value, str):
        return name, value
    if isinstance(value, bool) or not hasattr(value, "__float__"):
        raise TypeError(f"{name} is a quantity such as '120 mm' or a number, not {type(value).__name__}")
    return name, repr(float(value)) if float(value) % 1 else str(int(value))


def _words(value: Any) -> str | None:
    return None if value is None else _quantity("a value", value)[1]


def _millimetres(width: Any) -> str | None:
    text = _words(width)
    return text if width is None or isinstance(width, str) else f"{text} mm"


def _degrees(angle: Any) -> str | None:
    text = _words(angle)
    return text if angle is None or isinstance(angle, str) else f"{text} deg"


def _listed(names: str | Iterable[str] | None) -> list[str]:
    if names is None:
        return []
    return [names] if isinstance(names, str) else list(names)


class Problem:
    """A file that has been read: a `Scene`, a `Task` or a `Motion`. It is never changed."""

    _kind = ""
    _told: list[Diagnostic] = []

    def __init__(self, source: str | os.PathLike[str] | Mapping[str, Any]) -> None:
        """Reads a dict, a text in JSON, or the file at a path.

        Raises `FileError` with all faults, each at its place in the text.
        """
        self._text, self._name = _text(source)
        self._refused: HodographError | None = None
        try:
            self._native = _native.Problem(self._text, self._name)
        except HodographError as fault:
            # A figure of the pose needs no rates: it is drawn although they are missing.
            try:
                self._native = _native.Problem(self._text, self._name, still=True)
            except HodographError:
                raise fault from None
            self._refused = fault
        if self._kind and self._native.kind != self._kind:
            raise TypeError(f"this is a {self._native.kind}, not a {self._kind}: use hodograph.read")
        self._solved: dict[Any, _native.Solved] = {}

    @classmethod
    def template(cls: type[Self], name: str) -> Self:
        """The template with a name; `hodograph.templates()` lists all."""
        return cls(_native.template(name))

    @property
    def source(self) -> str:
        """The text."""
        return self._text

    @property
    def kind(self) -> str:
        """`scene`, `task`, `motion` or `equation`."""
        return self._native.kind

    @property
    def notes(self) -> list[Diagnostic]:
        """Remarks of reading."""
        return [*self._told, *diagnostics(self._native.notes)]

    def set(self: Self, values: Mapping[str, str | float] | None = None, /, **named: str | float) -> Self:
        """The problem with other values of its parameters.

        A text has a unit (`"120 mm"`, `"2*r"`); a bare number has the unit of the value that it
        replaces. Names that are no words of Python are given in a dict: `s.set({"phi_2/3": 5})`.
        """
        given = [_quantity(*one) for one in {**(values or {}), **named}.items()]
        new = type(self)(_native.with_values(self._text, given))
        new._name = self._name
        return new

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Writes the text to a file."""
        at = Path(path)
        at.write_bytes(self._text.encode())
        return at

    def _solution(self, *, still: bool = False, **options: Any) -> _native.Solved:
        """The solution for options, kept for figures and documents."""
        key = (still, *sorted(options.items()))
        if key not in self._solved:
            native = self._native
            if still:
                native = self._at_rest()
            elif self._refused is not None:
                raise self._refused
            self._solved[key] = native.solve(**options)
        return self._solved[key]

    def _at_rest(self) -> _native.Problem:
        """The file read for its pose only."""
        return _native.Problem(self._text, self._name, still=True)

    def figure(
        self,
        name: str | Iterable[str] = "sheet",
        *,
        lang: Lang | None = None,
        notation: Notation | None = None,
        style: str | Mapping[str, Any] | None = None,
        digits: int | None = None,
        width: str | float | None = None,
        page: str | None = None,
        steps: bool = False,
        vectors: Literal["velocity", "acceleration"] | None = None,
        dimensions: bool = False,
        poses: int = 0,
        path: str | Iterable[str] | None = None,
        candidate: int = 1,
        drafting: bool | str = False,
    ) -> Figure:
        """Draws a figure; `hodograph.figures()` lists the names.

        `style` is `print`, `slides`, `dark` or a style file's content. `page` is a format such as
        `a4`, `a4-landscape`, `16:9` or `80mmx120mm`: what does not fit goes to further pages;
        `width` (mm, or with a unit) is that of a column of any height. `steps` gives a page for
        each step of the construction.
        `vectors`, `dimensions`, `poses` (their number) and `path` (names of points) are drawn with
        the mechanism. `candidate` chooses one of a `Task`, from 1. `drafting` adds the tolerances
        of drawing by hand; a text is the pencil error.
        """
        if page is not None and width is not None:
            raise TypeError("`page` has a width: leave `width` out")
        names = _listed(name)
        points = _listed(path)
        moves = steps or poses > 0 or bool(points)
        native = self._solution(
            still=bool(names) and set(names) <= _STILL and not moves,
            figures=True,
            whole_motion=poses > 0 or bool(points),
            candidate=_index(candidate),
            drafting=_drafting(drafting),
        )
        look = _look(lang, notation, style, digits)
        pages = native.figures(
            names, look, steps, _millimetres(width), page, vectors, dimensions, poses, points
        )
        return Figure(pages)

    def worksheet(
        self,
        *,
        lang: Lang | None = None,
        notation: Notation | None = None,
        style: str | Mapping[str, Any] | None = None,
        digits: int | None = None,
        problem: bool = True,
        solution: bool = True,
        mistake: str | None = None,
        loops: bool = False,
        questions: bool = False,
        table: int | None = None,
        candidate: int = 1,
    ) -> Worksheet:
        """Writes the problem and its solution as a document; either can be left out.

        With `mistake`, a wrong solution is the problem: one by its name, `""` for the first. With
        `loops`, the solution is the analytic method with vector loops. With `questions`, the sheet
        asks for concepts, without drawings. With `table`, the solution has the results at that many
        equal steps over the whole motion, in the units of the book. `Scene.frame` makes a sheet to
        draw on.
        """
        if (mistake is not None) + loops + questions > 1:
            raise ValueError("a worksheet has one of a mistake, vector loops and questions")
        if table is not None and not 1 <= table <= 720:
            raise ValueError("table is a number of steps from 1 to 720")
        if table is not None and (mistake is not None or questions or not solution):
            raise ValueError("a table is part of a solution")
        if not (problem or solution):
            raise ValueError("a worksheet has the problem, the solution or both")
        sides = "both" if problem and solution else "problem" if problem else "solution"
        native = self._solution(figures=True, candidate=_index(candidate))
        look = _look(lang, notation, style, digits)
        return Worksheet(native.worksheet(sides, mistake, loops, questions, table, look))

    def lesson(
        self,
        *,
        method: Method | None = None,
        over: str | None = None,
        positions: int | None = None,
        lang: Lang | None = None,
        notation: Notation | None = None,
        style: str | Mapping[str, Any] | None = None,
        reveal: bool = False,
        width: str | float | None = None,
        candidate: int = 1,
    ) -> Lesson:
        """Writes a page with the construction step by step and a driver to drag.

        `method` chooses the construction of a scene: `centres`, `composite`, `curvature`, `cam`,
        `trains` or `loops`; without it the polygons of its questions are drawn. `over` names the
        driver; `reveal` gives a fragment for slides, `width` its width (mm).
        """
        if method is not None and reveal:
            raise ValueError("a lesson of a method is a page, not a fragment for slides")
        native = self._solution(figures=True, whole_motion=not reveal, candidate=_index(candidate))
        look = _look(lang, notation, style)
        return Lesson(native.lesson(over, positions, reveal, _millimetres(width), method, look))

    def export(
        self,
        path: str | os.PathLike[str],
        *,
        format: Format | None = None,
        name: str = "mechanism",
        lang: Lang | None = None,
        notation: Notation | None = None,
        style: str | Mapping[str, Any] | None = None,
    ) -> Path:
        """Writes a file of another program; the ending of its name, or `format`, decides.

        `.dxf` (CAD) and `.tikz` (LaTeX) hold one figure, which `name` chooses; `.ggb` is a
        construction for GeoGebra, `.pptx` has a slide for each step, `.py` and `.json` are for
        pylinkage, `.txt` and `.csv` for PMKS. The mechanism is drawn in the millimetres of the
        scene, other figures in those of the paper.
        """
        at = Path(path)
        ending = at.suffix.lower().lstrip(".")
        known = {end: word for word, endings in _native.export_formats() for end in endings}
        if format is None and ending not in known:
            raise ValueError(f"{at} ends in none of {', '.join(f'.{end}' for end in known)}: give a format")
        if format is not None and known.get(ending, format) != format:
            raise ValueError(f"{at} ends in .{ending}, and format is {format!r}")
        native = self._solution(figures=True)
        at.write_bytes(native.export(format or known[ending], name, _look(lang, notation, style)))
        return at

    def _repr_svg_(self) -> str | None:
        try:
            return self.figure()._repr_svg_()
        except HodographError:
            # A file that cannot be drawn is shown as its text.
            return None

    def __repr__(self) -> str:
        return f"<hodograph.{type(self).__name__}{': ' + self._name if self._name != 'input' else ''}>"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Problem) and type(other) is type(self) and self._text == other._text

    def __hash__(self) -> int:
        return hash(self._text)

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._text,)


def _index(candidate: int) -> int:
    if candidate < 1:
        raise ValueError("candidates are counted from 1")
    return candidate - 1


def _drafting(given: bool | str) -> str | None:
    return given if isinstance(given, str) else "" if given else None


class Scene(Problem):
    """A mechanism at an instant.

    >>> s = Scene({
    ...     "links": {"1": ["A", "B"], "2": ["B", "C"], "3": ["C", "D"], "4": ["A", "D"]}, "ground": "4",
    ...     "lengths": {"AB": "100 mm", "BC": "250 mm", "CD": "200 mm", "AD": "300 mm"},
    ...     "driver": {"link": "1", "angle": "60 deg", "omega": "10 rad/s"}, "find": ["omega_3"]})
    >>> s.solve()
    omega_3 = 2.91596 rad/s counter-clockwise
    """

    _kind = "scene"

    @property
    def parameters(self) -> dict[str, str]:
        """The parameters with their texts."""
        return dict(self._native.parameters)

    def solve(
        self,
        *,
        digits: int | None = None,
        lang: Lang | None = None,
        notation: Notation | None = None,
        drafting: bool | str = False,
    ) -> Answers:
        """Solves by drawing and by analysis; returns the answers by question.

        `digits` significant digits are certified (up to 100 and more; 6 without it). `drafting`
        adds the tolerances of drawing by hand; a text is the pencil error, such as `"0.1 mm"`.
        """
        return Answers(self._solution(drafting=_drafting(drafting)), _look(lang, notation, None, digits))

    def sweep(
        self,
        over: str | None = None,
        start: str | float | None = None,
        stop: str | float | None = None,
        *,
        steps: int | None = None,
        find: str | Sequence[str] | None = None,
        units: Literal["si", "book"] = "si",
        progress: bool = False,
    ) -> Table:
        """The answers in `steps` equal steps of a driver, a parameter or the time, both ends
        included: `steps + 1` rows.

        `over` is a driver (`phi_1`, `s_B`, `driver2`), a parameter, or `t`; without it the usual
        one moves. `start` and `stop` are numbers in the scene's unit (degrees for angles) or texts
        with a unit; without them the whole turn or travel is taken. `find` asks other questions
        than the scene. Columns are SI; with `units="book"` they are in the units that the scene
        prints. `progress` shows a bar if tqdm is installed.
        """
        if units not in ("si", "book"):
            raise ValueError("units is 'si' or 'book'")
        if steps is not None and not 0 <= steps <= 10_000_000:
            raise ValueError("steps is a whole number from 0 to 10000000")
        self._moving()
        asked = ",".join(_listed(find)) if find is not None else None
        with _bar(progress) as tell:
            native = self._native.sweep(over, _words(start), _words(stop), steps, asked, tell)
        return Table(native, units)

    def table(self, *, units: Literal["si", "book"] = "si") -> Table:
        """The answers over the whole motion of the usual driver, in 360 steps."""
        return self.sweep(units=units)

    def limits(
        self,
        over: str | None = None,
        *,
        flywheel: str | None = None,
        ranges: bool = False,
        lang: Lang | None = None,
    ) -> Report:
        """The limits of the motion: range of the driver, strokes of points and links, time ratio,
        transmission angles, Grashof type; `print` shows them as text.

        `over` names the driver; the others are at rest. The rates of the scene may be missing. In a
        scene with loads, `energy` has the mean balancing moment and the surplus of energy, with
        `flywheel`, the coefficient of speed fluctuation such as `"1/30"`, also the flywheel. With
        `ranges`, the report of a four-bar is instead: for which values of each length it keeps its
        type.

        >>> Scene.template("crank-rocker").limits()["grashof"]["type"]
        'crank-rocker'
        """
        if ranges and flywheel is not None:
            raise ValueError("a report has ranges or a flywheel, not both")
        still = self._at_rest()
        told = _native.length_ranges(still, over) if ranges else _native.limits(still, over, flywheel)
        return Report(told, lang)

    def loops(self, *, lang: Lang | None = None) -> Report:
        """The analytic method written out: vector loops, their equations, all unknowns as formulas
        with numbers; `print` shows them as text."""
        self._moving()
        return Report(_native.vector_loops(self._native), lang)

    def cycle(
        self, over: str | None = None, *, find: str | Iterable[str] | None = None, lang: Lang | None = None
    ) -> Cycle:
        """The motion cycle: working strokes, returns and dwells of the outputs over a cycle of the
        driver; `print` shows it as a table, and its `figure` as bars, lines or rings.

        `over` names the driver; the others are at rest. `find` chooses outputs such as `phi_3` or
        `s_C`; without it all links on a pivot and sliders on a guide of the ground are taken. The
        rates of the scene may be missing. Positions are rad or m of the driver.

        >>> cycle = Scene.template("slider-crank").cycle()
        >>> [phase["phase"] for phase in cycle["outputs"][0]["phases"]]
        ['forward', 'return']
        """
        return Cycle(_native.Cycle(self._at_rest(), over, _listed(find)), lang)

    def cam(
        self,
        number: int | None = None,
        *,
        alpha: str | float | None = None,
        alpha_back: str | float | None = None,
        lang: Lang | None = None,
    ) -> Cam:
        """A disc cam over a whole turn: motion of the follower, shocks, pressure angle, curvature;
        `print` shows the report, `figure` draws it, `save_profile` writes the profile.

        `number` counts from 1, and is needed if there are several. With `alpha`, the pressure angle
        allowed on the rise (degrees, or with a unit), `least` has the least base circle with the
        given offset or distance (`kept`) and with the best one (`best`); `alpha_back` is that of the
        return (75 degrees without it). Numbers are SI, angles rad.

        >>> least = Scene.template("cam-offset-roller").cam(alpha=30)["least"]
        >>> round(1000 * least["kept"]["base"], 3), round(1000 * least["best"]["base"], 3)
        (10.0, 4.024)
        """
        if alpha is None and alpha_back is not None:
            raise ValueError("alpha_back goes with alpha")
        self._moving()
        return Cam(self._native, number, _degrees(alpha), _degrees(alpha_back), lang)

    def frame(
        self,
        *,
        page: str = "a4",
        lang: Lang | None = None,
        notation: Notation | None = None,
        style: str | Mapping[str, Any] | None = None,
        digits: int | None = None,
    ) -> Frame:
        """The sheet to draw on, with the mechanism to scale and the space that the polygons need,
        and the solution to lay over it; `page` is a format such as `a4` or `a3-landscape`."""
        native = self._solution(figures=True)
        blanks, overlays = native.frame(page, _look(lang, notation, style, digits))
        return Frame(*(Figure([(str(k), p) for k, p in enumerate(of, 1)]) for of in (blanks, overlays)))

    def curves(
        self,
        *,
        lang: Lang | None = None,
        notation: Notation | None = None,
        style: str | Mapping[str, Any] | None = None,
    ) -> Figure:
        """Displacements, velocities and accelerations over the whole motion as line diagrams."""
        self._moving()
        return Figure(self._native.curves(_look(lang, notation, style)))

    def live(
        self,
        *names: str,
        over: str | None = None,
        reserve: bool = True,
        lang: Lang | None = None,
        notation: Notation | None = None,
        style: str | Mapping[str, Any] | None = None,
    ) -> Live:
        """Figures that are drawn again for other positions of the drivers.

        With `reserve`, their paper has space for the whole motion, and nothing fixed shifts.
        """
        self._moving()
        look = _look(lang, notation, style)
        native = _native.Moving(self._native, list(names) or ["sheet"], over, reserve, look)
        return Live(native, self._solution().names[1])

    def widget(self, *names: str, **options: Any) -> Any:
        """Figures with a slider for the driver, for notebooks; needs `anywidget`."""
        from ._widget import widget

        return widget(self, names or ("mechanism", "velocity", "acceleration"), options)

    def _moving(self) -> None:
        if self._refused is not None:
            raise self._refused


class Task(Problem):
    """A design task, whose candidates are scenes."""

    _kind = "task"

    def solve(self, *, candidate: int = 1, lang: Lang | None = None, digits: int | None = None) -> Design:
        """Finds the candidates; `candidate` (from 1) is the one whose construction is described."""
        return Design(self._solution(candidate=_index(candidate)), _look(lang, None, None, digits))


class Motion(Problem):
    """Motions of points without a mechanism."""

    _kind = "motion"

    def solve(
        self, *, digits: int | None = None, lang: Lang | None = None, notation: Notation | None = None
    ) -> Answers:
        """Solves by drawing and by analysis; returns the answers by question."""
        return Answers(self._solution(), _look(lang, notation, None, digits))


class Equation(Problem):
    """A vector equation on its own."""

    _kind = "equation"

    def solve(
        self, *, digits: int | None = None, lang: Lang | None = None, notation: Notation | None = None
    ) -> Answers:
        """Solves by drawing and in closed form; two solutions are named `v_C'` and `v_C''`."""
        return Answers(self._solution(), _look(lang, notation, None, digits))


_KINDS: dict[str, type[Problem]] = {"scene": Scene, "task": Task, "motion": Motion, "equation": Equation}


def read(source: str | os.PathLike[str] | Mapping[str, Any]) -> Scene | Task | Motion | Equation:
    """Reads a file of any kind: a dict, a text in JSON, or the file at a path."""
    text, name = _text(source)
    of = _KINDS[_native.kind_of(text)](text)
    of._name = name
    return cast("Scene | Task | Motion | Equation", of)


def import_linkage(
    source: str | os.PathLike[str], *, format: Literal["pylinkage", "pmks"] | None = None
) -> Scene:
    """The scene of another program's linkage: the file at a path, or its text.

    `.json` is a file of pylinkage (`mechanism_to_json`), `.txt` and `.csv` are of PMKS; without such
    an ending the text decides, unless `format` does. `notes` says what the file does not give.
    """
    if isinstance(source, str) and ("\n" in source or source.lstrip("\ufeff \t").startswith("{")):
        text, name, ending = source, "input", None
    else:
        path = Path(source)
        text, name, ending = path.read_text(encoding="utf-8"), str(path), path.suffix.lower().lstrip(".")
    scene, notes = _native.import_linkage(text, name, ending or None, format)
    made = Scene(scene)
    made._told = diagnostics(notes)
    return made


@dataclass(frozen=True)
class Template:
    """A file with parameters that can be set."""

    name: str
    kind: str
    """`scene`, `task`, `motion` or `equation`."""
    title: dict[str, str]
    """The title in both languages."""
    parameters: dict[str, str]
    """The parameters of a scene with their values."""


def templates() -> list[Template]:
    """All templates: scenes, design tasks, motions, vector equations."""
    return [
        Template(name, kind, {"en": en, "zh": zh}, dict(parameters))
        for name, kind, (en, zh), parameters in _native.templates()
    ]


def template(name: str) -> Scene | Task | Motion | Equation:
    """The template with a name, whatever its kind."""
    return read(_native.template(name))


def figures() -> dict[str, dict[str, str]]:
    """The names of all figures, each with its content in both languages."""
    return {name: {"en": en, "zh": zh} for name, en, zh in _native.figures()}


def schema(kind: Literal["scene", "task", "motion", "equation"] = "scene") -> dict[str, Any]:
    """The JSON Schema of a kind of file."""
    text = _native.schema(kind)
    if text is None:
        raise ValueError("kind is 'scene', 'task', 'motion' or 'equation'")
    told: dict[str, Any] = json.loads(text)
    return told


class _bar:
    """A progress bar while work runs, if it is asked for and tqdm is installed."""

    def __init__(self, shown: bool) -> None:
        self._bar: Any = None
        if shown:
            try:
                from tqdm.auto import tqdm
            except ImportError:
                return
            self._bar = tqdm(unit=" positions", leave=False)

    def __enter__(self) -> Callable[[int, int], None] | None:
        return None if self._bar is None else self._tell

    def _tell(self, done: int, total: int) -> None:
        self._bar.total = total
        self._bar.update(done - self._bar.n)

    def __exit__(self, *_: object) -> None:
        if self._bar is not None:
            self._bar.close()


