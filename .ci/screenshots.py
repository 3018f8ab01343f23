#!/usr/bin/env python3
"""Takes the pictures of README and docs from the real program, in a Chromium and a terminal.

    python .ci/screenshots.py [NAME ...] [--into FOLDER]

What is pictured is a row of ``STAGES`` in ``picture_stages.py``: commands as a person types them,
in a folder of their own, then the page they open or the text they print. Each is taken twice, for
light and for dark pages. Only the named ones are taken where names are given.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from PIL import Image, ImageOps
from rich.console import Console
from rich.terminal_theme import DEFAULT_TERMINAL_THEME, MONOKAI, TerminalTheme
from rich.text import Text

sys.path.insert(0, str(Path(__file__).parent))
from picture_stages import STAGES, Film, Row, Shot, Stage, Typed

__all__ = ["main"]

_ROOT = Path(__file__).resolve().parents[1]
_PICTURES = _ROOT / "docs" / "pictures"
_CARDS = _ROOT / "src" / "gazelle" / "demo" / "pictures"
_CARD_SIZE = (480, 270)
_THEMES = ("light", "dark")
_WAIT_S = 120.0
_CHROMIUM = ("chromium", "chromium-browser", "google-chrome")
_FLAGS = (
    "--no-sandbox",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
)
_QUALITY = 72
_TERMINAL_STYLE = (
    "body{margin:0} pre{display:inline-block;margin:0;padding:14px 18px;"
    "font:13px/1.45 'DejaVu Sans Mono',monospace !important}"
)
_TERMINAL_THEMES = {
    "light": DEFAULT_TERMINAL_THEME,
    "dark": TerminalTheme(
        (27, 31, 38),
        (220, 223, 228),
        list(MONOKAI.ansi_colors)[:8],
        list(MONOKAI.ansi_colors)[8:],
    ),
}


class _Terminals:
    """Terminals in one folder on one graph; the commands in them end with the stage."""

    def __init__(self, folder: Path, home: Path, port: int) -> None:
        own = {
            "GAZELLE_PORT": str(port),
            "GAZELLE_STUDIO": "1",
            "HOME": str(home),
            "XDG_CONFIG_HOME": str(home / "config"),
            "XDG_CACHE_HOME": os.environ.get("XDG_CACHE_HOME", str(Path.home() / ".cache")),
            "PYTHONPATH": str(_ROOT / "src"),
            "PYTHONUNBUFFERED": "1",
            "BROWSER": "true",
        }
        clean = {k: v for k, v in os.environ.items() if not k.startswith(("ROS_", "GAZELLE_"))}
        self._environ = {**clean, **own}
        self._folder = folder
        self._logs = home
        self._running: list[tuple[subprocess.Popen[bytes], Path]] = []

    def begin(self, line: str, sign: str) -> str:
        """Type a command; with a `sign` wait until that is printed, and return all that is."""
        log = self._logs / f"{len(self._running)}.txt"
        with log.open("wb") as out:
            command = [sys.executable, "-m", "gazelle.cli", *shlex.split(line)]
            process = subprocess.Popen(
                command,
                cwd=self._folder,
                env=self._environ,
                stdin=subprocess.PIPE,
                stdout=out,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )
        self._running.append((process, log))
        if not sign:
            return ""
        until = time.monotonic() + _WAIT_S
        while True:
            text = log.read_text(errors="replace")
            if re.search(sign, text):
                return text
            if process.poll() is not None or time.monotonic() > until:
                raise SystemExit(f"'gazelle {line}' never printed {sign!r}:\n{text}")
            time.sleep(0.05)

    def output(self, line: str, **environ: str) -> str:
        """Return what a command prints, with its colours."""
        ran = subprocess.run(
            [sys.executable, "-m", "gazelle.cli", *shlex.split(line)],
            cwd=self._folder,
            env={**self._environ, **environ},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            timeout=_WAIT_S,
            check=False,
        )
        return ran.stdout.decode()

    def close(self) -> None:
        """End them, the last one first."""
        for process, _ in reversed(self._running):
            process.send_signal(signal.SIGINT)
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(20)
                continue
            process.kill()
            process.wait()


def main(argv: Sequence[str]) -> int:
    """Take all pictures, or those that are named."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("names", nargs="*")
    parser.add_argument("--into", type=Path, default=_PICTURES)
    options = parser.parse_args(argv)
    known = {row.name for stage in STAGES for row in stage.rows}
    if unknown := set(options.names) - known:
        parser.error(f"no picture is called {', '.join(unknown)}; there are {sorted(known)}")
    options.into.mkdir(parents=True, exist_ok=True)
    with _browser() as browser:
        for number, stage in enumerate(STAGES):
            rows = [row for row in stage.rows if not options.names or row.name in options.names]
            if rows:
                _play(stage, rows, browser, options.into, 17_600 + number)
    return 0


@contextlib.contextmanager
def _browser() -> Iterator[Any]:
    from playwright.sync_api import sync_playwright

    program = next(filter(None, map(shutil.which, _CHROMIUM)))
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=program, args=list(_FLAGS))
        yield browser
        browser.close()


