"""Reports: data with a text for people, and figures."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from os import PathLike
from pathlib import Path
from typing import Any, Literal

from . import _native
from ._errors import Diagnostic, diagnostics
from ._figure import Figure, _ending


class Report(Mapping[str, Any]):
    """The data of a report by name (SI units, radians), with its text; `dict(report)` is a dict."""

    def __init__(self, told: _native.Report, lang: Literal["en", "zh"] | None) -> None:
        data, en, zh, notes, spoken = told
        self._data: dict[str, Any] = json.loads(data)
        self._texts = {"en": en, "zh": zh}
        self._lang = lang or spoken
        self._notes = notes

    def text(self, lang: Literal["en", "zh"] | None = None) -> str:
        """The report as the program prints it."""
        return self._texts[lang or self._lang]

    @property
    def notes(self) -> list[Diagnostic]:
        """Remarks of reading and solving."""
        return diagnostics(self._notes)

    def __getitem__(self, name: str) -> Any:
        return self._data[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._data)

    def __len__(self) -> int:
        return len(self._data)

    def __repr__(self) -> str:
        return self.text()


def _look(
    lang: str | None = None, notation: str | None = None, style: Any = None, digits: int | None = None
) -> _native.Look:
    return lang, notation, json.dumps(style) if isinstance(style, Mapping) else style, digits


class Cycle(Report):
    """The motion cycle of a scene's outputs."""

    def __init__(self, native: _native.Cycle, lang: Literal["en", "zh"] | None) -> None:
        super().__init__(native.report, lang)
        self._native = native

    def figure(
        self,
        form: Literal["bars", "straight", "polar"] = "bars",
        *,
        lang: Literal["en", "zh"] | None = None,
        style: str | Mapping[str, Any] | None = None,
    ) -> Figure:
        """The cycle as a row of bars for each output, as straight lines over the position of the
        driver, or as rings."""
        return Figure([("cycle", self._native.figure(form, _look(lang or self._lang, None, style)))])

    def _repr_svg_(self) -> str | None:
        return self.figure()._repr_svg_()


class Cam(Report):
    """A disc cam over a whole turn."""

    def __init__(
        self,
        problem: _native.Problem,
        number: int | None,
        alpha: str | None,
        alpha_back: str | None,
        lang: Literal["en", "zh"] | None,
    ) -> None:
        super().__init__(_native.cam(problem, number, alpha, alpha_back), lang)
        self._problem, self._number, self._alpha = problem, number, (alpha, alpha_back)

    def figure(
        self,
        *,
        lang: Literal["en", "zh"] | None = None,
        style: str | Mapping[str, Any] | None = None,
    ) -> Figure:
        """The diagrams of the motion, the profile by inversion and, with `alpha`, the s′-s diagram
        of the least base circle: `figure().pages`."""
        look = _look(lang or self._lang, None, style)
        return Figure(_native.cam_figures(self._problem, self._number, *self._alpha, look))

    def save_profile(self, path: str | PathLike[str], *, steps: int = 720) -> Path:
        """Writes the profile in `steps` of a turn: `.csv` with a row for each angle, or `.dxf` for a
        machine that cuts (mm)."""
        if not 12 <= steps <= 100_000:
            raise ValueError("steps is a whole number from 12 to 100000")
        at, ending = _ending(path, ("csv", "dxf"))
        at.write_bytes(_native.cam_profile(self._problem, self._number, steps, ending == "dxf"))
        return at


class Comparison(Report):
    """Several designs side by side: extremes, means, strokes, time ratios, transmission angles."""

    def __init__(self, native: _native.Comparison, lang: Literal["en", "zh"] | None) -> None:
        super().__init__(native.report(), lang)
        self._native = native

    def csv(self, lang: Literal["en", "zh"] | None = None) -> str:
        """The table as CSV."""
        return self._native.csv(_look(lang or self._lang, None, None))

    def figure(
        self,
        *,
        lang: Literal["en", "zh"] | None = None,
        notation: Literal["en", "cn"] | None = None,
        style: str | Mapping[str, Any] | None = None,
    ) -> Figure:
        """One diagram for each quantity, with a curve for each design."""
        look = _look(lang or self._lang, notation, style)
        return Figure([("comparison", self._native.figure(look))])

    def _repr_svg_(self) -> str | None:
        return self.figure()._repr_svg_()
