"""What a solid that is given by lengths alone says of itself, once for everybody who asks.

Readers, writers, checks, the engine, sensors and the page know some solids by their class, where
they have something better than triangles for them. For any other they ask what is here, so that a
solid is its class and its row in `gazelle.description.model.shape.SOLIDS`.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import fields
from typing import Any, ClassVar, NamedTuple

from gazelle.geometry.mass_properties import MassProperties
from gazelle.geometry.mesh import MeshPart

__all__ = ["Length", "Solid"]

Vector3 = tuple[float, float, float]


class Length(NamedTuple):
    """One of the lengths that make a solid.

    Attributes:
        field: of the class, in metres.
        usual: what SDF takes where it is not written; one number, or three.
    """

    field: str
    usual: float | Vector3

    @property
    def word(self) -> str:
        """The child in SDF, and the attribute in URDF."""
        return self.field.removesuffix("_m")


class Solid(ABC):
    """A solid; classes of solids are frozen dataclasses whose fields are lengths.

    A length is a number or three of them; its field ends in ``_m``, and without that ending it is
    the child's name in SDF.

    Attributes:
        word: of SDF's ``<geometry>``.
        usual: SDF's defaults of the fields, in their order.
        in_urdf: whether it is a word of URDF too; elsewhere it is written as a mesh there.
        is_convex: whether it is the hull of its surface.
    """

    __slots__ = ()

    word: ClassVar[str]
    usual: ClassVar[tuple[float | Vector3, ...]]
    in_urdf: ClassVar[bool] = False
    is_convex: ClassVar[bool] = True

    @classmethod
    def lengths(cls) -> tuple[Length, ...]:
        """Return the lengths in the order of the fields."""
        names = (field.name for field in fields(cls))  # type: ignore[arg-type]
        return tuple(Length(*row) for row in zip(names, cls.usual, strict=True))

    @classmethod
    def of_lengths(cls, lengths_m: tuple[Any, ...]) -> Solid:
        """Return the solid of these values of its fields."""
        return cls(*lengths_m)

    @abstractmethod
    def body(self, density_kg_m3: float) -> MassProperties:
        """Return it filled evenly, in its own frame."""

    @abstractmethod
    def mesh(self) -> MeshPart:
        """Return triangles of its surface, closed and facing outwards, for lengths above 0."""