def _play(stage: Stage, rows: Sequence[Row], browser: Any, into: Path, port: int) -> None:
    with tempfile.TemporaryDirectory() as made, contextlib.ExitStack() as stack:
        home = Path(made) / "home"
        home.mkdir()
        # Findings show it, so it has a name as people's folders have.
        folder = Path(tempfile.gettempdir()) / "my_ws"
        folder.mkdir()
        stack.callback(shutil.rmtree, folder)
        if stage.workspace:
            shutil.copytree(_ROOT / "examples" / stage.workspace, folder, dirs_exist_ok=True)
        stage.prepare(folder)
        terminals = _Terminals(folder, home, port)
        stack.callback(terminals.close)
        url = ""
        for line, sign in stage.commands:
            if found := re.search(r"http://127\S+", terminals.begin(line, sign)):
                url = found.group()
        for row in rows:
            print(row.name, flush=True)
            if isinstance(row, Typed):
                text = terminals.output(row.line, FORCE_COLOR="1", COLUMNS=str(row.columns))
                _picture_text(row, text, browser, into)
            elif isinstance(row, Film):
                for line, sign in row.typed:
                    terminals.begin(line, sign)
                print(terminals.output(f"record -o {(into / row.name).resolve()}.webp {row.line}"))
            else:
                _picture_page(row, url, terminals, browser, into)
                if row.card:
                    _card(row, url, browser, into)


def _picture_page(row: Shot, url: str, terminals: _Terminals, browser: Any, into: Path) -> None:
    for line, sign in row.typed:
        terminals.begin(line, sign)
    context = browser.new_context(viewport={"width": row.size[0], "height": row.size[1]})
    page = context.new_page()
    page.set_default_timeout(_WAIT_S * 1000)
    if row.recorded:
        file = into / f"{row.name}.html"
        terminals.output(f"record -o {file.resolve()} {row.recorded}")
        page.goto(file.resolve().as_uri())
        file.unlink()
    else:
        asked = f"&panels={','.join(row.panels)}" if row.panels else ""
        page.goto(f"{url}{asked}&quality=high")
        page.locator(".light[data-state=open]").wait_for()
    row.act(page)
    _settle(page, row.wait_s)
    for theme in _THEMES:
        _show_theme(page, theme)
        _save(_still(page, row.of), into / f"{row.name}-{theme}.webp")
    context.close()


def _card(row: Shot, url: str, browser: Any, into: Path) -> None:
    """The panel alone, in light or dark whatever the gallery has: its view has one look."""
    page = browser.new_page(viewport={"width": 1280, "height": 800})
    page.goto(f"{url}&panels={row.card}&quality=high")
    page.locator("[data-panel] canvas").first.wait_for()
    _settle(page, 3.0)
    page.locator("[data-panel] canvas").first.hover()
    for _ in range(row.card_zoom):
        page.mouse.wheel(0, 120)
        _settle(page, 0.1)
    _settle(page, 1.0)
    drawn = _still(page, "", "[data-panel] canvas").convert("RGB")
    folder = _CARDS if into == _PICTURES else into
    folder.mkdir(exist_ok=True)
    _save(ImageOps.fit(drawn, _CARD_SIZE), folder / f"{row.name}.webp")
    page.close()


def _settle(page: Any, seconds: float) -> None:
    page.wait_for_timeout(seconds * 1000)


def _show_theme(page: Any, theme: str) -> None:
    if page.evaluate("document.documentElement.dataset.theme") != theme:
        switch = re.compile("(light|dark|theme)", re.IGNORECASE)
        page.get_by_role("button", name=switch).first.click()
        page.mouse.move(2, 2)
        _settle(page, 1.5)


def _still(page: Any, panel: str, part: str = "") -> Image.Image:
    chosen = f"[data-panel='{panel}']{part}" if panel else part
    where = page.locator(chosen).first if chosen else page
    return Image.open(io.BytesIO(where.screenshot()))


def _picture_text(row: Typed, text: str, browser: Any, into: Path) -> None:
    """What a terminal shows, as a picture: prompt, command and what it printed."""
    for theme in _THEMES:
        console = Console(
            record=True, width=row.columns, file=io.StringIO(), color_system="truecolor"
        )
        console.print(Text.assemble(("$ ", "bold green"), (f"gazelle {row.line}", "bold")))
        console.print(Text.from_ansi("\n".join(text.rstrip().splitlines()[: row.lines])))
        html = console.export_html(theme=_TERMINAL_THEMES[theme], inline_styles=True)
        page = browser.new_page(viewport={"width": 1100, "height": 400})
        page.set_content(html.replace("<head>", f"<head><style>{_TERMINAL_STYLE}</style>"))
        _save(_still(page, "", "pre"), into / f"{row.name}-{theme}.webp")
        page.close()


def _save(picture: Image.Image, path: Path) -> None:
    picture.convert("RGB").save(path, quality=_QUALITY, method=6)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
