"""Imports of optional packages: one clear error that names the extra to install."""

from __future__ import annotations

import importlib
from types import ModuleType


def require(module: str, extra: str) -> ModuleType:
    """Imports `module`; raises ImportError with the command that installs it if it is missing."""
    try:
        return importlib.import_module(module)
    except ImportError as missing:
        raise ImportError(
            f"{module} is missing, which this function of heml needs: pip install 'heml[{extra}]'"
        ) from missing
