"""What compiling the kernels costs: seconds of the processor for each, from an empty cache.

    python benchmarks/bench_kernels.py [sensors | mapping | motion | navigation …]

Each area is a process of its own, as it is in a launch. A kernel's own seconds are without those of
the kernels and NumPy functions that it calls; what numba compiles of NumPy is summed up in one row.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from collections import defaultdict
from importlib import import_module
from typing import Any

_WARM_UPS = {
    "sensors": "gazelle.sensors.kernel_warm_up",
    "mapping": "gazelle.mapping.slam.kernel_warm_up",
    "motion": "gazelle.motion.kernel_warm_up",
    "navigation": "gazelle.navigation.kernel_warm_up",
}
_ONE = "--one"
_NUMPY = "(of numba, for NumPy and builtins)"


def main() -> None:
    """Measure the areas that are named, all of them otherwise."""
    if sys.argv[1:2] == [_ONE]:
        _measure(sys.argv[2])
        return
    for area in sys.argv[1:] or _WARM_UPS:
        with tempfile.TemporaryDirectory() as folder:
            environ = {**os.environ, "NUMBA_CACHE_DIR": folder}
            subprocess.run([sys.executable, __file__, _ONE, area], env=environ, check=True)


def _measure(area: str) -> None:
    from numba.core import event

    begun: list[list[float]] = []
    own: defaultdict[str, float] = defaultdict(float)
    count: defaultdict[str, int] = defaultdict(int)

    class Clock(event.Listener):  # type: ignore[misc]
        """Adds up what each kernel takes without what it calls."""

        def on_start(self, event: Any) -> None:
            """Begin."""
            begun.append([time.process_time(), 0.0])

        def on_end(self, event: Any) -> None:
            """Count it for the kernel, and off the one that called for it."""
            start, inner = begun.pop()
            whole = time.process_time() - start
            if begun:
                begun[-1][1] += whole
            function = event.data["dispatcher"].py_func
            is_ours = function.__module__.startswith("gazelle.")
            name = f"{function.__module__}.{function.__qualname__}" if is_ours else _NUMPY
            own[name] += whole - inner
            count[name] += 1

    warm_up = import_module(_WARM_UPS[area]).warm_up
    before = time.process_time()
    with event.install_listener("numba:compile", Clock()):
        warm_up()
    print(f"{area}: {time.process_time() - before:.1f} s, compiling {sum(own.values()):.1f} s")
    for name, seconds in sorted(own.items(), key=lambda row: -row[1]):
        print(f"  {seconds:5.2f} s  {count[name]:2}  {name}")


if __name__ == "__main__":
    main()
