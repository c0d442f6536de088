"""Read and write tables: checked against their contract, written whole or not at all."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from importlib.util import find_spec
from pathlib import Path
from typing import Any, cast

import numpy as np
import pandas as pd
import pandera.pandas as pa
from pandera.errors import SchemaError, SchemaErrors

from nptcs.errors import InputError
from nptcs.files import atomic_path

if find_spec("geopandas") is None:
    # pandera tries to import it for each column that it checks, and Python would look for it each
    # time in all folders of modules; None says that there is none
    sys.modules.setdefault("geopandas", None)  # type: ignore[arg-type]


def write_table(path: str | Path, table: pd.DataFrame, contract: type[pa.DataFrameModel]) -> None:
    """Check a table against its contract and write it as CSV, at full precision.

    Raises
    ------
    InputError
        Naming the column and the value that break the contract.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from nptcs.tables.problems import Problems, problems_table
    >>> problems = problems_table([("ingest", "T0-1", "", "error", "no unit")])
    >>> with TemporaryDirectory() as folder:
    ...     write_table(f"{folder}/problems.csv", problems, Problems)
    ...     read_table(f"{folder}/problems.csv", Problems)["message"].tolist()
    ['no unit']
    """
    checked = check(table, contract, str(path))
    with atomic_path(path) as temporary:
        checked.to_csv(temporary, index=False, lineterminator="\n")


def read_table(path: str | Path, contract: type[pa.DataFrameModel]) -> pd.DataFrame:
    """Read a CSV table and check it against its contract.

    Raises
    ------
    InputError
        For a missing file, a missing column or a value outside the contract.
    """
    return check(_as_written(path, contract), contract, str(path))


def _as_written(path: str | Path, contract: type[pa.DataFrameModel]) -> pd.DataFrame:
    """Read a CSV table, texts as texts, without checking it."""
    if not Path(path).is_file():
        raise InputError("this table does not exist", file=path, remedy="run snakemake again")
    text_columns = {
        name: str
        for name, column in contract.to_schema().columns.items()
        if str(column.dtype).startswith(("str", "object"))
    }
    table = pd.read_csv(path, dtype=text_columns, keep_default_na=False, na_values=[""])
    for name in text_columns:
        if name in table:
            table[name] = table[name].fillna("")
    return table


def read_alike(
    paths: Iterable[str | Path], contract: type[pa.DataFrameModel]
) -> list[pd.DataFrame]:
    """Read tables of one contract whose rules concern single rows, and check them all at once.

    Parameters
    ----------
    paths : iterable of path
    contract : type
        Without rules that concern several rows.

    Raises
    ------
    InputError
        As `read_table`.
    """
    files = list(paths)
    written = [_as_written(path, contract) for path in files]
    if len({tuple(table.columns) for table in written}) == 1:
        try:
            checked = contract.validate(pd.concat(written, ignore_index=True), lazy=False)
        except (SchemaError, SchemaErrors):
            pass  # checking each table by itself tells which file and line it is
        else:
            ends = np.cumsum([len(table) for table in written])[:-1]
            parts = zip([0, *ends], [*ends, len(checked)], strict=True)
            return [checked.iloc[start:end].reset_index(drop=True) for start, end in parts]
    return [check(table, contract, str(path)) for table, path in zip(written, files, strict=True)]


def read_tables(paths: Iterable[str | Path], contract: type[pa.DataFrameModel]) -> pd.DataFrame:
    """Read tables of one contract and join them, row under row; no tables, no rows.

    Raises
    ------
    InputError
        As `read_table`.
    """
    tables = [read_table(path, contract) for path in paths]
    return pd.concat(tables, ignore_index=True) if tables else empty_table(contract)


def empty_table(contract: type[pa.DataFrameModel]) -> pd.DataFrame:
    """Return a table without rows that fulfils the contract."""
    columns = contract.to_schema().columns
    return check(pd.DataFrame({name: [] for name in columns}), contract, contract.__name__)


def check(table: pd.DataFrame, contract: type[pa.DataFrameModel], file: str) -> pd.DataFrame:
    """Return the table in the form of its contract, or name what breaks it.

    Raises
    ------
    InputError
        With file, line (of the CSV, the header being line 1), column and value.

    Examples
    --------
    >>> from nptcs.tables.problems import Problems
    >>> list(empty_table(Problems).columns)
    ['stage', 'name', 'solver', 'status', 'message']
    """
    try:
        return cast(pd.DataFrame, contract.validate(table, lazy=False))
    except (SchemaError, SchemaErrors) as error:
        raise _explain(error, contract, file) from None


def _explain(
    error: SchemaError | SchemaErrors, contract: type[pa.DataFrameModel], file: str
) -> InputError:
    """Turn a pandera error into ours."""
    remedy = f"see the contract {contract.__name__}: {(contract.__doc__ or '').splitlines()[0]}"
    cases = getattr(error, "failure_cases", None)
    if isinstance(cases, pd.DataFrame) and len(cases) and "index" in cases:
        first = cases.iloc[0]
        schema = getattr(error, "schema", None)
        index: Any = first["index"]  # empty where the whole column is at fault
        return InputError(
            f"the value breaks the rule {getattr(error, 'check', None)}",
            file=file,
            line=None if pd.isna(index) else int(index) + 2,
            column=getattr(schema, "name", None),
            value=first["failure_case"],
            remedy=remedy,
        )
    return InputError(str(error).splitlines()[0], file=file, remedy=remedy)
