"""Long work leaves the interpreter to others, is interrupted, and tells its progress."""

import os
import signal
import threading
import time

import pytest

import hodograph as hg

SCENE = hg.Scene.template("shaper")
LONG = 10_000_000


def long_work(**options):
    return SCENE.sweep(steps=LONG, **options)


def test_another_thread_runs_while_rust_works():
    count, done, thrown = 0, threading.Event(), []

    def stopped():
        try:
            with hg.time_limit(1.0):
                long_work()
        except Exception as e:
            thrown.append(e)
        finally:
            done.set()

    worker = threading.Thread(target=stopped)
    worker.start()
    begin = time.perf_counter()
    while not done.is_set():
        count += 1
    took = time.perf_counter() - begin
    worker.join()
    assert [type(e) for e in thrown] == [hg.StoppedError]
    # A thread that held the lock would let this one count a few times only.
    assert count > 20_000, (count, took)


def test_ctrl_c_interrupts():
    timer = threading.Timer(0.4, os.kill, (os.getpid(), signal.SIGINT))
    begin = time.perf_counter()
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        long_work()
    assert time.perf_counter() - begin < 5
    # The library works on.
    assert hg.Scene.template("shaper").solve()["omega_3"].value


def test_a_limit_of_time_stops_all_work():
    begin = time.perf_counter()
    with pytest.raises(TimeoutError) as caught, hg.time_limit(0.2):
        long_work()
    assert caught.value.code == "stopped" and time.perf_counter() - begin < 5
    with hg.time_limit(0.0), pytest.raises(hg.StoppedError):
        hg.Scene.template("shaper").figure()
    # Limits end with their blocks, also nested ones.
    with hg.time_limit(60), hg.time_limit(None):
        hg.Scene.template("shaper").solve()
    hg.Scene.template("shaper").solve()


def test_progress_is_told(monkeypatch):
    from hodograph import _problem

    told = []

    class Bar(_problem._bar):
        def __init__(self, shown):
            assert shown
            self._bar = self

        def __enter__(self):
            return lambda done, total: told.append((done, total))

        def close(self):
            told.append("closed")

    monkeypatch.setattr(_problem, "_bar", Bar)
    table = hg.Scene.template("shaper").sweep(steps=300_000, find="v_C", progress=True)
    assert told[-2:] == [(table.rows, table.rows), "closed"]
    assert all(a[0] <= b[0] for a, b in zip(told[:-1], told[1:-1]))


def test_a_failing_observer_stops_the_work():
    def fail(done, total):
        raise RuntimeError("no more")

    with pytest.raises(RuntimeError, match="no more"):
        SCENE._native.sweep(None, None, None, LONG, None, fail)


def test_many_threads_solve_at_once():
    from concurrent.futures import ThreadPoolExecutor

    def solved(k):
        return float(hg.Scene.template("crank-rocker").set(phi_1=f"{k} deg").solve()["omega_3"])

    angles = range(10, 90, 2)
    with ThreadPoolExecutor(8) as pool:
        assert list(pool.map(solved, angles)) == [solved(k) for k in angles]
