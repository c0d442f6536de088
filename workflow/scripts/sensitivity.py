"""Average gradients and comprehensive impact values of all polynomials, by every rule."""

from pathlib import Path
from typing import Any

from nptcs.compare.impact import with_published
from nptcs.console import clear_errors
from nptcs.surface.sensitivity.impact_table import impact_table
from nptcs.surface.stored import read_surfaces
from nptcs.tables.analysis.impact import Impact
from nptcs.tables.analysis.surface import JOINED, SurfaceQuality
from nptcs.tables.io import read_table, read_tables, write_table
from nptcs.tables.published.inputs import PublishedImpact
from nptcs.tables.tyres.cases import DesignTable


def assess(job: dict[str, Any], impact: str, **files: Any) -> None:
    surfaces = {Path(file).stem: read_surfaces(file) for file in files["surfaces"]}
    designs = {Path(file).stem: read_table(file, DesignTable) for file in files["designs"]}
    qualities = read_tables(files["quality_parts"], SurfaceQuality)
    computed = impact_table(surfaces, designs, qualities, job["rules"], job["near_tie_ratio"])
    published = read_tables(files["published"], PublishedImpact)
    write_table(impact, with_published(computed, published, job["refused"]), Impact)
    for name, contract in JOINED.items():
        write_table(files[name], read_tables(files[f"{name}_parts"], contract), contract)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        assess(**snakemake.params, **snakemake.input, **snakemake.output)
