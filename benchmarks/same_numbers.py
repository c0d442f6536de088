"""Whether two finished runs have the same tables: ``python benchmarks/same_numbers.py A B``.

Prints one line per table: rows, the largest relative difference of any number, and what differs
in text. Wall times and keys are left out: they belong to the run and to the code. A table that has
another name in B is named by ``--renamed A.csv=B.csv``, a column by ``--column old=new``. Exits 1
if any number differs by more than ``--within`` (default 0) or any text differs.
"""

import argparse
import sys
from pathlib import Path

import numpy as np
import pandas as pd

OF_THE_RUN = ["wall_time_s", "key", "solver_version"]


def pairs(words: list[str]) -> dict[str, str]:
    """Parse arguments of the form ``old=new``."""
    return dict(word.split("=", 1) for word in words)


def compare(before: pd.DataFrame, after: pd.DataFrame) -> tuple[float, list[str]]:
    """Return the largest relative difference of the numbers, and the columns whose text differs."""
    largest, texts = 0.0, []
    for name in before.columns:
        if pd.api.types.is_numeric_dtype(before[name]) and before[name].dtype != bool:
            one, two = (table[name].to_numpy(float) for table in (before, after))
            if (np.isnan(one) != np.isnan(two)).any():
                return np.inf, texts
            scale = np.maximum(np.abs(one), np.abs(two))
            with np.errstate(invalid="ignore", divide="ignore"):
                difference = np.where(one == two, 0.0, np.abs(one - two) / scale)
            largest = max(largest, float(np.nan_to_num(difference).max(initial=0.0)))
        elif not before[name].fillna("").equals(after[name].fillna("")):
            texts.append(name)
    return largest, texts


def main() -> int:
    """Compare the tables of two runs."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("before", type=Path, help="folder of the one run")
    parser.add_argument("after", type=Path, help="folder of the other")
    parser.add_argument("--renamed", nargs="*", default=[], metavar="A.csv=B.csv")
    parser.add_argument("--column", nargs="*", default=[], metavar="OLD=NEW")
    parser.add_argument("--within", type=float, default=0.0, help="relative difference")
    arguments = parser.parse_args()
    renamed, columns = pairs(arguments.renamed), pairs(arguments.column)
    tables = [folder / "results" / "tables" for folder in (arguments.before, arguments.after)]
    same = True
    for file in sorted(tables[0].glob("*.csv")):
        other = tables[1] / renamed.get(file.name, file.name)
        if not other.exists():
            print(f"{file.name:36} is missing in {arguments.after}")
            same = False
            continue
        before, after = (pd.read_csv(path, comment="#") for path in (file, other))
        before = before.rename(columns=columns).drop(columns=OF_THE_RUN, errors="ignore")
        after = after.drop(columns=OF_THE_RUN, errors="ignore")
        if list(before) != list(after) or len(before) != len(after):
            print(f"{file.name:36} other columns or rows: {set(before) ^ set(after)}")
            same = False
            continue
        largest, texts = compare(before, after)
        print(f"{file.name:36} {len(before):6d} rows, numbers differ by {largest:.1e}", *texts)
        same &= largest <= arguments.within and not texts
    return 0 if same else 1


if __name__ == "__main__":
    sys.exit(main())
