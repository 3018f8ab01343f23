"""``Simulation.view()``: the world live in a notebook's cell.

The page is Studio's, from a server of this process on 127.0.0.1; while a cell steps the
simulation, the page shows it. What a browser does not reach (a kernel far away, a notebook that is
saved or exported) stays in the cell: a picture, and a replay of the run once there is one.
"""

from __future__ import annotations

import hashlib
import html
import sys
import threading
import time
from typing import TYPE_CHECKING, Any

from gazelle.errors import GazelleError
from gazelle.notebook.html_parts import figure, picture_tag, png_text
from gazelle.notebook.live_world import LiveWorld
from gazelle.notebook.robots import drawn, posed_world
from gazelle.notebook.scripts import script_tag
from gazelle.rich_display import Bundle

if TYPE_CHECKING:
    from gazelle.simulator import Simulation

__all__ = ["View", "show"]

_STILL_PX = (720, 405)
_STILL_PATIENCE_S = 3.0
_NOBODY_CAME_S = 1.5
_MAX_REPLAY_BYTES = 8_000_000
_REPLAY_HZ = 25.0
_WHERE = "The live page is here while the kernel runs, in a browser on the kernel's machine."


class View:
    """A live view; it ends with `close`, with its simulation and with the process."""

    def __init__(
        self, sim: Simulation, live: LiveWorld, *, height_px: int, origin: str | None
    ) -> None:
        """Use `Simulation.view`."""
        self._sim = sim
        self._live = live
        self._height_px = height_px
        self._frame = live.open_frame(origin)
        self._recorder = _recorder(sim)
        self._still = _still(sim)
        self._begin_s = time.monotonic()
        self._shown_ns = sim.time_ns
        self._handle: Any = None
        self._cell: int | None = None
        self._is_open = True

    def __repr__(self) -> str:
        """Without the address, which lets in whoever reads it."""
        return f"<view of {self._sim.world.name}, {'open' if self._is_open else 'closed'}>"

    @property
    def url(self) -> str:
        """The page's address, for a browser on this machine; whoever has it gets in."""
        return f"http://127.0.0.1:{self._frame.port}{self._frame.path}?panels=notebook"

    @property
    def watchers(self) -> int:
        """How many pages look at the simulation."""
        return self._live.watchers if self._is_open else 0

    def close(self) -> None:
        """End the view; its cell keeps a replay of what it showed. Twice does nothing."""
        if not self._is_open:
            return
        self._is_open = False
        self._live.close_frame(self._frame)
        if self._recorder is not None:
            self._recorder.stop()
        if self._handle is not None:
            self._handle.update(self.ended_bundle(), raw=True)

    def replay(self) -> str:
        """Return the run since the view was opened as one HTML document.

        Raises:
            GazelleError: nothing was recorded.
        """
        from gazelle.studio.replay import render_html

        if self._recorder is None:
            raise GazelleError("nothing of this run was recorded")
        return render_html(self._recorder.recording, title=self._sim.world.name)

    def bundle(self) -> Bundle:
        """Return what the cell holds while the view is open."""
        mark = hashlib.sha256(self._frame.token.encode()).hexdigest()[:12]
        still = picture_tag(self._still, "the simulation") if self._still else ""
        box = f'<div data-gazelle-view="{mark}">{figure(still, _WHERE)}</div>'
        script = script_tag(
            "live_view",
            mark=mark,
            path=self._frame.path,
            port=self._frame.port,
            height=self._height_px,
        )
        return self._with_still(box + script)

    def ended_bundle(self) -> Bundle:
        """Return what the cell keeps: the replay, a picture where that is too large."""
        if self._sim.time_ns != self._shown_ns:
            self._still = _still(self._sim) or self._still
        try:
            document = self.replay()
        except (GazelleError, ValueError):
            document = ""
        if not document or len(document) > _MAX_REPLAY_BYTES:
            still = picture_tag(self._still, "the simulation") if self._still else ""
            return self._with_still(figure(still, f"{self._sim.time_s:.3f} s simulated"))
        # A sandbox without an origin: the replay reaches nothing of the notebook's page.
        return self._with_still(
            f'<iframe sandbox="allow-scripts" title="Gazelle" style="width:100%;'
            f'height:{self._height_px}px;border:0;border-radius:6px" '
            f'srcdoc="{html.escape(document, quote=True)}"></iframe>'
        )

    def after_cell(self, *_result: Any) -> None:
        """Show the run so far where the live page has not been reached."""
        is_new = self._sim.time_ns != self._shown_ns
        waited_s = time.monotonic() - self._begin_s
        if not self._is_open or not is_new or waited_s < _NOBODY_CAME_S:
            return
        if self._handle is not None and not self._live.server.is_reached(self._frame):
            bundle = self.ended_bundle()
            self._shown_ns = self._sim.time_ns
            self._handle.update(bundle, raw=True)

    def _with_still(self, text: str) -> Bundle:
        bundle: Bundle = {"text/html": text, "text/plain": repr(self)}
        return {**bundle, "image/png": png_text(self._still)} if self._still else bundle

    def _ipython_display_(self) -> None:
        """Show it once more; in the cell that made it, it shows already."""
        shell = _shell()
        if shell is not None and shell.execution_count != self._cell:
            self.display(shell)

    def display(self, shell: Any) -> None:
        """Show it in the cell that runs now."""
        from IPython.display import display

        self._cell = shell.execution_count
        bundle = self.bundle() if self._is_open else self.ended_bundle()
        self._handle = display(bundle, raw=True, display_id=True)


def show(
    sim: Simulation,
    live: LiveWorld | None,
    *,
    height_px: int = 480,
    origin: str | None = None,
) -> tuple[View, LiveWorld]:
    """Open a view, and what it needs of the simulation where that is not open yet."""
    if live is None or live.is_closed:
        live = LiveWorld(sim)
    view = View(sim, live, height_px=height_px, origin=origin)
    shell = _shell()
    if shell is not None:
        view.display(shell)
        shell.events.register("post_run_cell", view.after_cell)
    return view, live


def _shell() -> Any:
    """Return IPython's shell where it has a front end that shows more than text."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython is not None else None
    return shell if shell is not None and hasattr(shell, "kernel") else None


def _still(sim: Simulation) -> bytes:
    """Return a picture; empty where the cameras have to be compiled first, which goes on."""
    world, drawings = posed_world(sim), list[bytes]()
    thread = threading.Thread(
        target=lambda: drawings.append(drawn(world, _STILL_PX)), name="gazelle still", daemon=True
    )
    thread.start()
    thread.join(_STILL_PATIENCE_S)
    return drawings[0] if drawings else b""


def _recorder(sim: Simulation) -> Any:
    """Begin to record what moves."""
    from gazelle.recording import record

    return record(sim, rate_hz=_REPLAY_HZ, topics=())
