"""How a ``gz`` command of either Gazebo is run, and how it ends."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from gazelle.cli.gz.options import GzCommand, help_text, read_options
from gazelle.cli.sdf.sdf_file import say
from gazelle.errors import GazelleError

__all__ = ["ended", "run_with_options"]

_FAILED = 255


def ended(work: Callable[[], int]) -> int:
    """Do a command's work.

    Returns:
        what the work does; 0 for Ctrl-C; 255 when it could not do what it was asked, where
        Gazebo often ends with 0.
    """
    try:
        return work()
    except KeyboardInterrupt:
        return 0
    except GazelleError as error:
        say([error])
        return _FAILED


def run_with_options(
    command: GzCommand, action: Callable[[Mapping[str, str]], int], words: Iterable[str]
) -> int:
    """Read a command's options and do what they say, or print them where help is wanted."""
    options = read_options(command, words)
    if options is None:
        say([help_text(command)])
        return 0
    return action(options)
