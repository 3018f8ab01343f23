"""Fixtures of the SDF reader's tests: short texts in, models and findings out."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from gazelle.description.model import Model, World
from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader import read_sdf
from gazelle.description.xml import Tag, parse_xml
from gazelle.diagnostics import Diagnostics
from gazelle.workspace import Workspace

LINK = "<link name='base'/>"


@pytest.fixture
def diagnostics() -> Diagnostics:
    return Diagnostics()


@pytest.fixture
def context(diagnostics: Diagnostics, tmp_path: Path) -> ReadContext:
    return ReadContext(None, diagnostics, "test.sdf", tmp_path)


@pytest.fixture
def tag(diagnostics: Diagnostics) -> Callable[[str], Tag]:
    def parse(text: str) -> Tag:
        found = parse_xml(text, "test.sdf", diagnostics)
        assert found is not None
        return found

    return parse


@pytest.fixture
def model(context: ReadContext) -> Callable[..., Model]:
    """Read the model whose content is given."""

    def read(body: str, version: str = "1.9", attributes: str = "") -> Model:
        text = f"<sdf version='{version}'><model name='m' {attributes}>{body}</model></sdf>"
        return read_sdf(text, context=context).models[0]

    return read


@pytest.fixture
def world(context: ReadContext) -> Callable[..., World]:
    """Read the world whose content is given."""

    def read(body: str, version: str = "1.9") -> World:
        text = f"<sdf version='{version}'><world name='w'>{body}</world></sdf>"
        return read_sdf(text, context=context).worlds[0]

    return read


@pytest.fixture
def models_folder(tmp_path: Path) -> Callable[..., Path]:
    """Write a model's folder below a folder named in GAZEBO_MODEL_PATH."""

    def write(name: str, body: str, version: str = "1.9", config: str = "") -> Path:
        folder = tmp_path / "models" / name
        folder.mkdir(parents=True, exist_ok=True)
        text = f"<sdf version='{version}'>{body}</sdf>"
        (folder / "model.sdf").write_text(text, encoding="utf-8")
        usual = f"<model><name>{name}</name><sdf version='{version}'>model.sdf</sdf></model>"
        (folder / "model.config").write_text(config or usual, encoding="utf-8")
        return folder

    return write


@pytest.fixture
def here(diagnostics: Diagnostics, tmp_path: Path) -> ReadContext:
    """A context whose workspace knows the models written by `models_folder`."""
    (tmp_path / "models").mkdir(exist_ok=True)
    environ = {"GAZEBO_MODEL_PATH": str(tmp_path / "models"), "HOME": str(tmp_path)}
    workspace = Workspace.discover(environ=environ, cwd=tmp_path)
    return ReadContext(workspace, diagnostics, "test.world", tmp_path)
