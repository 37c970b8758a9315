"""Several designs side by side, and numbers of teeth."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal

from . import _native
from ._problem import Scene, _listed, _words
from ._report import Comparison, Report


def compare(
    *scenes: Scene,
    over: str | None = None,
    find: str | Sequence[str] | None = None,
    names: Sequence[str] | None = None,
    lang: Literal["en", "zh"] | None = None,
) -> Comparison:
    """Compares designs over their whole motion: extremes with their places, means, strokes, time
    ratios, transmission angles; `print` shows the table, `figure()` a curve for each design.

    Outputs and quantities of the same name are compared. `over` names the driver of each that
    moves; `find` asks other questions than the scenes. `names` are those of the columns; without
    them they are the names of the files, or `A`, `B`, ... Numbers are SI.

    >>> four_bar = Scene.template("crank-rocker")
    >>> both = compare(four_bar, four_bar.set(l_AB=90), find="omega_3")
    >>> [design["file"] for design in both["designs"]]
    ['A', 'B']
    """
    if not 2 <= len(scenes) <= 12:
        raise ValueError(f"from 2 to 12 scenes are compared, not {len(scenes)}")
    if any(not isinstance(scene, Scene) for scene in scenes):
        raise TypeError("only scenes are compared")
    if names is not None and len(names) != len(scenes):
        raise ValueError(f"{len(scenes)} scenes have {len(names)} names")
    for scene in scenes:
        scene._moving()
    own = [chr(ord("A") + k) if s._name == "input" else s._name for k, s in enumerate(scenes)]
    asked = ",".join(_listed(find)) if find is not None else None
    native = _native.Comparison([s._native for s in scenes], list(names or own), over, asked)
    return Comparison(native, lang)


def _between(pair: tuple[float, float]) -> str:
    low, high = pair
    return f"{low}..{high}"


def teeth(
    ratio: float | str,
    *,
    distance: float | str | None = None,
    stages: int | None = None,
    within: float | str = 0.01,
    teeth: tuple[int, int] = (17, 120),
    modules: Sequence[float] = (),
    shifts: tuple[float, float] = (-0.5, 1.5),
    helix: tuple[float, float] = (8, 20),
    taper: float = 1.3,
    count: int = 20,
    lang: Literal["en", "zh"] | None = None,
) -> Report:
    """Numbers of teeth for a ratio of at least 1, such as 3.15 or `"63/20"`, the best first.

    With `distance` (mm, or with a unit): all pairs for this centre distance, spur with profile
    shifts or helical; `modules` to try are mm, `shifts` bounds the sum of the profile shifts, `helix`
    the helix angle (degrees). With `stages` (2 to 4): trains of so many stages; `taper` is the ratio
    of a stage over that of the next slower one. `within` is the greatest deviation of the ratio, as
    a part; `teeth` bounds the numbers. The data are SI: m, rad.

    >>> [pair["teeth"] for pair in teeth(3, distance=150, modules=[2.5])["pairs"]]
    [[29, 87], [30, 90]]
    >>> len(teeth(31.5, stages=3)["trains"])
    20
    """
    if (distance is None) == (stages is None):
        raise ValueError("give the distance of a pair, or the stages of a train")
    length: Any = distance if distance is None or isinstance(distance, str) else f"{_words(distance)} mm"
    told = _native.teeth(
        str(ratio), str(within), _between(teeth), length, list(modules), _between(shifts), _between(helix),
        stages, taper, count,
    )  # fmt: skip
    return Report(told, lang)
