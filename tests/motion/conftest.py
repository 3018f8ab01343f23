"""Arms for motion: two of our own, and LUCK where the sample workspaces are."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from gazelle.description.loader import load_models
from gazelle.description.moveit import read_moveit_config
from gazelle.description.srdf import load_srdf
from gazelle.diagnostics import Diagnostics
from gazelle.motion.model import RobotModel

_ARMS = Path(__file__).parent / "arms"


def _arm(name: str) -> RobotModel:
    diagnostics = Diagnostics()
    file = _ARMS / f"{name}.urdf"
    (model,) = load_models(file, workspace=None, diagnostics=diagnostics)
    srdf = load_srdf(
        file.with_suffix(".srdf"), robot=model, workspace=None, diagnostics=diagnostics
    )
    assert not list(diagnostics), [str(item) for item in diagnostics]
    return RobotModel.build(model, srdf, diagnostics=diagnostics)


@pytest.fixture(scope="session")
def ur_like() -> RobotModel:
    """Six turning joints, most of them twice around."""
    return _arm("ur_like")


@pytest.fixture(scope="session")
def seven() -> RobotModel:
    """Seven turning joints, a hand with a mimicking finger."""
    return _arm("seven")


@pytest.fixture(scope="session")
def luck(workspaces_dir: Path) -> RobotModel:
    """The arm of document LUCK."""
    diagnostics = Diagnostics()
    folder = workspaces_dir / "ros2_ws" / "src" / "luck_robot"
    config = read_moveit_config(folder, diagnostics=diagnostics)
    assert config is not None, [str(item) for item in diagnostics]
    return RobotModel.from_config(config, diagnostics=diagnostics)


@pytest.fixture
def robot() -> Callable[..., RobotModel]:
    """Makes a robot of the insides of a URDF and an SRDF."""

    def make(
        urdf: str, srdf: str = "", diagnostics: Diagnostics | None = None, **limits: object
    ) -> RobotModel:
        told = Diagnostics() if diagnostics is None else diagnostics
        text = f'<robot name="r">{urdf}</robot>'
        (model,) = load_models(text, workspace=None, diagnostics=told)
        semantics = load_srdf(
            f'<robot name="r">{srdf}</robot>', robot=model, workspace=None, diagnostics=told
        )
        return RobotModel.build(model, semantics, limits, diagnostics=told)  # type: ignore[arg-type]

    return make
