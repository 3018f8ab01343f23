"""Pages that take little are run as printed; ``benchmarks/soak/printed_blocks.py`` runs all."""

from __future__ import annotations

import os
import shutil
import sys
from pathlib import Path

import pytest
from tests.documentation.blocks import blocks_of
from tests.documentation.page_runner import BlockFailure, run_page
from tests.patience import stretched

ROOT = Path(__file__).parents[2]
# Together some fifteen seconds of one processor; none starts a simulator.
_PAGES = ("install", "howto/convert", "howto/inertia", "howto/python", "howto/workspaces")
pytestmark = pytest.mark.skipif(
    sys.platform == "win32" or shutil.which("bash") is None, reason="the pages are typed in bash"
)


@pytest.mark.slow(15)
@pytest.mark.parametrize("name", _PAGES)
def test_a_page_does_as_it_says(name: str, tmp_path: Path, free_port: int) -> None:
    if name == "howto/inertia" and shutil.which("patch") is None:
        pytest.skip("the page uses the program patch")
    page = ROOT / "docs" / f"{name}.md"
    took = run_page(page, tmp_path, port=free_port, patience_s=stretched(60))
    assert [one.block.line for one in took] == [one.line for one in blocks_of(page) if one.is_run]


def _run(tmp_path: Path, port: int, text: str) -> None:
    page = tmp_path / "page.md"
    page.write_text(text, encoding="utf-8")
    home = tmp_path / "home"
    home.mkdir()
    run_page(page, home, port=port, patience_s=stretched(20))


def test_terminals_keep_their_folder_and_their_variables(tmp_path: Path, free_port: int) -> None:
    text = "```bash\nmkdir a && cd a\nexport WORD=x\n```\n```bash\npwd; echo $WORD\n```\n"
    text += "```text\n…/home/a\nx\n```\n```python\nimport os\n\nprint(os.environ['WORD'])\n```\n"
    _run(tmp_path, free_port, text + "```text\nx\n```\n")


def test_what_runs_on_is_waited_for_and_ends_by_ctrl_c(tmp_path: Path, free_port: int) -> None:
    loop = "trap 'touch ended; exit 0' INT\necho up 3\nwhile true; do sleep 0.1; done\n"
    text = f"<!-- file: loop -->\n```bash\n{loop}```\n<!-- runs on: up … -->\n"
    _run(tmp_path, free_port, text + "```bash\nbash loop\n```\n")
    assert (tmp_path / "home" / "ended").exists()


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("```bash\nfalse\ntrue\n```\n", "page.md:1: exit code 1: false"),
        ("<!-- exit: 1 -->\n```bash\ntrue\n```\n", "page.md:2: exit code 0"),
        ("```bash\necho 2\n```\n```text\n3\n```\n", "page.md:4: this is not what is printed:\n2\n"),
        (
            "<!-- runs on: x -->\n```bash\necho y\n```\n",
            "page.md:2: 'echo y' ended (0) and has not",
        ),
        ("```python\nraise SystemExit(3)\n```\n", "page.md:1: exit code 3"),
    ],
)
def test_what_a_page_says_and_is_not_so_is_told(
    tmp_path: Path, free_port: int, text: str, told: str
) -> None:
    with pytest.raises(BlockFailure) as caught:
        _run(tmp_path, free_port, text)
    assert str(caught.value).startswith(told)


def test_numbers_that_are_said_to_vary_may(tmp_path: Path, free_port: int) -> None:
    text = "```bash\necho x 2.5 m\n```\n<!-- varies -->\n```text\nx 1.0 m\n```\n"
    _run(tmp_path, free_port, text)


def test_nothing_is_left_of_a_run(tmp_path: Path, free_port: int) -> None:
    variables = dict(os.environ)
    _run(tmp_path, free_port, "```bash\nexport LEFT=1\n```\n")
    assert dict(os.environ) == variables
