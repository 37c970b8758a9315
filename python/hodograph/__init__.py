"""Planar mechanisms as they are solved at the drawing board.

>>> import hodograph as hg
>>> s = hg.Scene.template("shaper").set(l_O1A="120 mm")
>>> r = s.solve()
>>> r["omega_3"].text
'0.947285 rad/s counter-clockwise'

- `Scene` is a mechanism at an instant, `Task` a design task, `Motion` motions of points without
  a mechanism, `Equation` a vector equation; `read` takes a file of any kind, `template` and `templates` give examples.
- `Scene.solve` returns the `Answers`; `figure`, `worksheet` and `lesson` draw and write.
- `Scene.sweep` returns a `Table` with the answers over a whole motion, in NumPy columns.
- `batch` solves many mechanisms whose parameters vary; `Parts` is a batch in a folder, for many
  processes or machines, and `hodograph.ray` runs it as tasks of Ray.
- `Scene.limits`, `Scene.loops`, `Scene.cycle` and `Scene.cam` report on the whole motion, the analytic
  method, motion cycles and cams; `compare` on several designs, `teeth` on numbers of teeth.
- `variants` and `mark` are for homework; `Scene.export` and `import_linkage` for other programs.
- `Scene.live` and `Scene.widget` show figures that move with the driver.

Numbers are SI (m, m/s, m/s², rad, N, N·m). Bare numbers given to a scene have its own units.
Faults are exceptions (`HodographError`, a `ValueError`) that show the place in the text.
"""

from ._answers import Answer, Answers, Design
from ._batch import batch
from ._designs import compare, teeth
from ._errors import (
    ArgumentError,
    Diagnostic,
    FileError,
    HodographError,
    InternalError,
    PartsError,
    SolveError,
    StoppedError,
    time_limit,
)
from ._figure import Figure, Frame, Lesson, Worksheet
from ._homework import Key, Marks, Variant, Variants, mark, variants
from ._live import Live
from ._parts import Parts, PartsReport, compute_part
from ._problem import (
    Equation,
    Motion,
    Problem,
    Scene,
    Task,
    Template,
    figures,
    import_linkage,
    read,
    schema,
    template,
    templates,
)
from ._report import Cam, Comparison, Cycle, Report
from ._table import Table

__all__ = [
    "Answer",
    "Answers",
    "ArgumentError",
    "Cam",
    "Comparison",
    "Cycle",
    "Design",
    "Diagnostic",
    "Equation",
    "Figure",
    "FileError",
    "Frame",
    "HodographError",
    "InternalError",
    "Key",
    "Lesson",
    "Live",
    "Marks",
    "Motion",
    "Parts",
    "PartsError",
    "PartsReport",
    "Problem",
    "Report",
    "Scene",
    "SolveError",
    "StoppedError",
    "Table",
    "Task",
    "Template",
    "Variant",
    "Variants",
    "Worksheet",
    "batch",
    "compare",
    "compute_part",
    "figures",
    "import_linkage",
    "mark",
    "read",
    "schema",
    "teeth",
    "template",
    "templates",
    "time_limit",
    "variants",
]
