"""The versions of the software that a run uses."""

from __future__ import annotations

import platform
from importlib.metadata import version

from nptcs import __version__

PACKAGES = (
    "snakemake",
    "numpy",
    "scipy",
    "pandas",
    "scikit-learn",
    "matplotlib",
    "openpyxl",
)


def software_versions() -> dict[str, str]:
    """Return the versions of nptcs, Python and the packages that numbers and pages depend on."""
    return {
        "nptcs": __version__,
        "Python": platform.python_version(),
        **{name: version(name) for name in PACKAGES},
    }
