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
        values = for_its_studies(joined(values, content), values)
    return read_config(values, " + ".join(paths))


ASKED_OF_STUDIES = ("decisions", "uncertainty")
"""Sections that ask something of studies by their names and factors."""


def for_its_studies(values: Mapping[str, Any], below: Mapping[str, Any]) -> dict[str, Any]:
    """Leave out what a first file asks of its studies where a later file has replaced them.

    Parameters
    ----------
    values : mapping
        The whole configuration.
    below : mapping
        The first file alone.

    Examples
    --------
    >>> first = {"studies": ["a"], "decisions": ["which a?"]}
    >>> for_its_studies({**first, "studies": ["b"]}, first)
    {'studies': ['b']}
    >>> for_its_studies({"studies": ["b"], "decisions": ["which b?"]}, first)
    {'studies': ['b'], 'decisions': ['which b?']}
    """
    if not below or values.get("studies") == below.get("studies"):
        return dict(values)
    left = {key for key in ASKED_OF_STUDIES if values.get(key) == below.get(key)}
    return {key: value for key, value in values.items() if key not in left}


def joined(below: Mapping[str, Any], above: Mapping[str, Any]) -> dict[str, Any]:
    """Put one section on top of another.

    Examples
    --------
    >>> joined({"a": 1, "b": {"c": 2, "d": 3}}, {"b": {"c": 4}})
    {'a': 1, 'b': {'c': 4, 'd': 3}}
    """
    result = dict(below)
    for key, value in above.items():
        old = result.get(key)
        both = isinstance(old, Mapping) and isinstance(value, Mapping)
        result[key] = joined(old, value) if both else value  # type: ignore[arg-type]
    return result
