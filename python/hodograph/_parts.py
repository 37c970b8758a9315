"""Batches as parts in a folder, for many tasks on one or many machines."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from . import _native
from ._batch import _asked
from ._errors import PartsError
from ._problem import Scene, _bar, _words


@dataclass(frozen=True)
class PartsReport:
    """The result of reading all parts of a batch."""

    parts: int
    """The number of parts of the batch."""
    missing: list[int]
    """The numbers of the missing parts."""
    damaged: list[int]
    """The numbers of the parts whose bytes have changed."""
    mechanisms: int
    """The mechanisms of the sound parts."""
    rows: int
    """The rows of the sound parts."""
    positions_without_row: int
    """The positions of the sound parts that cannot be assembled."""
    crc32: int
    """The CRC-32 of all rows of the sound parts, in order."""

    @property
    def complete(self) -> bool:
        """True if no part is missing or damaged."""
        return not (self.missing or self.damaged)


class Parts:
    """A batch as parts in a folder: the files of `hodograph batch --shard`.

    Each part is a table with a fixed range of mechanisms. It appears under its name when it is
    complete; work that ends early is continued by the next call, and the bytes do not depend on who
    computes which part. Any number of processes and machines may compute different parts.

    >>> import tempfile, hodograph as hg
    >>> folder = tempfile.TemporaryDirectory()
    >>> scene = hg.Scene.template("crank-rocker")
    >>> parts = hg.Parts.begin(folder.name, scene, {"l_AB": (80, 120)}, random=100, per_part=25, find="omega_3")
    >>> parts.missing()
    [0, 1, 2, 3]
    >>> parts.compute([0, 2])
    50
    >>> hg.Parts(folder.name).missing()
    [1, 3]
    """

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        """Opens a folder that `begin` or `hodograph batch --shard` has made."""
        self.folder = Path(folder)
        """The folder."""
        if not (self.folder / "batch.json").exists():
            raise FileNotFoundError(f"{self.folder} has no batch.json: Parts.begin makes such a folder")
        self._native = _native.Parts(str(self.folder))

    @classmethod
    def begin(
        cls,
        folder: str | os.PathLike[str],
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
        format: Literal["csv", "npy", "parquet"] = "parquet",
        per_part: int | None = None,
    ) -> Parts:
        """Describes a batch in a folder, which is made if necessary; no part is computed.

        The arguments are those of `hodograph.batch`; `per_part` is the number of mechanisms in a
        part (about a million numbers without it). Raises `ArgumentError` if the folder has another
        batch.
        """
        if per_part is not None and per_part < 1:
            raise ValueError("per_part is a whole number from 1")
        ranges, asked = _asked(scene, vary, steps, find)
        new = cls.__new__(cls)
        new.folder = Path(folder)
        new._native = _native.Parts.begin(
            str(new.folder), scene._native, ranges, random, seed, over,
            _words(start), _words(stop), steps, asked, format, per_part,
        )  # fmt: skip
        return new

    def __len__(self) -> int:
        """The number of parts."""
        return self._native.count

    def missing(self) -> list[int]:
        """The numbers of the parts that do not exist, counted from 0."""
        return self._native.missing()

    def path(self, part: int) -> Path:
        """The file of a part."""
        return Path(self._native.path(part))

    def compute(self, parts: Iterable[int] | None = None, *, progress: bool = False) -> int:
        """Computes the parts with these numbers, or all, that are missing; returns the number of
        their rows."""
        chosen = list(range(len(self)) if parts is None else parts)
        if any(not 0 <= part < len(self) for part in chosen):
            raise IndexError(f"parts are numbered from 0 to {len(self) - 1}")
        with _bar(progress) as tell:
            return self._native.compute(chosen, tell)[1]

    def verify(self, *, remove_damaged: bool = False) -> PartsReport:
        """Reads all parts and compares them with their checksums.

        `remove_damaged` removes damaged parts, so that `compute` makes them again.
        """
        missing, damaged, (mechanisms, rows, gaps), crc = self._native.verify(remove_damaged)
        return PartsReport(len(self), missing, damaged, mechanisms, rows, gaps, crc)

    def compact(self, output: str | os.PathLike[str]) -> Path:
        """Joins all parts into one table, whose name ends like the parts; returns its path.

        Raises `PartsError` if parts are missing.
        """
        at, ending = Path(output), self.path(0).suffix
        if at.suffix.lower() != ending:
            raise ValueError(f"the parts end in {ending}, and so does their table: {at}")
        missing = self.missing()
        if missing:
            raise PartsError(f"{len(missing)} of {len(self)} parts are missing: compute() makes them")
        self._native.compact(str(at.absolute()))
        return at

    def __repr__(self) -> str:
        return f"<hodograph.Parts: {len(self)} parts in {self.folder}>"

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.folder,)


def compute_part(folder: str | os.PathLike[str], part: int) -> int:
    """Computes one part of the batch in a folder, if it is missing; returns the number of its rows.

    It is the task for executors on many processes or machines. The process uses one thread, unless
    `RAYON_NUM_THREADS` says otherwise.
    """
    os.environ.setdefault("RAYON_NUM_THREADS", "1")
    return Parts(folder).compute([part])
