"""``ros2 bag convert`` and ``ros2 bag reindex``."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from gazelle.bag import BagError, BagMessage, create_bag, open_bag, rosbag2
from gazelle.bag.conversion import copy_bag
from gazelle.bag.formats import MCAP
from gazelle.diagnostics import Diagnostics, render
from gazelle.documents.yaml import YamlError, load_yaml_file

__all__ = ["convert", "reindex"]

_KNOWN = {"uri", "storage_id", "all", "all_topics", "topics", "exclude_topics"}
_KNOWN |= {"compression_format", "compression_mode"}


def reindex(argv: list[str]) -> int:
    """Write a bag's ``metadata.yaml`` from its files."""
    about = "Reconstruct metadata file for a bag"
    parser = argparse.ArgumentParser(prog="ros2 bag reindex", description=about)
    parser.add_argument("bag_path", help="Bag to open")
    parser.add_argument("-s", "--storage", help="accepted: the files themselves tell their format")
    options = parser.parse_args(argv)
    path = Path(options.bag_path)
    if not path.is_dir():
        raise BagError(f"Bag path '{path}' is not the folder of a bag")
    print(f"Reindexing files in {path}")
    rosbag2.reindex(path)
    print("Reindexing complete.")
    return 0


def convert(argv: list[str]) -> int:
    """Write bags as a YAML file says, from one or more bags."""
    about = "Given an input bag, write out a new bag with different settings"
    parser = argparse.ArgumentParser(prog="ros2 bag convert", description=about)
    parser.add_argument(
        "-i", "--input", nargs="+", action="append", required=True, metavar=("URI", "STORAGE")
    )
    text = "YAML file with output_bags: a list of uri, storage_id, topics, all"
    parser.add_argument("-o", "--output-options", required=True, help=text)
    options = parser.parse_args(argv)
    diagnostics = Diagnostics()
    for one in _outputs(Path(options.output_options)):
        _write([Path(item[0]) for item in options.input], one, diagnostics)
    render(diagnostics)
    return 0


def _outputs(path: Path) -> list[dict[str, Any]]:
    try:
        bags = load_yaml_file(path)["output_bags"]
    except (YamlError, KeyError, TypeError) as error:
        raise BagError(f"{path}: it must hold `output_bags:`, a list: {error}") from None
    for one in bags:
        unknown = sorted(set(one) - _KNOWN)
        if unknown:
            raise BagError(f"{path}: '{unknown[0]}' has no effect here; known: {sorted(_KNOWN)}")
        if "uri" not in one:
            raise BagError(f"{path}: an output bag lacks its `uri`")
    return list(bags)


def _write(inputs: list[Path], one: dict[str, Any], diagnostics: Diagnostics) -> None:
    names, left_out = set(one.get("topics") or ()), set(one.get("exclude_topics") or ())
    every = one.get("all", one.get("all_topics", not names))

    def wanted(message: BagMessage) -> bool:
        topic = message.connection.topic
        return topic not in left_out and (bool(every) or topic in names)

    storage = str(one.get("storage_id") or MCAP.name)
    writer = create_bag(one["uri"], storage, compression=str(one.get("compression_format") or ""))
    try:
        for path in inputs:
            copy_bag(open_bag(path), writer, diagnostics=diagnostics, wanted=wanted)
    finally:
        writer.close()
