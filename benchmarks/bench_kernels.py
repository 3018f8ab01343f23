"""What compiling the kernels costs: seconds of the processor for each, from an empty cache.

    python benchmarks/bench_kernels.py [sensors | mapping | motion | navigation …]

Each area is a process of its own, as it is in a launch. A kernel's seconds are with those of the
kernels that it calls, which are compiled with it.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from importlib import import_module

from gazelle.kernels.kept_code import VARIABLE

_WARM_UPS = {
    "sensors": "gazelle.sensors.kernel_warm_up",
    "mapping": "gazelle.mapping.slam.kernel_warm_up",
    "motion": "gazelle.motion.kernel_warm_up",
    "navigation": "gazelle.navigation.kernel_warm_up",
}
_ONE = "--one"


def main() -> None:
    """Measure the areas that are named, all of them otherwise."""
    if sys.argv[1:2] == [_ONE]:
        _measure(sys.argv[2])
        return
    for area in sys.argv[1:] or _WARM_UPS:
        with tempfile.TemporaryDirectory() as folder:
            environ = {**os.environ, VARIABLE: folder}
            subprocess.run([sys.executable, __file__, _ONE, area], env=environ, check=True)


def _measure(area: str) -> None:
    from gazelle.kernels import KernelSource, compiling

    taken: list[tuple[float, str]] = []

    def note(source: KernelSource, seconds: float) -> None:
        taken.append((seconds, source.name))

    warm_up = import_module(_WARM_UPS[area]).warm_up
    before = time.process_time()
    with compiling(note):
        warm_up()
    whole = time.process_time() - before
    print(f"{area}: {whole:.2f} s, compiling {sum(seconds for seconds, _ in taken):.2f} s")
    for seconds, name in sorted(taken, reverse=True):
        print(f"  {seconds:5.2f} s  {name}")


if __name__ == "__main__":
    main()
