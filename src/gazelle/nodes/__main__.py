"""``python -m gazelle.nodes PKG/TYPE args…``, or ``--host FD`` for light nodes together."""

from __future__ import annotations

import os
import signal
import sys
from pathlib import Path

from gazelle.process_lifetime import (
    StopEvent,
    at_stop_signal,
    collect_garbage_rarely,
    end_at_interrupts,
    end_with,
    end_with_parent,
    want_one_blas_thread,
)
from gazelle.python_warnings import shorten_library_warnings

__all__ = ["main"]

# Less than the five seconds after which ROS 2's launch complains.
_PATIENCE_S = 3.0


def main(argv: list[str]) -> int:
    """Run a node, or a host of nodes, in this process."""
    end_at_interrupts()
    end_with_parent()
    if argv and argv[0] == "--host":
        from gazelle.nodes.host import host

        # Ctrl-C is the launcher's business; it closes our input.
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        return host(int(argv[1]), sys.stdin)
    if not argv:
        print("usage: python -m gazelle.nodes PKG/TYPE [args…]", file=sys.stderr)  # noqa: T201
        return 2
    return _single(argv[0], argv[1:])


def _single(name: str, argv: list[str]) -> int:
    from gazelle.errors import GazelleError, file_refusal_text
    from gazelle.graph import Graph
    from gazelle.graph.log_output import LogFile
    from gazelle.node_specs.registry import node_spec
    from gazelle.nodes.arguments import read_arguments
    from gazelle.nodes.host import run_node

    found = node_spec(*name.split("/", 1)) if "/" in name else None
    is_writer = found is not None and found.writes_at_end
    stop = StopEvent(None if is_writer else _PATIENCE_S)
    at_stop_signal(stop.request)
    namespace = os.environ.get("ROS_NAMESPACE", "/")
    try:
        with Graph.open() as graph:
            if log_file := read_arguments(argv, name).log_file:
                graph.console = LogFile(Path(log_file))
            request = {"node": name, "argv": argv, "namespace": namespace}
            return run_node(request, graph, stop)
    except GazelleError as error:
        print(f"[{name}] {error}", file=sys.stderr)  # noqa: T201
        return 1
    except OSError as error:
        text = file_refusal_text(error)
        if not text:
            raise
        print(f"[{name}] {text}", file=sys.stderr)  # noqa: T201
        return 1


if __name__ == "__main__":
    collect_garbage_rarely()
    want_one_blas_thread()
    shorten_library_warnings()
    end_with(lambda: main(sys.argv[1:]))
