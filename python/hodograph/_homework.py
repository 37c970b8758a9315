"""Homework: variants of a problem for a class, and the marking of answers."""

from __future__ import annotations

import csv
import json
import operator
import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, overload

from . import _native
from ._errors import Diagnostic, diagnostics
from ._problem import Lang, Notation, Scene, _listed, _quantity
from ._report import _look

Platform = Literal["moodle", "qti3", "qti2", "canvas", "prairielearn"]


@dataclass(frozen=True)
class Key:
    """The answer to a question of a variant, in the printed unit."""

    question: str
    """The question as the scene writes it; of a place, `.x` or `.y` is added."""
    unit: str
    """The unit, such as `m/s^2`."""
    value: float
    """The value: of a vector the magnitude; of a rotation positive counter-clockwise."""
    tolerance: float
    """The tolerance of the pencil, in the unit."""
    mistakes: dict[str, float]
    """The values of typical wrong solutions by their words in English."""


@dataclass(frozen=True)
class Variant:
    """A problem with other numbers."""

    number: int
    """The number, from 1."""
    student: str | None
    """The student who gets it."""
    values: dict[str, str]
    """The varied parameters as the scene writes them."""
    scene: Scene
    """The scene."""
    key: list[Key]
    """The key, one entry for each number that is asked for."""


class Variants(Sequence[Variant]):
    """The variants of a problem, in order."""

    def __init__(self, native: _native.Variants) -> None:
        self._native = native
        self._all = [
            Variant(number, student, dict(values), Scene(text), [_key(one) for one in json.loads(key)])
            for number, student, values, text, key in native.all
        ]

    @property
    def notes(self) -> list[Diagnostic]:
        """Remarks of reading and choosing."""
        return diagnostics(self._native.notes)

    @overload
    def __getitem__(self, at: int) -> Variant: ...
    @overload
    def __getitem__(self, at: slice) -> Sequence[Variant]: ...
    def __getitem__(self, at: int | slice) -> Variant | Sequence[Variant]:
        return self._all[at]

    def __len__(self) -> int:
        return len(self._all)

    def __repr__(self) -> str:
        return f"<hodograph.Variants: {len(self)}>"

    def save(
        self,
        folder: str | os.PathLike[str],
        *,
        platforms: Platform | Iterable[Platform] = (),
        frame: bool = False,
        page: str = "a4",
        lang: Lang | None = None,
        notation: Notation | None = None,
        style: str | Mapping[str, Any] | None = None,
        digits: int | None = None,
    ) -> list[Path]:
        """Writes problems.pdf, solutions.pdf, answers.csv (the key for `mark`) and values.csv into a
        folder, which is made if necessary; returns the files.

        `platforms` adds questions for learning platforms; `frame` adds frames.pdf, a sheet to draw
        on for each variant, on pages of a format, and overlays.pdf, their solutions.
        """
        chosen = list(dict.fromkeys(_listed(platforms)))
        look = _look(lang, notation, style, digits)
        written = []
        for name, content in self._native.files(chosen, page if frame else None, look):
            at = Path(folder) / name
            at.parent.mkdir(parents=True, exist_ok=True)
            at.write_bytes(content)
            written.append(at)
        return written


def _key(one: dict[str, Any]) -> Key:
    mistakes = {m["words"]["en"]: m["value"] for m in one.pop("mistakes")}
    return Key(**one, mistakes=mistakes)


def variants(
    scene: Scene,
    vary: Mapping[str, Sequence[Any]] | None = None,
    *,
    count: int | None = None,
    seed: int = 1,
    students: Iterable[str] | str | os.PathLike[str] = (),
) -> Variants:
    """Variants of a problem with round numbers, for a class: each pose can be drawn, and no two have
    the same answers.

    `vary` gives each parameter `(from, to, step)`: numbers in the scene's unit or texts with a unit.
    `students` are names, or the path of a CSV file with them: each gets a variant. `count` is the
    number of variants, up to 200 (one for each name without it, else 30). The same seed gives the
    same variants.

    >>> all = variants(Scene.template("crank-rocker"), {"phi_1": (20, 160, 10)}, count=2, seed=7)
    >>> [one.key[0].question for one in all]
    ['v_C', 'v_C']
    """
    if not isinstance(scene, Scene):
        raise TypeError("variants are made of a scene")
    scene._moving()
    ranges = []
    for name, given in (vary or {}).items():
        if isinstance(given, str) or len(given) != 3:
            raise TypeError(f"{name} varies as (from, to, step)")
        low, high, step = (_quantity(name, value)[1] for value in given)
        ranges.append(f"{name}={low}..{high}/{step}")
    if isinstance(students, (str, os.PathLike)):
        students = _native.roster(Path(students).read_text(encoding="utf-8-sig"))
    number = None if count is None else operator.index(count)
    if number is not None and not 1 <= number <= 200:
        raise ValueError("count is a whole number from 1 to 200")
    return Variants(_native.Variants(scene._native, ranges, number, seed, list(students)))


class Marks(Sequence[dict[str, str]]):
    """The marks of a class: a row for each answer, by the names of the columns."""

    def __init__(self, en: str, zh: str) -> None:
        self._texts = {"en": en, "zh": zh}
        self._rows = list(csv.DictReader(en.splitlines()))

    def csv(self, lang: Lang = "en") -> str:
        """The marks as CSV."""
        return self._texts[lang]

    def save(self, path: str | os.PathLike[str], *, lang: Lang = "en") -> Path:
        """Writes the marks as CSV."""
        at = Path(path)
        at.write_bytes(self.csv(lang).encode())
        return at

    @overload
    def __getitem__(self, at: int) -> dict[str, str]: ...
    @overload
    def __getitem__(self, at: slice) -> Sequence[dict[str, str]]: ...
    def __getitem__(self, at: int | slice) -> dict[str, str] | Sequence[dict[str, str]]:
        return self._rows[at]

    def __len__(self) -> int:
        return len(self._rows)

    def __repr__(self) -> str:
        return f"<hodograph.Marks: {len(self)} answers>"


def mark(answers: str | os.PathLike[str], keys: str | os.PathLike[str]) -> Marks:
    """Marks the answers of a class by the key of its variants (`answers.csv` of `Variants.save`);
    both are paths, or texts in CSV.

    The answers have the columns student, variant, question, value, unit. A mark is partial by the
    tolerance of the pencil; the remark names the likely mistake.
    """
    return Marks(*_native.mark(_table(answers), _table(keys)))


def _table(source: str | os.PathLike[str]) -> str:
    if isinstance(source, str) and "\n" in source:
        return source
    return Path(source).read_text(encoding="utf-8-sig")
