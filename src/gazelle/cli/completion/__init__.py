"""``gazelle complete WORD…``: what a shell offers behind the words typed so far."""

from __future__ import annotations

from pathlib import Path

from gazelle.cli.completion.candidates import candidates

__all__ = ["main"]


def main(argv: list[str]) -> int:
    """Print the candidates for the last word, one per line; nothing means files."""
    if not argv:
        print("usage: gazelle complete COMMAND [WORD ...]")
        return 2
    command, *words = argv
    for one in candidates(Path(command).name, words or [""]):
        print(one)
    return 0
