"""Many mechanisms from one scene."""

from __future__ import annotations

import operator
from collections.abc import Mapping, Sequence
from typing import Any, Literal

from ._problem import Scene, _bar, _listed, _quantity, _words
from ._table import Table


def _asked(
    scene: Scene, vary: Mapping[str, Sequence[Any]], steps: int | None, find: str | Sequence[str] | None
) -> tuple[list[str], str | None]:
    """The ranges and the questions in words."""
    if not isinstance(scene, Scene):
        raise TypeError(f"a batch is of a Scene, not of {type(scene).__name__}")
    if steps is not None and not 0 <= steps <= 100_000:
        raise ValueError("steps is a whole number from 0 to 100000")
    ranges = []
    for name, given in vary.items():
        if isinstance(given, str) or len(given) not in (2, 3):
            raise TypeError(f"{name} varies as (from, to) or (from, to, count)")
        low, high, *count = given
        if count and not 1 <= count[0] <= 10_000_000:
            raise ValueError(f"{name} has from 1 to 10000000 values, not {count[0]}")
        ends = "..".join(_quantity(name, value)[1] for value in (low, high))
        ranges.append(f"{name}={ends}" + (f":{operator.index(count[0])}" if count else ""))
    scene._moving()
    return ranges, ",".join(_listed(find)) if find is not None else None


def batch(
    scene: Scene,
    vary: Mapping[str, Sequence[Any]],
    *,
    random: int | None = None,
    seed: int = 1,
    over: str | None = None,
    start: str | float | None = None,
    stop: str | float | None = None,
    steps: int | None = None,
    find: str | Sequence[str] | None = None,
    mechanisms: tuple[int, int] | None = None,
    units: Literal["si", "book"] = "si",
    progress: bool = False,
) -> Table:
    """Solves many mechanisms whose parameters vary; returns their answers as columns.

    `vary` gives each parameter `(from, to)` or `(from, to, count)`: numbers in the scene's unit or
    texts with a unit. Without `random`, all combinations of the counts (2 without one) are solved;
    with it, that many mechanisms with parameters drawn uniformly between the bounds; the draw depends on
    `seed` alone. With `steps`, each is solved at `steps + 1` positions of its driver from `start`
    to `stop`, else in the scene's pose. Columns: `mechanism`, the parameters, the driver, the
    answers; positions that cannot be assembled have no row. The rows do not depend on the number of
    processors, and are those of `hodograph batch`.

    `mechanisms=(a, b)` solves those from number a to before b, counted from 0, with the rows that
    they have in the whole batch: a large one is solved piece by piece in little memory.
    """
    if units not in ("si", "book"):
        raise ValueError("units is 'si' or 'book'")
    if mechanisms is not None and not 0 <= mechanisms[0] <= mechanisms[1]:
        raise ValueError("mechanisms is (first, last), numbers from 0")
    ranges, asked = _asked(scene, vary, steps, find)
    with _bar(progress) as tell:
        native = scene._native.batch(
            ranges, random, seed, over, _words(start), _words(stop), steps, asked, mechanisms, tell
        )
    return Table(native, units)
