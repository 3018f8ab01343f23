"""Types of ROS 1's services, which the master does not know: each server is asked once."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from gazelle.bridge.ros1.graph_state import TypeBook
from gazelle.bridge.ros1.services import probe
from gazelle.bridge.ros1.types import ServiceKind
from gazelle.bridge.ros1.xmlrpc_call import RemoteError
from gazelle.errors import GazelleError

__all__ = ["ServiceTypes"]

_WORKERS = 4
_RETRY_S = 5.0
_CALLER = "/ros1_bridge"

_Key = tuple[str, str]


class ServiceTypes:
    """Finds types in the background."""

    def __init__(
        self,
        ask: Callable[..., Any],
        on_found: Callable[[], None],
        book: TypeBook,
        notice: Callable[[str], None],
    ) -> None:
        """Know nothing yet.

        Args:
            ask: calls the master.
            on_found: called when a type has been found.
            book: looks types up.
            notice: told of services that do not get across.
        """
        self._ask = ask
        self._on_found = on_found
        self._book = book
        self._notice = notice
        self._lock = threading.Lock()
        self._found: dict[_Key, ServiceKind] = {}
        self._asked: dict[_Key, float] = {}
        self._workers = ThreadPoolExecutor(_WORKERS, thread_name_prefix="ros1 probe")

    def of(self, services: Iterable[_Key]) -> dict[str, ServiceKind]:
        """Return the types known of services given as (node, service); ask for the others."""
        wanted = set(services)
        now = time.monotonic()
        with self._lock:
            self._found = {key: kind for key, kind in self._found.items() if key in wanted}
            self._asked = {key: at for key, at in self._asked.items() if key in wanted}
            for key in wanted - set(self._found):
                if now >= self._asked.get(key, 0.0):
                    self._asked[key] = float("inf")
                    self._workers.submit(self._probe, key)
            return {key[1]: kind for key, kind in self._found.items()}

    def close(self) -> None:
        """Ask nobody any more."""
        self._workers.shutdown(wait=False, cancel_futures=True)

    def _probe(self, key: _Key) -> None:
        service = key[1]
        try:
            uri = self._ask("lookupService", _CALLER, service)
            name = probe(uri, service, _CALLER)
        except (OSError, RemoteError):
            # It has gone, or is not there yet.
            with self._lock:
                self._asked[key] = time.monotonic() + _RETRY_S
            return
        except GazelleError as error:
            self._notice(f"service {service} of {key[0]} does not cross the bridge: {error}")
            return
        kind = self._book.service(name, f"service {service} of {key[0]}")
        if kind is not None:
            with self._lock:
                self._found[key] = kind
            self._on_found()
