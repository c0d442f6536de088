"""Parameters are compared as Snakemake does, without pandas where nothing has imported it."""

import sys

import pandas as pd

from nptcs.start.pandas_values import look_for_pandas_only_if_imported


def persistence():
    class Persistence:
        def _serialize_param_builtin(self, value):
            return repr(value)

        def _serialize_param_pandas(self, value):
            if isinstance(value, pd.Series):
                return f"series {value.tolist()}"
            return self._serialize_param_builtin(value)

    return Persistence


def test_pandas_objects_are_found_where_pandas_is_imported():
    changed = persistence()
    look_for_pandas_only_if_imported(changed)
    assert changed()._serialize_param_pandas(pd.Series([1])) == "series [1]"
    assert changed()._serialize_param_pandas({"a": 1}) == "{'a': 1}"


def test_without_pandas_nothing_looks_for_it(monkeypatch):
    changed = persistence()
    look_for_pandas_only_if_imported(changed)
    series = pd.Series([1])
    monkeypatch.delitem(sys.modules, "pandas")
    assert changed()._serialize_param_pandas(series) == repr(series)
    assert "pandas" not in sys.modules


def test_the_second_time_nothing_changes():
    changed = persistence()
    look_for_pandas_only_if_imported(changed)
    first = changed._serialize_param_pandas
    look_for_pandas_only_if_imported(changed)
    assert changed._serialize_param_pandas is first


def test_snakemake_still_has_the_method():
    from snakemake.persistence import PersistenceBase

    look_for_pandas_only_if_imported(PersistenceBase)
    assert PersistenceBase._serialize_param_pandas.__module__ == "nptcs.start.pandas_values"
