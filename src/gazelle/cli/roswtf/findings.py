"""What ``roswtf`` found, and the blocks it prints."""

from __future__ import annotations

from dataclasses import dataclass, field

__all__ = ["Findings", "summary"]

_WARNING = "\033[1mWARNING\033[0m"
_ERROR = "\033[31m\033[1mERROR\033[0m"


@dataclass(slots=True)
class Findings:
    """Texts of warnings and errors, in the order found."""

    warnings: list[str] = field(default_factory=list)
    errors: list[str] = field(default_factory=list)

    def warn(self, title: str, items: list[str]) -> None:
        """Add a warning about several things, if there are any."""
        if items:
            self.warnings.append("\n".join([title, *items]) + "\n")

    def blame(self, title: str, items: list[str]) -> None:
        """Add an error about several things, if there are any."""
        if items:
            self.errors.append("\n".join([title, *items]) + "\n")


def summary(title: str, found: Findings) -> str:
    """Return the block of one kind of checks, colours included, without the last line end."""
    lines = [title, ""]
    if not found.warnings and not found.errors:
        return "\n".join([*lines, "No errors or warnings"])
    if found.warnings:
        lines.append(f"Found {len(found.warnings)} warning(s).")
        lines += ["Warnings are things that may be just fine, but are sometimes at fault", ""]
        lines += [*(f"{_WARNING} {text}" for text in found.warnings), ""]
    if found.errors:
        lines += [f"Found {len(found.errors)} error(s).", ""]
        lines += [f"{_ERROR} {text}" for text in found.errors]
    return "\n".join(lines).removesuffix("\n" if not found.errors else "")
