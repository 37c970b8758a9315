"""Faults as exceptions, and the limit of time."""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from . import _native


@dataclass(frozen=True)
class Diagnostic:
    """A fault, a warning or a note.

    Lines and columns count from 1 in characters; they are `None` where nothing is pointed at.
    """

    severity: str
    """`error`, `warning` or `note`."""
    code: str
    """A stable word, such as `unknown-key`; `hodograph explain CODE` explains it."""
    message: dict[str, str]
    """The sentence in both languages: `{"en": ..., "zh": ...}`."""
    help: dict[str, str] | None
    """The remedy in both languages."""
    file: str | None
    """The file, or the argument that is at fault (`start`, `find`, ...)."""
    line: int | None
    column: int | None
    end_line: int | None
    end_column: int | None

    def __str__(self) -> str:
        return f"{self.severity} [{self.code}]: {self.message['en']}"

    @classmethod
    def _of(cls, told: dict[str, Any]) -> Diagnostic:
        place = told["place"] or {}
        at = {key: place.get(key) for key in ("line", "column", "end_line", "end_column")}
        return cls(told["severity"], told["code"], told["message"], told["help"], told["file"], **at)


def diagnostics(document: str) -> list[Diagnostic]:
    """The diagnostics of a document in JSON."""
    return [Diagnostic._of(told) for told in json.loads(document)["diagnostics"]]


class HodographError(ValueError):
    """Something cannot be read, solved or drawn.

    `str()` shows each fault with its place in the text and its remedy.
    """

    def __init__(self, document: str, en: str, zh: str) -> None:
        super().__init__(document, en, zh)
        self.json: dict[str, Any] = json.loads(document)
        """The document of the program with `--errors json` (`hodograph/errors/1`)."""
        self.texts: dict[str, str] = {"en": en, "zh": zh}
        """The text for people in both languages."""

    @property
    def diagnostics(self) -> list[Diagnostic]:
        """All faults."""
        return [Diagnostic._of(told) for told in self.json["diagnostics"]]

    @property
    def code(self) -> str:
        """The code of the first fault."""
        return str(self.json["diagnostics"][0]["code"]) if self.json["diagnostics"] else ""

    def __str__(self) -> str:
        return "\n" + self.texts["en"].rstrip()


class FileError(HodographError):
    """A text has faults: each has its place in it."""


class ArgumentError(HodographError):
    """An argument cannot be used: a range, a question, a value of a parameter."""


class SolveError(HodographError):
    """A file that can be read cannot be solved or drawn."""


class StoppedError(HodographError, TimeoutError):
    """Work took longer than the `time_limit`."""


class PartsError(RuntimeError):
    """Parts of a batch are missing or damaged."""


class InternalError(RuntimeError):
    """An error of hodograph itself."""


_ARGUMENTS = {
    "alpha", "alpha_back", "count", "distance", "drafting", "find", "flywheel", "folder", "format", "helix", "modules", "output",
    "over", "page", "path", "platforms", "ratio", "set", "shifts", "stages", "start", "stop", "style", "taper", "teeth", "vary", "vectors", "width",
    "within",
}  # fmt: skip
_FILES = {"answers", "keys", "students"}
_OPTIONS = {"digits", "format", "id-prefix", "lang", "no-figure", "notation", "unknown-style", "unknown-template", "form", "method", "platform"}


def made(document: str, en: str, zh: str) -> HodographError:
    """The exception for faults; the native module calls it."""
    first = (json.loads(document)["diagnostics"] or [{"code": "", "file": None, "place": None}])[0]
    kind: type[HodographError] = SolveError
    if first["code"] in ("stopped", "interrupted"):
        kind = StoppedError
    elif first["file"] in _ARGUMENTS or first["code"] in _OPTIONS:
        kind = ArgumentError
    elif first["place"] is not None or first["file"] in _FILES or first["code"] == "import":
        kind = FileError
    return kind(document, en, zh)


@contextmanager
def time_limit(seconds: float | None) -> Iterator[None]:
    """Stops work that this thread begins within the block after some time, with `StoppedError`.

    >>> import hodograph as hg
    >>> with hg.time_limit(10):
    ...     r = hg.Scene.template("shaper").solve()
    """
    before = _native.limit(seconds)
    try:
        yield
    finally:
        _native.limit(before)
