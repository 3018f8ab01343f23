"""Launch descriptions with spawners have the words that ros2_control gives them."""

from __future__ import annotations

import pytest

from gazelle.launch.ros2 import LaunchContext, LaunchDescription
from gazelle.launch.ros2 import controller_manager as c
from gazelle.launch.ros2.utilities import perform_substitutions


def _words(description: LaunchDescription, **given: str) -> str:
    context = LaunchContext()
    names = {"controller_manager_name": "controller_manager", "unload_on_kill": "false"}
    context.launch_configurations.update(names | given)
    command = description.entities[-1].cmd  # type: ignore[attr-defined]
    words = [perform_substitutions(context, word) for word in command]
    return " ".join(words[1:]).split(" --ros-args")[0].strip()


def test_controllers_with_files_are_spawned() -> None:
    made = c.generate_controllers_spawner_launch_description(["a", "b"], ["f.yaml"], ["--inactive"])
    expected = "a b --controller-manager controller_manager --param-file f.yaml"
    assert _words(made) == f"{expected}  --inactive"
    assert _words(made, unload_on_kill="true").endswith("--unload-on-kill --inactive")
    names = [one.name for one in made.get_launch_arguments()]
    assert names == ["controller_manager_name", "unload_on_kill"]


def test_names_may_have_files_or_none() -> None:
    made = c.generate_controllers_spawner_launch_description_from_dict(
        {"a": None, "b": "f.yaml", "c": ["g.yaml", "h.yaml"]}
    )
    assert "--param-file f.yaml --param-file g.yaml --param-file h.yaml" in _words(made)
    one = c.generate_load_controller_launch_description("a")
    assert _words(one) == "a --controller-manager controller_manager"
    with pytest.raises(ValueError, match="Invalid controller_info_dict type parsed"):
        c.generate_controllers_spawner_launch_description_from_dict(["a"])  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="Expected str or list"):
        c.generate_controllers_spawner_launch_description_from_dict({"a": 1})


def test_each_controller_has_its_own_words() -> None:
    made = c.generate_spawner_launch_description(
        {
            "a": {"param_file": ["f.yaml"], "load_only": True, "inactive": False},
            "b": {"inactive": True, "ros_args": "-r x:=y"},
        },
        ["--switch-timeout", "5"],
    )
    assert _words(made) == (
        "--controller a --param-file f.yaml --load-only"
        " --controller b --inactive --controller-ros-args -r x:=y --switch-timeout 5"
    )
    with pytest.raises(ValueError, match="Invalid inactive type parsed"):
        c.generate_spawner_launch_description({"a": {"inactive": "yes"}})
