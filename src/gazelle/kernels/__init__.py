"""Loops that are compiled for this machine when they are first needed."""

from gazelle.kernels.areas import AREAS, COMPILING, Area
from gazelle.kernels.dispatch import Kernel, compiling, kernel, kernels
from gazelle.kernels.source import External, KernelSource

__all__ = [
    "AREAS",
    "COMPILING",
    "Area",
    "External",
    "Kernel",
    "KernelSource",
    "compiling",
    "kernel",
    "kernels",
]
