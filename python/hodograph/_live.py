"""Figures that are drawn again while their drivers are dragged."""

from __future__ import annotations

from collections.abc import Sequence

from . import _native


class Live:
    """Figures prepared to be drawn again for other positions of their drivers.

    Scales, arrangement and the ids of all elements stay. A position that cannot be assembled is a
    `HodographError`, and the figures remain.
    """

    def __init__(self, native: _native.Moving, drivers: list[str]) -> None:
        self._native = native
        self._drivers = drivers
        self._pages: dict[str, str] = dict(native.redraw_after(0.0))

    @property
    def values(self) -> list[float]:
        """The positions of the drivers (rad or m)."""
        return self._native.values

    @property
    def names(self) -> list[str]:
        """The names of the pages."""
        return list(self._pages)

    def drag(self, values: float | Sequence[float]) -> Live:
        """Draws the figures for positions of the drivers (rad or m)."""
        given = [values] if isinstance(values, (int, float)) else list(values)
        self._pages = dict(self._native.redraw(given))
        return self

    def travel(self, by: float) -> Live:
        """Draws the figures after a travel (rad, m or s) of the driver from the scene's own pose."""
        self._pages = dict(self._native.redraw_after(float(by)))
        return self

    @property
    def svgs(self) -> dict[str, str]:
        """The pages as SVG, by name."""
        return dict(self._pages)

    @property
    def svg(self) -> str:
        """The first page as SVG."""
        return next(iter(self._pages.values()))

    @property
    def answers(self) -> dict[str, str]:
        """The answers in the pose of the figures, as text, by question."""
        return dict(self._native.answers((None, None, None, None)))

    def _repr_svg_(self) -> str | None:
        return self.svg if len(self._pages) == 1 else None

    def _repr_html_(self) -> str | None:
        return None if len(self._pages) == 1 else "".join(self._pages.values())
