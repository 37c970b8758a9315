"""Many mechanisms from one scene."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal

from ._problem import Scene, _bar, _listed, _quantity, _words
from ._table import Table


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
    """
    if units not in ("si", "book"):
        raise ValueError("units is 'si' or 'book'")
    if steps is not None and not 0 <= steps <= 100_000:
        raise ValueError("steps is a whole number from 0 to 100000")
    ranges = []
    for name, given in vary.items():
        if isinstance(given, str) or len(given) not in (2, 3):
            raise TypeError(f"{name} varies as (from, to) or (from, to, count)")
        low, high, *count = given
        ends = "..".join(_quantity(name, value)[1] for value in (low, high))
        ranges.append(f"{name}={ends}" + (f":{int(count[0])}" if count else ""))
    scene._moving()
    asked = ",".join(_listed(find)) if find is not None else None
    with _bar(progress) as tell:
        native = scene._native.batch(
            ranges, random, seed, over, _words(start), _words(stop), steps, asked, tell
        )
    return Table(native, units)
