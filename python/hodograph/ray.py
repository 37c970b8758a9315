"""Batches as tasks of Ray: `import hodograph.ray`, after `pip install ray`.

>>> import hodograph as hg, hodograph.ray                                   # doctest: +SKIP
>>> scene = hg.Scene.template("crank-rocker")                               # doctest: +SKIP
>>> hg.ray.batch("parts", scene, {"l_AB": (60, 120)}, random=10**6, seed=7, output="linkages.parquet")  # doctest: +SKIP

Each task computes one part of the batch (`hodograph.Parts`). A task whose worker dies runs again and
continues the part; the bytes are those of a run without Ray. In a process that is connected to a
cluster of Ray (`ray.init`), the tasks run there, and all machines need the folder under one path;
without one, `batch` starts workers on this machine, which listen on 127.0.0.1 only.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import partial
from typing import Any, TypeVar

from ._errors import PartsError
from ._parts import Parts, PartsReport, compute_part
from ._problem import Scene

T = TypeVar("T")
Item = TypeVar("Item")

_STORE = 100 << 20
"""Memory for objects that tasks exchange (bytes): numbers and names only."""


def _ray() -> Any:
    try:
        import ray
    except ImportError as absent:
        raise ImportError("hodograph.ray needs Ray: pip install ray") from absent
    return ray


@contextmanager
def local(workers: int | None = None) -> Iterator[None]:
    """Starts Ray on this machine for a block, with as many workers as processors or as given.

    All its processes listen on 127.0.0.1 only. Within a connection to Ray nothing is started, and
    if `RAY_ADDRESS` names a cluster, the block is connected to it.
    """
    cluster = os.environ.get("RAY_ADDRESS")
    if cluster:
        with _connected(address=cluster):
            yield
        return
    # Ray reads it when it is imported: by it, a node has the address 127.0.0.1, otherwise that of
    # the network, whatever `ray.init` says.
    with _environment(RAY_ENABLE_WINDOWS_OR_OSX_CLUSTER="0", RAY_USAGE_STATS_ENABLED="0"):
        ray = _ray()
        constants = sys.modules["ray._private.ray_constants"]
        before, constants.ENABLE_RAY_CLUSTER = constants.ENABLE_RAY_CLUSTER, False  # type: ignore[attr-defined]
        try:
            with _connected(
                address="local",
                num_cpus=workers or os.cpu_count(),
                include_dashboard=False,
                _node_ip_address="127.0.0.1",
                object_store_memory=_STORE,
            ) as started:
                if started and ray.util.get_node_ip_address() != "127.0.0.1":
                    raise RuntimeError("this version of Ray listens on other addresses than 127.0.0.1")
                yield
        finally:
            constants.ENABLE_RAY_CLUSTER = before  # type: ignore[attr-defined]


@contextmanager
def _connected(**options: Any) -> Iterator[bool]:
    """Connects to Ray for a block; false within another connection."""
    ray = _ray()
    if ray.is_initialized():
        yield False
        return
    ray.init(log_to_driver=False, logging_level="ERROR", **options)
    try:
        yield True
    finally:
        ray.shutdown()


@contextmanager
def _environment(**values: str) -> Iterator[None]:
    """Sets variables of the environment for a block."""
    before = {name: os.environ.get(name) for name in values}
    os.environ.update(values)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


def run(
    function: Callable[[Item], T], items: Iterable[Item], *, workers: int | None = None, retries: int = 10
) -> Iterator[T]:
    """Calls a function for each item as a task of Ray; yields the results as they come.

    A task whose worker dies runs again, `retries` times at most; an exception of the function is
    raised here, and the other tasks are cancelled.
    """
    with local(workers):
        ray = _ray()
        task = ray.remote(num_cpus=1, max_retries=retries)(_called)
        waiting = [task.remote(function, item) for item in items]
        try:
            while waiting:
                done, waiting = ray.wait(waiting, num_returns=1)
                yield from ray.get(done)
        finally:
            for one in waiting:
                ray.cancel(one, force=True)


def _called(function: Callable[[Item], T], item: Item) -> T:
    """The task: Ray takes plain functions only."""
    return function(item)


def batch(
    folder: str | os.PathLike[str],
    scene: Scene,
    vary: Mapping[str, Sequence[Any]],
    *,
    output: str | os.PathLike[str] | None = None,
    workers: int | None = None,
    retries: int = 10,
    **options: Any,
) -> PartsReport:
    """Computes the missing parts of a batch as tasks of Ray, and reads all parts; returns the report.

    The other arguments are those of `hodograph.Parts.begin`. With `output`, the parts are joined
    into this table. Tasks whose worker dies run again, `retries` times at most. The call can be
    repeated: finished parts are kept, damaged ones are computed again.

    Raises `ImportError` without Ray, `PartsError` if parts stay missing or damaged, and the
    exceptions of the tasks.
    """
    _ray()
    parts = Parts.begin(folder, scene, vary, **options)
    at = os.path.abspath(parts.folder)
    report = parts.verify(remove_damaged=True)
    again = sorted([*report.missing, *report.damaged])
    if again:
        for _ in run(partial(compute_part, at), again, workers=workers, retries=retries):
            pass
        report = parts.verify()
    if not report.complete:
        raise PartsError(f"{len(report.missing)} parts are missing, {len(report.damaged)} damaged: {at}")
    if output is not None:
        parts.compact(output)
    return report
