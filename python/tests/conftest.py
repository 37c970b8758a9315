"""Shared by the tests: the program with which the package is compared."""

import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def program():
    """Runs the program of the same checkout; returns its standard output."""
    target = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    path = os.environ.get("HODOGRAPH") or target / "debug" / "hodograph"
    assert Path(path).is_file(), f"{path}: build the program first (cargo build), or name it in HODOGRAPH"

    def run(*arguments, text="", code=(0, 4)):
        done = subprocess.run([path, *arguments], input=text.encode(), capture_output=True, check=False)
        assert done.returncode in code, done.stderr.decode()
        return done.stdout

    return run
