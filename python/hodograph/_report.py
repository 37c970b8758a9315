"""Reports: data with a text for people."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any, Literal

from . import _native
from ._errors import Diagnostic, diagnostics


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
