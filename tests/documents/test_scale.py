from __future__ import annotations

import pytest

from gazelle.documents import scaled
from gazelle.errors import GazelleError


def test_limits_are_as_they_are_without_the_variable(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("GAZELLE_LIMITS", raising=False)
    assert scaled(7) == 7


def test_the_variable_is_a_factor(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("GAZELLE_LIMITS", "2.5")
    assert scaled(10) == 25


@pytest.mark.parametrize("text", ["0", "-1", "many", "nan", "inf"])
def test_other_values_are_told(monkeypatch: pytest.MonkeyPatch, text: str) -> None:
    monkeypatch.setenv("GAZELLE_LIMITS", text)
    with pytest.raises(GazelleError, match=f"GAZELLE_LIMITS='{text}' is not a number above 0"):
        scaled(1)
