"""Average gradients and comprehensive impact values of all surfaces, by every rule."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pandas as pd

from nptcs.compare.impact import with_published
from nptcs.console import clear_errors
from nptcs.surface.sensitivity import impact
from nptcs.surface.stored import load
from nptcs.tables.cases import Design
from nptcs.tables.impact import Impact
from nptcs.tables.io import empty_table, read_table, write_table
from nptcs.tables.published_inputs import PublishedImpact
from nptcs.tables.surface import SurfaceQuality


def assess(
    job: dict[str, Any], surfaces: Sequence[str], designs: Sequence[str], published: str | None
) -> pd.DataFrame:
    tables = [
        impact(surface, read_table(design, Design), rule).assign(solver=solver, study=study)
        for study, file, design in zip(job["studies"], surfaces, designs, strict=True)
        for solver, surface in load(Path(file).read_text("utf-8")).items()
        for rule in job["rules"]
    ]
    columns = ["solver", "study", "factor", "rule", "gradient", "range", "impact"]
    ours = pd.concat(tables) if tables else pd.DataFrame(columns=columns)
    printed = read_table(published, PublishedImpact) if published else empty_table(PublishedImpact)
    return with_published(ours, printed)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        source = snakemake.input
        table = assess(
            snakemake.params.job,
            source.surfaces,
            source.designs,
            next(iter(source.get("published", [])), None),
        )
        write_table(snakemake.output.impact, table, Impact)
        quality = pd.concat([read_table(file, SurfaceQuality) for file in source.quality])
        write_table(snakemake.output.quality, quality, SurfaceQuality)
