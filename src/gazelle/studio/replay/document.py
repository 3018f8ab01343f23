"""The HTML file: the viewer's program and the recording, both as base64, in one text."""

from __future__ import annotations

import html
import os
from functools import lru_cache
from importlib import resources
from pathlib import Path

from gazelle._version import __version__
from gazelle.recording import Recording
from gazelle.recording.recording import robot_names
from gazelle.studio.replay.drawings import drawings_head
from gazelle.studio.replay.motion import motion_head
from gazelle.studio.replay.packing import Pack, deflated_text
from gazelle.studio.replay.values import topic_tables

__all__ = ["render_html", "write_html"]

# Nothing may be asked for: what the page has is in it.
_POLICY = (
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
    "img-src data: blob:; base-uri 'none'; form-action 'none'"
)
_MOST_NAMES = 3
_BOOT = """
(async () => {
  const place = document.getElementById('replay');
  const read = async (id) => {
    const text = atob(document.getElementById(id).textContent);
    const bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
    return new Response(stream).arrayBuffer();
  };
  try {
    const script = document.createElement('script');
    script.textContent = new TextDecoder().decode(await read('viewer'));
    document.head.append(script);
    await globalThis.gazelleReplay(place, await read('recording'));
  } catch (error) {
    place.textContent = `This recording cannot be shown: ${error}. A browser from 2023 or later ` +
      'with WebGL 2 is needed.';
    throw error;
  }
})();
"""
_PAGE = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<meta name="generator" content="Gazelle {version}">
<title>{title}</title>
</head>
<body>
<main id="replay"><p>Loading the recording …</p></main>
<noscript><p>This page replays a recording by JavaScript, which is switched off.</p></noscript>
<script type="text/plain" id="viewer">{viewer}</script>
<script type="text/plain" id="recording">{recording}</script>
<script>{boot}</script>
</body>
</html>
"""


def render_html(recording: Recording, *, title: str | None = None) -> str:
    """Return a whole document that replays a recording in three dimensions.

    It works from a file, in a frame and in a notebook, and asks nobody for anything.

    Args:
        recording: what happened.
        title: of the page; the robots' names when None.
    """
    shown = title or _usual_title(recording)
    pack = Pack()
    head = {
        "title": shown,
        **motion_head(recording, pack),
        "topics": topic_tables(recording.topics, recording.start_ns, pack),
        "drawings": drawings_head(recording, pack),
    }
    return _PAGE.format(
        policy=html.escape(_POLICY),
        version=__version__,
        title=html.escape(shown),
        viewer=_viewer(),
        recording=deflated_text(pack.bytes(head)),
        boot=_BOOT,
    )


def write_html(
    recording: Recording, path: str | os.PathLike[str], *, title: str | None = None
) -> Path:
    """Write that document; what had the name before is replaced in one go.

    Args:
        recording: what happened.
        path: where to.
        title: of the page; the robots' names when None.
    """
    target = Path(path)
    text = render_html(recording, title=title)
    draft = target.with_name(f".{target.name}.{os.getpid()}")
    try:
        draft.write_text(text, encoding="utf-8")
        draft.replace(target)
    finally:
        draft.unlink(missing_ok=True)
    return target


def _usual_title(recording: Recording) -> str:
    """Return the robots' names, the world's where there are none or many."""
    world = recording.stretches[-1].world
    robots = robot_names(world)
    return ", ".join(robots) if 0 < len(robots) <= _MOST_NAMES else world.name


@lru_cache(maxsize=1)
def _viewer() -> str:
    file = resources.files(__package__) / "viewer" / "replay.js"
    return deflated_text(file.read_bytes())
