#!/usr/bin/env bash
# Compares this program with pylinkage (numba) and mechanism on one four-bar sweep: numbers and times. Installs both from PyPI into an
# environment of their own beside this file; needs Python 3.10 or newer.
set -euo pipefail
cd "$(dirname "$0")"
root=$(cd ../.. && pwd)
[ -x venv/bin/python ] || python3 -m venv venv
venv/bin/pip install --quiet --requirement requirements.txt
(cd "$root" && cargo build --release --quiet --bin hodograph)
# The benchmark's own binary times the library on one core.
library=$( (cd "$root" && cargo bench --bench tables --no-run --quiet --message-format=json) |
  venv/bin/python -c 'import json, sys
made = [m for m in map(json.loads, sys.stdin) if m.get("executable") and m["target"]["name"] == "tables"]
print(made[-1]["executable"])')
grep -m 1 "model name" /proc/cpuinfo 2>/dev/null || true
venv/bin/python compare.py "${CARGO_TARGET_DIR:-$root/target}/release/hodograph" "$root/templates/crank-rocker.json" "$library"
