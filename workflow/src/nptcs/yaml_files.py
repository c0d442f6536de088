"""YAML files of users, read without the aliases that let a small file grow without bound."""

from __future__ import annotations

from pathlib import Path

import yaml

from nptcs.errors import InputError

LARGEST_BYTES = 1_000_000


def read_yaml(path: str | Path) -> object:
    """Read a YAML file.

    An alias inside an anchored collection is refused: ten lines of these make a billion items.

    Raises
    ------
    InputError
        If the file is missing, too large, not UTF-8, not YAML, or contains nested aliases.
    """
    path = Path(path)
    try:
        if path.stat().st_size > LARGEST_BYTES:
            raise InputError(f"is larger than {LARGEST_BYTES} bytes", "shorten it", path)
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise InputError(f"cannot be read: {error.strerror}", "check the path", path) from error
    except UnicodeDecodeError as error:
        raise InputError("is not UTF-8", "save it as UTF-8", path) from error
    try:
        _refuse_nested_aliases(text, path)
        return yaml.safe_load(text)
    except (yaml.YAMLError, RecursionError) as error:
        mark = getattr(error, "problem_mark", None)
        line = None if mark is None else mark.line + 1
        raise InputError(
            "is not YAML", "put text with special characters in quotes", path, line
        ) from error


def _refuse_nested_aliases(text: str, path: Path) -> None:
    depth_of_anchor: list[int] = []
    depth = 0
    for event in yaml.parse(text, Loader=yaml.SafeLoader):
        if isinstance(event, yaml.CollectionStartEvent):
            depth += 1
            if event.anchor:
                depth_of_anchor.append(depth)
        elif isinstance(event, yaml.CollectionEndEvent):
            if depth_of_anchor and depth_of_anchor[-1] == depth:
                depth_of_anchor.pop()
            depth -= 1
        elif isinstance(event, yaml.AliasEvent) and depth_of_anchor:
            raise InputError(
                "an alias inside an anchored list or mapping",
                "write the values out",
                path,
                event.start_mark.line + 1 if event.start_mark else None,
                value=f"*{event.anchor}",
            )
