"""The answers over a whole motion."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from . import _native
from ._errors import Diagnostic, diagnostics

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


class Table(Mapping[str, "NDArray[np.float64]"]):
    """Columns of numbers by name, the swept quantity first.

    Each column is an array of shape (rows,). In SI it is the memory in which it was computed, read
    without a copy, and cannot be written to. A vector has three columns: its parts `v_C.x` and `v_C.y`, and
    its length `v_C`.
    """

    def __init__(self, native: _native.Table, units: str = "si") -> None:
        import numpy as np

        self._native = native
        heads, book = native.heads, native.book
        si = units == "si"
        self.units: dict[str, str] = {
            name: unit if si else book[k][0] for k, (name, unit) in enumerate(heads)
        }
        """The unit of each column; empty for a pure number."""
        self._columns: dict[str, NDArray[np.float64]] = {}
        for (name, _), (_, factor), column in zip(heads, book, native.columns):
            values = np.asarray(column)
            self._columns[name] = values if si or factor == 1 else values * factor

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        try:
            return self._columns[name]
        except KeyError:
            raise KeyError(f"{name!r} is no column; the columns are {', '.join(self._columns)}") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    @property
    def rows(self) -> int:
        """The number of rows. Positions that cannot be assembled have none; `notes` name them."""
        return len(next(iter(self._columns.values()), ()))

    @property
    def title(self) -> dict[str, str]:
        """The title of the scene in both languages."""
        return dict(zip(("en", "zh"), self._native.title))

    @property
    def notes(self) -> list[Diagnostic]:
        """Remarks: missing positions with their reasons, changes of branch."""
        return diagnostics(self._native.notes)

    def vector(self, name: str) -> NDArray[np.float64]:
        """The parts of a vector, a copy of shape (rows, 2): `table.vector("v_C")`."""
        import numpy as np

        return np.column_stack([self[f"{name}.x"], self[f"{name}.y"]])

    def to_pandas(self) -> Any:
        """A `pandas.DataFrame` with these columns; its `attrs["units"]` are the units."""
        import pandas as pd

        frame = pd.DataFrame(self._columns, copy=False)
        frame.attrs.update(title=self.title, units=dict(self.units))
        return frame

    def to_arrow(self) -> Any:
        """A `pyarrow.Table` on the same memory; the metadata of a field has its `unit`."""
        import pyarrow as pa

        arrays = [pa.array(column) for column in self._columns.values()]
        fields = [
            pa.field(name, array.type, metadata={"unit": self.units[name]})
            for name, array in zip(self._columns, arrays)
        ]
        return pa.table(arrays, schema=pa.schema(fields))

    def to_polars(self) -> Any:
        """A `polars.DataFrame` with these columns."""
        import polars as pl

        return pl.DataFrame({name: pl.Series(name, column) for name, column in self._columns.items()})

    def __repr__(self) -> str:
        names = ", ".join(f"{n} [{u}]" if u else n for n, u in self.units.items())
        return f"<hodograph.Table: {self.rows} rows of {names}>"
