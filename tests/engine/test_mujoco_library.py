"""Which MuJoCo is accepted."""

from __future__ import annotations

import pytest

from gazelle.engine.mujoco_library import check_version
from gazelle.errors import EngineError


def test_mujoco_4_0_0_is_refused_with_the_reason():
    with pytest.raises(EngineError, match=r"MuJoCo 4\.0\.0 computes wrong accelerations") as caught:
        check_version("4.0.0")
    assert "pip install 'mujoco-core>=4.0.1'" in str(caught.value)


def test_old_mujoco_is_refused():
    with pytest.raises(EngineError, match=r"MuJoCo 3\.3\.6 is too old"):
        check_version("3.3.6")


@pytest.mark.parametrize("version", ["4.0.1", "4.1.0", "5.0.0rc1"])
def test_newer_mujoco_is_accepted(version):
    check_version(version)
