"""An XML element as a frozen value that knows where it stands."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from gazelle.diagnostics import SourceSpan

__all__ = ["Tag"]


@dataclass(frozen=True, slots=True)
class Tag:
    """One element.

    Attributes:
        name: tag name as written, a prefix such as ``controller:`` included.
        attributes: attribute values by name, in document order.
        children: child elements in document order.
        text: character data directly inside, stripped; that between children is joined.
        raw_text: the same, unstripped: YAML inside XML needs its indentation.
        span: place of the start tag.
    """

    name: str
    span: SourceSpan
    attributes: dict[str, str] = field(default_factory=dict)
    children: tuple[Tag, ...] = ()
    text: str = ""
    raw_text: str = ""

    def find(self, *names: str) -> Tag | None:
        """Return the first descendant reached by these child names, or None."""
        tag = self
        for name in names:
            for child in tag.children:
                if child.name == name:
                    tag = child
                    break
            else:
                return None
        return tag

    def find_all(self, name: str) -> tuple[Tag, ...]:
        """Return all children of this name."""
        return tuple([child for child in self.children if child.name == name])

    def text_of(self, *names: str, default: str = "") -> str:
        """Return the text of a descendant, `default` when it is absent or empty."""
        tag = self.find(*names)
        return tag.text if tag is not None and tag.text else default

    def walk(self) -> Iterator[Tag]:
        """Yield this tag and all descendants in document order."""
        waiting = [self]
        while waiting:
            tag = waiting.pop()
            yield tag
            waiting += reversed(tag.children)

    def to_xml(self, indent: str = "") -> str:
        """Return the element as XML text, children indented by two spaces."""
        # It brings the whole of urllib, which nobody needs who only reads.
        from xml.sax.saxutils import escape, quoteattr

        attributes = "".join(f" {key}={quoteattr(value)}" for key, value in self.attributes.items())
        head = f"{indent}<{self.name}{attributes}"
        if not self.children:
            return f"{head}>{escape(self.text)}</{self.name}>" if self.text else f"{head}/>"
        inner = [f"{indent}  {escape(self.text)}"] if self.text else []
        inner += [child.to_xml(indent + "  ") for child in self.children]
        return "\n".join([f"{head}>", *inner, f"{indent}</{self.name}>"])
