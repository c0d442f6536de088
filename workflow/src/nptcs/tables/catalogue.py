"""All result tables: file name and contract."""

import pandera.pandas as pa

from nptcs.tables.against_published import AgainstPublished, StiffnessByLevel, StiffnessErrors
from nptcs.tables.cases import Cases
from nptcs.tables.files import Files
from nptcs.tables.hyperelastic import ModelComparison, RangeTable
from nptcs.tables.impact import Impact
from nptcs.tables.lca_validation import LcaAgainstFem, LcaShape, LcaValidation
from nptcs.tables.neutral_line import NeutralLine
from nptcs.tables.problems import Problems
from nptcs.tables.properties import PropertiesTable
from nptcs.tables.spoke_stiffness import SpokeCurves, SpokeLines
from nptcs.tables.statistics import StatisticsTable
from nptcs.tables.surface import SurfaceQuality, SurfaceTable

TABLES: dict[str, type[pa.DataFrameModel]] = {
    "files.csv": Files,
    "specimens.csv": PropertiesTable,
    "statistics.csv": StatisticsTable,
    "hyperelastic_models.csv": ModelComparison,
    "c10_against_range.csv": RangeTable,
    "cases.csv": Cases,
    "STUDY_surface.csv": SurfaceTable,
    "surface_quality.csv": SurfaceQuality,
    "impact.csv": Impact,
    "spoke_stiffness.csv": SpokeLines,
    "spoke_curves.csv": SpokeCurves,
    "stiffness_against_published.csv": AgainstPublished,
    "stiffness_errors.csv": StiffnessErrors,
    "stiffness_by_level.csv": StiffnessByLevel,
    "neutral_line.csv": NeutralLine,
    "lca_validation.csv": LcaValidation,
    "lca_against_fem.csv": LcaAgainstFem,
    "lca_shape.csv": LcaShape,
    "problems.csv": Problems,
}
"""Tables of ``results/tables``; STUDY stands for the name of each study."""
