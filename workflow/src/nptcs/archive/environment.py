"""What a run depends on outside the project: Python, packages, platform, linear algebra."""

from __future__ import annotations

import platform
import sys
from importlib import metadata
from typing import Any


def environment_facts() -> dict[str, Any]:
    """Describe this process's environment as plain values.

    Returns
    -------
    dict
        ``python``, ``platform``, ``packages`` (name → version, as ``pip freeze`` lists them) and
        ``linear_algebra`` (one entry per loaded library: name, version, kernel).
    """
    import numpy as np  # noqa: F401  (loads the library that is described)
    from threadpoolctl import threadpool_info

    libraries = [
        {
            "library": str(found.get("internal_api")),
            "version": str(found.get("version")),
            "kernel": str(found.get("architecture", "not stated")),
        }
        for found in threadpool_info()
        if found.get("user_api") == "blas"
    ]
    return {
        "python": f"{platform.python_implementation()} {platform.python_version()}",
        "platform": platform.platform(),
        "machine": platform.machine(),
        "byte_order": sys.byteorder,
        "packages": installed_packages(),
        "linear_algebra": libraries,
    }


def installed_packages() -> dict[str, str]:
    """Return the version of each installed package, in the order of the names."""
    found = {dist.metadata["Name"]: dist.version for dist in metadata.distributions()}
    return dict(sorted(found.items(), key=lambda item: item[0].casefold()))
