"""A recording as one HTML file that replays it: no server, no network, no other file."""

from __future__ import annotations

from gazelle.studio.replay.document import render_html, write_html

__all__ = ["render_html", "write_html"]
