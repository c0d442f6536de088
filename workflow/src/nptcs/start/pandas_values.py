"""Keep Snakemake from importing pandas only to look for pandas objects among parameters."""

from __future__ import annotations

import sys
from typing import Any


def look_for_pandas_only_if_imported(persistence_class: Any) -> None:
    """Let Snakemake compare parameters without importing pandas, a fifth of an idle start.

    A value can be a pandas object only where something has imported pandas; then Snakemake looks
    as it does anyway.

    Parameters
    ----------
    persistence_class : type
        Snakemake's, with ``_serialize_param_pandas``; without that method, or the second time in a
        process, nothing changes.
    """
    look = getattr(persistence_class, "_serialize_param_pandas", None)
    if look is None or look.__module__ == __name__:
        return

    def serialize(persistence: Any, value: Any) -> Any:
        if "pandas" in sys.modules:
            return look(persistence, value)
        return persistence._serialize_param_builtin(value)

    persistence_class._serialize_param_pandas = serialize
