"""NOTICE names whose code is in what is installed."""

from __future__ import annotations

import json
import re
import tomllib
from pathlib import Path

ROOT = Path(__file__).parents[1]


def test_every_package_in_the_page_is_in_the_notice() -> None:
    lock = json.loads((ROOT / "studio" / "package-lock.json").read_text(encoding="utf-8"))
    shipped = {
        path.removeprefix("node_modules/"): item["license"]
        for path, item in lock["packages"].items()
        if path and not item.get("dev") and not item.get("devOptional")
    }
    text = (ROOT / "NOTICE").read_text(encoding="utf-8")
    assert set(re.findall(r"^  (\S+) +Copyright", text, re.MULTILINE)) == set(shipped)
    assert set(shipped.values()) == {"MIT"}


def test_the_notice_is_in_what_is_installed() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    assert project["project"]["license-files"] == ["LICENSE", "NOTICE"]
    assert "NOTICE" in project["tool"]["hatch"]["build"]["targets"]["sdist"]["include"]
