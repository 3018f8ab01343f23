"""Commands that are run for what they print."""

from __future__ import annotations

import sys

import pytest

from gazelle.documents import LimitError
from gazelle.documents.command_output import run_limited

PYTHON = sys.executable


def test_what_a_command_prints_and_its_exit_code_come_back() -> None:
    code = "import sys; print('out'); print('err', file=sys.stderr); sys.exit(3)"
    result = run_limited([PYTHON, "-c", code])
    assert (result.returncode, result.stdout, result.stderr) == (3, "out\n", "err\n")
    joined = run_limited([PYTHON, "-c", code], joined=True)
    assert sorted(joined.stdout.split()) == ["err", "out"]
    assert joined.stderr == ""


@pytest.mark.parametrize("stream", ["stdout", "stderr"])
def test_a_command_without_end_is_ended(stream: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("GAZELLE_LIMITS", "0.015625")
    code = f"import sys\nwhile True: sys.{stream}.write('x' * 10000)"
    with pytest.raises(LimitError, match=r"prints more than 1 MiB and was ended"):
        run_limited([PYTHON, "-c", code])


def test_a_program_that_is_not_there_is_an_error() -> None:
    with pytest.raises(FileNotFoundError):
        run_limited(["/no/such/program"])
