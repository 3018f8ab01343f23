"""Generated pages are what their generators print, every code is provoked, the site is built."""

from __future__ import annotations

import importlib.util
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import yaml
from tests.ci_scripts import ci_script
from tests.patience import stretched

from gazelle.compat.unsupported.docs import unsupported_markdown
from gazelle.cpp.documentation import headers_markdown
from gazelle.diagnostics.catalogue import all_entries
from gazelle.diagnostics.documentation import catalogue_markdown
from gazelle.node_specs.docs import nodes_markdown

ROOT = Path(__file__).parents[1]
_NAMES = ROOT / "tests" / "stable_names.txt"
_SITE = yaml.safe_load((ROOT / "mkdocs.yml").read_text(encoding="utf-8"))
_TEST = re.compile(r"`((?:tests|benchmarks)/[\w/.]+)`")


def test_diagnostics_page_is_generated_from_the_catalogue() -> None:
    page = (ROOT / "docs" / "diagnostics.md").read_text(encoding="utf-8")
    command = "python -m gazelle.diagnostics.documentation > docs/diagnostics.md"
    assert page == catalogue_markdown(), f"run: {command}"


def test_page_of_refused_names_is_generated_from_their_tables() -> None:
    page = (ROOT / "docs" / "python_names.md").read_text(encoding="utf-8")
    command = "python -m gazelle.compat.unsupported.docs > docs/python_names.md"
    assert page == unsupported_markdown(), f"run: {command}"


def test_page_of_cpp_headers_is_generated_from_the_headers() -> None:
    page = (ROOT / "docs" / "cpp_headers.md").read_text(encoding="utf-8")
    command = "python -m gazelle.cpp.documentation > docs/cpp_headers.md"
    assert page == headers_markdown(), f"run: {command}"


def test_page_of_nodes_is_generated_from_their_rows() -> None:
    page = (ROOT / "docs" / "builtin_nodes.md").read_text(encoding="utf-8")
    command = "python -m gazelle.node_specs.docs > docs/builtin_nodes.md"
    assert page == nodes_markdown(), f"run: {command}"


def test_one_command_writes_every_page_that_is_generated() -> None:
    pages = ci_script("pages")
    heads = {path.name: path.read_text(encoding="utf-8")[:600] for path in ROOT.glob("docs/*.md")}
    generated = {name for name, text in heads.items() if re.search("[Gg]enerated", text)}
    assert generated <= set(pages.PAGES)
    for module in pages.PAGES.values():
        assert importlib.util.find_spec(module) is not None


def test_pictures_of_the_architecture_are_those_of_its_table_and_modules() -> None:
    drawn = ci_script("pictures")
    for name, text in drawn.pictures().items():
        path = ROOT / "docs" / "pictures" / name
        assert path.read_text(encoding="utf-8") == text, "run: python .ci/pages.py"
    ways = (drawn.SCAN, drawn.COMMAND, drawn.CPP)
    steps = [step for way in ways for lane in way for step in lane.steps]
    for step in steps:
        assert importlib.util.find_spec(step.module) is not None, step.module


def test_every_page_is_in_the_navigation_once() -> None:
    wanted = {path.relative_to(ROOT / "docs").as_posix() for path in ROOT.glob("docs/**/*.md")}
    found = list(_pages(_SITE["nav"]))
    assert sorted(found) == sorted(wanted), "add it to nav in mkdocs.yml"


def test_every_module_that_is_promised_is_in_the_reference_once() -> None:
    pages = "\n".join(path.read_text(encoding="utf-8") for path in ROOT.glob("docs/api/*.md"))
    promised = re.findall(r"^([\w.]+): ", _NAMES.read_text(encoding="utf-8"), re.MULTILINE)
    assert sorted(re.findall(r"^::: (\S+)$", pages, re.MULTILINE)) == sorted(promised)


@pytest.mark.slow
def test_the_site_is_built_without_a_warning_and_asks_no_server(tmp_path: Path) -> None:
    """Links between pages and to headings lead somewhere, and every name has its docstring."""
    pytest.importorskip("mkdocs")
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--site-dir", str(tmp_path)]
    done = subprocess.run(
        command,
        cwd=ROOT,
        env={**os.environ, "NO_MKDOCS_2_WARNING": "1", "http_proxy": "127.0.0.1:9"},
        capture_output=True,
        text=True,
        check=False,
        timeout=stretched(300),
    )
    assert done.returncode == 0, done.stderr
    loaded = re.compile(r"<(?:script|link|img)[^>]* (?:src|href)=\"?(https?:)?//")
    for page in ("index.html", "howto/studio.html", "api/simulation.html"):
        text = (tmp_path / page).read_text(encoding="utf-8")
        assert not loaded.findall(text)
    reference = (tmp_path / "api" / "simulation.html").read_text(encoding="utf-8")
    assert "gazelle.simulator.Simulation.load" in reference
    assert "data-md-color-scheme=slate" in text.replace('"', "")
    # Search works from file://, too.
    assert (tmp_path / "search" / "search_index.js").is_file()


def test_every_code_is_used_in_the_source_and_named_in_a_test() -> None:
    catalogue = ROOT / "src" / "gazelle" / "diagnostics" / "catalogue"
    source = _text(ROOT / "src", skip=catalogue)
    tests = _text(ROOT / "tests", skip=catalogue)
    unused = [code for code in all_entries() if not _named(code, source)]
    untested = [code for code in all_entries() if not _named(code, tests)]
    assert not unused, f"codes that nothing reports: {unused}"
    assert not untested, f"codes that no test provokes: {untested}"


def test_every_code_reported_has_an_entry() -> None:
    source = _text(ROOT / "src" / "gazelle")
    areas = {code.split(".")[0] for code in all_entries()}
    pattern = re.compile(r'\.report\(\s*"([a-z0-9]+\.[a-z0-9-]+)"')
    named = {code for code in pattern.findall(source) if code.split(".")[0] in areas}
    assert named <= set(all_entries())


def test_tests_that_pages_name_are_there() -> None:
    pages = {path.name: path.read_text(encoding="utf-8") for path in ROOT.glob("docs/**/*.md")}
    named = {(page, name) for page, text in pages.items() for name in _TEST.findall(text)}
    assert len(named) > 40
    assert not [one for one in sorted(named) if not (ROOT / one[1]).exists()]


def test_places_to_add_something_are_there() -> None:
    named = set()
    for page in ("CONTRIBUTING.md", "docs/howto/extending.md"):
        tables = (ROOT / page).read_text(encoding="utf-8").partition("| touch |")[2]
        named |= set(re.findall(r"`([a-z][\w.]*/[\w./]+)`", tables.partition("\n\n")[0]))
    assert len(named) > 25
    roots = (ROOT, ROOT / "src" / "gazelle")
    assert not [one for one in sorted(named) if not any((root / one).exists() for root in roots)]


def _pages(entry: Any) -> Iterator[str]:
    if isinstance(entry, str):
        yield entry
    else:
        for one in entry.values() if isinstance(entry, dict) else entry:
            yield from _pages(one)


def _named(code: str, text: str) -> bool:
    """Return whether a text reports a code, or prints it at the end of a message."""
    return f'"{code}"' in text or f"[{code}]" in text


def _text(folder: Path, skip: Path | None = None) -> str:
    files = [path for path in folder.rglob("*.py") if skip is None or skip not in path.parents]
    return "\n".join(path.read_text(encoding="utf-8") for path in files)
