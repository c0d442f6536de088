"""Configuration files, a later one on top of those before it, as Snakemake takes them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from nptcs.config.root import Config, read_config
from nptcs.errors import InputError
from nptcs.yaml_files import read_yaml


def read_config_files(paths: Sequence[str]) -> Config:
    """Read one configuration from several files.

    Sections are joined key by key, as by ``snakemake --configfile FIRST SECOND``; lists and single
    values of a later file replace those of an earlier one.

    Raises
    ------
    InputError
        For a file that cannot be read, and for every fault of the whole.
    """
    values: dict[str, Any] = {}
    for path in paths:
        content = read_yaml(path) or {}
        if not isinstance(content, dict):
            raise InputError("is not a configuration", "write 'key: value' lines", path)
        values = overlaid(values, content)
    return read_config(values, " + ".join(paths))


def overlaid(below: Mapping[str, Any], above: Mapping[str, Any]) -> dict[str, Any]:
    """Put one section on top of another.

    Examples
    --------
    >>> overlaid({"a": 1, "b": {"c": 2, "d": 3}}, {"b": {"c": 4}})
    {'a': 1, 'b': {'c': 4, 'd': 3}}
    """
    result = dict(below)
    for key, value in above.items():
        old = result.get(key)
        if isinstance(old, Mapping) and isinstance(value, Mapping):
            result[key] = overlaid(old, value)
        else:
            result[key] = value
    return result
