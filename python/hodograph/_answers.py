"""Answers of scenes and motions, and candidates of design tasks."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

from . import _native
from ._errors import Diagnostic, diagnostics

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ._problem import Scene

    Value = float | NDArray[np.float64]


def _value(told: Any) -> Value | None:
    if isinstance(told, list):
        import numpy as np

        return np.array(told)
    return None if told is None else float(told)


class Answer:
    """The answer to one question."""

    def __init__(self, told: dict[str, Any], of: Answers) -> None:
        self._told = told
        self._of = of

    @property
    def find(self) -> str:
        """The question, such as `v_C`."""
        return str(self._told["find"])

    @property
    def symbol(self) -> str:
        """The symbol of the quantity as figures print it, such as `a^{c}_{A3A2}`."""
        return str(self._told["symbol"])

    @property
    def unit(self) -> str:
        """The SI unit of the numbers."""
        return str(self._told["unit"])

    @property
    def text(self) -> str:
        """The value with its certified digits, in the unit of the file, with sense or direction."""
        return str(self._told["text"])

    @property
    def value(self) -> Value | None:
        """The value in SI: a `float`, or for vectors and points an array of shape (2,), x and y.

        `None` if the question has no answer in this pose; `why` says the reason.
        """
        return _value(self._told["value"])

    @property
    def drawing(self) -> Value | None:
        """The value read off the drawing, in SI as `value`; `None` if it was not drawn."""
        return _value(self._told["drawn"])

    @property
    def difference(self) -> float | None:
        """The relative difference between drawing and analysis."""
        return _number(self._told["difference"])

    @property
    def magnitude(self) -> float | None:
        """The length of a vector, or the absolute value of a number (SI)."""
        import math

        told = self._told["value"]
        if told is None:
            return None
        return math.hypot(*told) if isinstance(told, list) else abs(told)

    @property
    def direction(self) -> float | None:
        """The direction of a vector in degrees, counter-clockwise from the x axis."""
        value = (self._detail.get("value") or {}) if self._of.kind == "scene" else {}
        return _number(value.get("angle_deg") if isinstance(value, dict) else None)

    @property
    def sense(self) -> str | None:
        """`counter-clockwise` or `clockwise` for what turns; `None` for what does not or is zero."""
        told = self._told["value"]
        if not self._told["turns"] or not isinstance(told, (int, float)) or told == 0:
            return None
        return "counter-clockwise" if told > 0 else "clockwise"

    @property
    def _detail(self) -> dict[str, Any]:
        return self._of._details[self.find]

    @property
    def analysis(self) -> Value | None:
        """The value of the loop equations, in SI as `value`."""
        told = self._detail.get("analysis")
        if not isinstance(told, dict):
            return None
        return _value(told.get("value", [told.get("x"), told.get("y")]))

    @property
    def certificate(self) -> dict[str, Any]:
        """The certified numbers with their bounds: `{"rung", "complete", "why", "numbers"}`."""
        return dict(self._detail.get("certified") or {})

    @property
    def digits(self) -> int:
        """The number of significant digits of all printed numbers that are certified."""
        numbers = self.certificate.get("numbers") or {}
        return min((int(n["digits"] or 0) for n in numbers.values()), default=0)

    @property
    def millimetres(self) -> float | None:
        """The length that is measured on the paper (mm)."""
        return _number(self._detail.get("measured_mm"))

    @property
    def measured_between(self) -> tuple[str, str] | None:
        """The marks between which it is measured."""
        told = self._detail.get("measured_between")
        return (str(told[0]), str(told[1])) if told else None

    @property
    def scale(self) -> float | None:
        """The scale μ of the drawing (SI units for a millimetre of paper)."""
        return _number(self._detail.get("scale"))

    @property
    def why(self) -> Any:
        """The reason why there is no answer."""
        return self._detail.get("why")

    def __float__(self) -> float:
        value = self._told["value"]
        if isinstance(value, (int, float)):
            return float(value)
        raise TypeError(f"{self.find} is {'a vector' if value else 'without a value'}: use .value or .magnitude")

    def __repr__(self) -> str:
        return f"{self.find} = {self.text}"


def _number(told: Any) -> float | None:
    return None if told is None else float(told)


class _Solution:
    """Members of the solutions of every kind."""

    def __init__(self, native: _native.Solved, look: _native.Look) -> None:
        self._native = native
        self._look = look

    @property
    def notes(self) -> list[Diagnostic]:
        """Remarks of reading and solving."""
        return diagnostics(self._native.notes)

    @property
    def verdict(self) -> str:
        """`answered`; `unanswered` if answers do not exist in this pose; `disagree` if drawing and
        analysis disagree, which is an error of hodograph."""
        return self._native.verdict

    @cached_property
    def json(self) -> dict[str, Any]:
        """The document that `hodograph solve --json` prints (`hodograph/solved/1`), in SI."""
        told: dict[str, Any] = json.loads(self._native.json(self._look))
        return told

    def text(self, steps: bool = False) -> str:
        """The answers as text; with `steps` the construction and its measured lengths, too."""
        return self._native.text(self._look, steps)

    def __str__(self) -> str:
        return self.text()


class Answers(_Solution, Mapping[str, Answer]):
    """The answers to the questions of a scene or of motions, by question."""

    @property
    def kind(self) -> str:
        """`scene` or `motion`."""
        return str(self.json["kind"])

    @cached_property
    def _all(self) -> dict[str, Answer]:
        told = json.loads(self._native.answers(self._look))
        return {one["find"]: Answer(one, self) for one in told}

    @cached_property
    def _details(self) -> dict[str, dict[str, Any]]:
        return {one["find"]: one for one in self.json["answers"]}

    def __getitem__(self, find: str) -> Answer:
        try:
            return self._all[find]
        except KeyError:
            raise KeyError(f"{find!r} is not asked; the questions are {', '.join(self._all)}") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._all)

    def __len__(self) -> int:
        return len(self._all)

    @property
    def points(self) -> dict[str, tuple[float, float] | None]:
        """The places of the points of a scene (m); `None` for a point without one."""
        return dict(zip(self._native.names[0], self._native.places))

    def __repr__(self) -> str:
        return "\n".join(repr(answer) for answer in self._all.values())

    def _repr_html_(self) -> str:
        from html import escape

        def drawn(a: Answer) -> str:
            return "" if a.difference is None else f"{a.difference:.1e}"

        cells = ((a.find, a.text, drawn(a)) for a in self._all.values())
        rows = "".join(
            "<tr>" + "".join(f"<td style='text-align:left'>{escape(c)}</td>" for c in row) + "</tr>" for row in cells
        )
        head = "".join(f"<th style='text-align:left'>{c}</th>" for c in ("", "answer", "drawing − analysis"))
        return f"<table><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>"


class Design(_Solution, Sequence["Scene"]):
    """The candidates of a design task, each a scene, the best first."""

    @cached_property
    def _scenes(self) -> list[Scene]:
        from ._problem import Scene

        return [Scene(text) for text in self._native.candidates]

    @property
    def candidates(self) -> list[dict[str, Any]]:
        """Numbers (SI), deviations, defects and transmission angles of each candidate."""
        return list(self.json["candidates"])

    def __getitem__(self, index: Any) -> Any:
        return self._scenes[index]

    def __len__(self) -> int:
        return len(self._native.candidates)

    def __repr__(self) -> str:
        return self.text()
