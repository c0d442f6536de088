"""Whether two finished runs have the same tables: ``python benchmarks/same_numbers.py A B``.

Prints one line per table: rows, the largest relative difference of any number, and what differs
in text. Wall times and keys are left out: they belong to the run and to the code. A table that has
another name in B is named by ``--renamed A.csv=B.csv``, a column by ``--column old=new``. Exits 1
if any number differs by more than ``--within`` (default 0) or any text differs.
"""

import argparse
import sys
from pathlib import Path

from nptcs.archive.same_tables import compare_folders


def pairs(words: list[str]) -> dict[str, str]:
    """Parse arguments of the form ``old=new``."""
    return dict(word.split("=", 1) for word in words)


def main() -> int:
    """Compare the tables of two runs."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("before", type=Path, help="folder of the first run")
    parser.add_argument("after", type=Path, help="folder of the second run")
    parser.add_argument("--renamed", nargs="*", default=[], metavar="A.csv=B.csv")
    parser.add_argument("--column", nargs="*", default=[], metavar="OLD=NEW")
    parser.add_argument("--within", type=float, default=0.0, help="relative difference")
    arguments = parser.parse_args()
    tables = [folder / "results" / "tables" for folder in (arguments.before, arguments.after)]
    renamed, columns = pairs(arguments.renamed), pairs(arguments.column)
    found = compare_folders(tables[0], tables[1], renamed, columns)
    print(*found, sep="\n")
    return 0 if found and all(table.same(arguments.within) for table in found) else 1


if __name__ == "__main__":
    sys.exit(main())
