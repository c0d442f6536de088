"""Faults in a configuration, described so that a user can act on them."""

from __future__ import annotations

import difflib
from typing import Any

from pydantic import BaseModel, ValidationError


def describe_faults(error: ValidationError, model: type[BaseModel]) -> str:
    """Turn a validation error into one line per fault: key path, fault, nearest known key."""
    lines = []
    for fault in error.errors():
        path = ".".join(str(part) for part in fault["loc"]) or "(top level)"
        if fault["type"] == "extra_forbidden":
            known = _known_keys_at(model, fault["loc"])
            near = difflib.get_close_matches(str(fault["loc"][-1]), known, n=1)
            hint = f"did you mean '{near[0]}'?" if near else f"known keys: {', '.join(known)}"
            lines.append(f"{path}: unknown key; {hint}")
        elif fault["type"] == "missing":
            lines.append(f"{path}: is missing")
        else:
            lines.append(f"{path}: {fault['msg']} (value: {fault['input']!r:.80})")
    return "; ".join(lines)


def _known_keys_at(model: type[BaseModel], location: tuple[int | str, ...]) -> list[str]:
    """Name the known keys of the section that contains `location`."""
    schema = model.model_json_schema()
    section: dict[str, Any] = schema
    for part in location[:-1]:
        section = _resolve(section, schema)
        section = section["items"] if isinstance(part, int) else section["properties"][part]
    return sorted(_resolve(section, schema).get("properties", {}))


def _resolve(section: dict[str, Any], schema: dict[str, Any]) -> dict[str, Any]:
    """Follow a reference of a JSON schema, also one wrapped by ``anyOf`` or ``allOf``."""
    for wrapper in ("allOf", "anyOf"):
        options = [part for part in section.get(wrapper, []) if "$ref" in part]
        if options:
            section = options[0]
    while "$ref" in section:
        section = schema["$defs"][section["$ref"].rsplit("/", 1)[-1]]
    return section
