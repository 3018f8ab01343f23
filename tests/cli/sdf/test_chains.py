"""Models whose links hang on each other in a very long chain."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from gazelle.cli.gz.command import main

_PART = """<link name="b{1}"><pose relative_to="b{0}">0 0 1 0 0 0</pose></link>
<joint name="j{1}" type="fixed"><parent>b{0}</parent><child>b{1}</child></joint>"""


def test_chain_of_twenty_thousand_links_is_soon_checked(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    parts = "\n".join(_PART.format(number, number + 1) for number in range(20_000))
    file = tmp_path / "chain.sdf"
    file.write_text(
        f'<sdf version="1.8"><model name="a"><link name="b0"/>{parts}</model></sdf>',
        encoding="utf-8",
    )
    start = time.thread_time()
    assert main(["sdf", "--check", str(file)]) == 0
    assert time.thread_time() - start < 30.0
    assert "Valid." in capsys.readouterr().out
