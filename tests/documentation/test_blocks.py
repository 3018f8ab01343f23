"""Every code block says what it is, and is run or says why not."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest
from tests.documentation.blocks import Block, PageError, blocks_of, pages_of

from gazelle.cli.commands import COMMANDS
from gazelle.cli.rqt import VIEW_COMMANDS

ROOT = Path(__file__).parents[2]
PAGES = pages_of(ROOT)
_SYSTEM = (
    "cat cd chmod cp eval export git grep mkdir mv patch pip pytest python python3 rm sed source"
)
_WORDS = {*COMMANDS, *VIEW_COMMANDS, *_SYSTEM.split(), ".", "gazelle", "rosclean", "roscd", "true"}
_PLACEHOLDER = re.compile(r"…|\.\.\.|<\w+>|(?<![\w-])\[[A-Za-z]")


def _name(page: Path) -> str:
    return page.relative_to(ROOT).as_posix()


@pytest.mark.parametrize("page", PAGES, ids=_name)
def test_blocks_of_a_page_can_be_run_or_say_why_not(page: Path) -> None:
    wrong, last = [], None
    for block in blocks_of(page):
        if block.is_output and (last is None or "not run" in last.marks):
            wrong.append(f"{block}: nothing that is run stands before this output")
        if block.is_run:
            wrong += [f"{block}: {text}" for text in _wrong(block)]
        last = last if block.is_output else block
    assert not wrong, "\n".join(wrong)


def _wrong(block: Block) -> list[str]:
    if block.language == "python":
        try:
            compile(block.text, str(block), "exec")
        except SyntaxError as error:
            return [f"no Python: {error}"]
        return []
    return [*_wrong_words(block.text), *_bad_shell(block.text)]


def _wrong_words(text: str) -> list[str]:
    """Return what is no command that a reader could type."""
    joined = re.sub(r"\\\n\s*", " ", text)
    quoted = re.compile(r"'[^']*'|\"[^\"]*\"")
    wrong = []
    for line in joined.splitlines():
        bare = re.sub(r"(^|\s)#.*", "", quoted.sub('""', line))
        if _PLACEHOLDER.search(bare):
            wrong.append(f"'{line}' is no command; write one, or <!-- not run: REASON -->")
        for command in re.split(r"&&|\|\|?|;", bare):
            words = [word for word in command.split() if not re.match(r"\w+=", word)]
            if words and words[0] not in _WORDS:
                wrong.append(f"'{words[0]}' is no command that is known here")
    return wrong


def _bad_shell(text: str) -> list[str]:
    if (bash := shutil.which("bash")) is None:
        return []
    done = subprocess.run([bash, "-n"], input=text, capture_output=True, text=True, check=False)
    return [done.stderr] if done.returncode else []


def _page(folder: Path, text: str) -> Path:
    page = folder / "page.md"
    page.write_text(text, encoding="utf-8")
    return page


def test_marks_belong_to_the_block_that_follows(tmp_path: Path) -> None:
    text = "<!-- before: mkdir a -->\n<!-- runs on: up | - -->\n```bash\ncd a\none\ntwo\n```\n"
    (block,) = blocks_of(_page(tmp_path, text))
    assert block.marks == {"before": "mkdir a", "runs on": "up | -"}
    assert (block.line, block.text, block.is_run) == (3, "cd a\none\ntwo\n", True)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("words\n\n    gazelle doctor\n", "page.md:3: a block is fenced and says its language"),
        ("```\nx\n```\n", "page.md:1: the language '' is none of bash, python, figure,"),
        ("```bash\nx\n", "page.md:1: the block does not end"),
        ("<!-- not run -->\n```bash\n```\n", "page.md:1: the mark 'not run' needs a text"),
        ("<!-- varies: x -->\n", "page.md:1: the mark 'varies' takes no text"),
        ("<!-- not ran: x -->\n", "page.md:1: <!-- not ran: x --> is none of before, continues"),
        ("<!-- varies -->\nwords\n", "page.md:2: no block follows the mark 'varies'"),
    ],
)
def test_what_cannot_be_meant_is_told(tmp_path: Path, text: str, told: str) -> None:
    with pytest.raises(PageError) as caught:
        blocks_of(_page(tmp_path, text))
    assert str(caught.value).startswith(told)


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ("gazelle doctor [TARGET]", "'gazelle doctor [TARGET]' is no command; write one, or"),
        ("gazelle rosrun my_package …", "is no command"),
        ("gazele doctor", "'gazele' is no command that is known here"),
    ],
)
def test_a_line_that_nobody_can_type_is_told(line: str, told: str) -> None:
    assert any(told in text for text in _wrong_words(line))
