"""Packages that are asked for only where they are used."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from .._errors import MissingError


def needed(module: str, by: str, extra: str) -> Any:
    """A module of a package that ``pyplatewash[extra]`` brings. Raises MissingError where the package is not installed."""
    package = module.split(".")[0]
    try:
        return import_module(module)
    except ModuleNotFoundError as error:
        if error.name is None or error.name.split(".")[0] != package:
            raise
        raise MissingError(f"{by} {package}, which is not installed: pip install 'pyplatewash[{extra}]'", name=package) from error
