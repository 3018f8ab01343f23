"""Shell files that a package has sourced together with its workspace."""

from __future__ import annotations

from pathlib import Path

from gazelle.documents.files import is_file
from gazelle.workspace.building.cmake_lists import Step
from gazelle.workspace.building.packages import SourcePackage
from gazelle.workspace.building.plan import Plan

__all__ = ["add_environment_file"]


def add_environment_file(
    package: SourcePackage, step: Step, word: str, folder: str, plan: Plan
) -> None:
    """Plan a shell or ``.dsv`` file that the package has sourced with its own."""
    if "${" in word:
        # ament's own: the path of libraries, which nobody builds here, and PATH, which is set.
        if not word.startswith("${ament_cmake_package_templates_"):
            text = f"'{word}' is known to CMake only; it is left out"
            plan.diagnostics.report("package.install-unread", text, step.span)
        return
    file = package.path / step.folder / word
    if not is_file(file):
        text = f"{step.name}() names '{word}', and there is no such file"
        plan.diagnostics.report("package.install-missing", text, step.span)
        return
    name = file.name.removesuffix(".in")
    plan.write(f"{folder}/{name}", _configured(file, package))
    if name.endswith((".sh", ".dsv", ".bash", ".zsh")):
        plan.scripts.append(f"{folder}/{name}")


def _configured(file: Path, package: SourcePackage) -> str:
    text = file.read_text(encoding="utf-8", errors="replace")
    if file.suffix == ".in":
        text = text.replace("@PROJECT_NAME@", package.name)
        text = text.replace("${PROJECT_NAME}", package.name)
    return text
