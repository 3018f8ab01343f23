"""Annotations that users' code takes from rclpy's modules."""

from __future__ import annotations

from typing import TypeVar

__all__ = ["MsgType", "SrvType", "SrvTypeRequest", "SrvTypeResponse"]

MsgType = TypeVar("MsgType")
SrvType = TypeVar("SrvType")
SrvTypeRequest = TypeVar("SrvTypeRequest")
SrvTypeResponse = TypeVar("SrvTypeResponse")
