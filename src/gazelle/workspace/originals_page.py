"""The list as a page: ``python -m gazelle.workspace.originals_page > docs/worlds.md``."""

from __future__ import annotations

import sys

from gazelle.workspace.originals import original_models, original_worlds

__all__ = ["originals_markdown"]

_HEAD = """# Worlds and models by name

What both Gazebos ship by name, and launch files refer to by name: `gz sim shapes.sdf`,
`worlds/empty.world`, `model://sun`, `https://fuel.gazebosim.org/…/models/Ground Plane`. Those that
are here are Gazelle's own: names, places and sizes are the original's, shapes are plain. Nothing is
downloaded; a model of that name on `GAZEBO_MODEL_PATH`, `GZ_SIM_RESOURCE_PATH`, in a package's
`models` folder or in Fuel's cache comes first. The others are refused by name, with where they are.
This page is generated: `python -m gazelle.workspace.originals_page > docs/worlds.md`.

"""


def originals_markdown() -> str:
    """Return the page: worlds and models that are here, and the names of those that are not."""
    lines = ["## Worlds", "", "| world | of | what it is |", "| --- | --- | --- |"]
    for row in original_worlds().values():
        what = row.about if row.is_here else f"not here: {row.about}"
        lines.append(f"| `{row.name}` | {row.owner} | {what} |")
    lines += ["", "## Models", "", "| model | what it is |", "| --- | --- |"]
    models = list(original_models().values())
    lines += [f"| `{row.name}` | {row.about} |" for row in models if row.is_here]
    missing = ", ".join(f"`{row.name}`" for row in models if not row.is_here)
    lines += ["", f"Not here, by name: {missing}."]
    return _HEAD + "\n".join(lines) + "\n"


if __name__ == "__main__":
    sys.stdout.write(originals_markdown())
