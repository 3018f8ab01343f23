"""What catkin's own commands in ``CMakeLists.txt`` bring along."""

from __future__ import annotations

from gazelle.documents.names import is_file
from gazelle.workspace.building.cmake_lists import CMakeLists, Step
from gazelle.workspace.building.environment_files import add_environment_file
from gazelle.workspace.building.packages import SourcePackage
from gazelle.workspace.building.plan import Layout, Plan
from gazelle.workspace.building.python_plan import add_python_distribution, completed
from gazelle.workspace.building.setup_file import read_setup

__all__ = ["add_catkin"]


def add_catkin(package: SourcePackage, lists: CMakeLists, layout: Layout, plan: Plan) -> None:
    """Plan Python modules and environment hooks; they are in devel and install spaces alike."""
    for step in lists.called("catkin_python_setup"):
        setup = read_setup(package.path)
        if setup is None or (setup.error is None and not setup.is_called):
            text = "catkin_python_setup() needs a setup.py with setup()"
            plan.diagnostics.report("package.no-build-file", text, step.span)
        elif setup.error is None:
            add_python_distribution(package, completed(package, setup, plan), layout, plan)
    for step in lists.called("catkin_add_env_hooks"):
        _add_hooks(package, step, "etc/catkin/profile.d", plan)


def _add_hooks(package: SourcePackage, step: Step, folder: str, plan: Plan) -> None:
    """Plan the shell files of a ``catkin_add_env_hooks`` call."""
    words = ("SHELLS", "DIRECTORY", "SKIP_INSTALL")
    where = "".join(step.after("DIRECTORY", words)[:1]) or "env-hooks"
    for shell in step.after("SHELLS", words):
        if shell not in {"sh", "bash", "zsh"} or not step.words:
            continue
        names = [f"{where}/{step.words[0]}.{shell}{ending}" for ending in ("", ".in")]
        found = [name for name in names if is_file(package.path / step.folder / name)]
        for name in found:
            add_environment_file(package, step, name, folder, plan)
        if not found:
            text = f"'{names[0]}' is not there as it is sourced (an .em file is made by catkin "
            text += "only); the hook is left out"
            plan.diagnostics.report("package.install-unread", text, step.span)
