"""The whole configuration, and its errors described so that a user can act on them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Self

from pydantic import Field, ValidationError, model_validator

from nptcs.config.base import Strict
from nptcs.config.explain import describe_faults
from nptcs.config.laboratory import Laboratory
from nptcs.config.materials.calibration import CalibrationSettings
from nptcs.config.materials.ingest import IngestSettings
from nptcs.config.materials.reduction import ReductionSettings
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.config.studies.decisions import Decision
from nptcs.config.studies.responses import TyreResponseSettings
from nptcs.config.studies.sensitivity import Sensitivity
from nptcs.config.studies.study import Study
from nptcs.config.studies.surface import GaussianProcessModel, surface_name
from nptcs.config.studies.uncertainty import Uncertainty
from nptcs.errors import InputError
from nptcs.files import files_below


class LabData(Strict):
    """Where the laboratory's files are."""

    specimen_sheet: str = Field(
        "raw_data/example/specimens.csv",
        description="Specimen sheet; its folder contains the raw files that it names",
    )
    formats: str = Field(
        "config/formats", description="Folder with the format profiles of test machines"
    )


class Campaign(Strict):
    """How solver cases are run."""

    most_cases: int = Field(
        2000,
        ge=1,
        description="Cases of a study above which a run is refused; raise it to allow more, or "
        "start the run with `nptcs run --yes`",
    )
    bulk_from: int = Field(
        1000,
        ge=1,
        description="Number of cases of a study from which solvers that can solve a whole table of "
        "cases at once do so: minutes instead of hours, one file of columns, but no neutral lines "
        "and no plate stress",
    )
    batches: int = Field(
        1,
        ge=1,
        le=1000,
        description="Jobs into which each solver's cases of a study are divided (for clusters)",
    )
    minutes_per_batch: float | None = Field(
        None,
        gt=0,
        description="Divide the cases into jobs that usually take about this long, by the `case_s` "
        "of their solver, instead of into `batches` jobs",
    )
    queue_licence: str = Field(
        "",
        pattern=r"^[A-Za-z0-9_@.-]*$",
        description="Name under which Slurm counts the licence tokens of a solver (`Licenses=` in "
        "slurm.conf); empty: only `--resources licence_tokens=N` of Snakemake limits them",
    )
    cores_per_batch: int = Field(
        2,
        ge=1,
        description="Cores that a batch requests, at most those of `-j`; divided by the cores of "
        "one case (one, or the solver's `cpus`) they give the number of cases solved at a time",
    )


class LcaValidationSettings(Strict):
    """Published values against which the load-bearing model is checked."""

    spoke_stiffness: str = Field(
        "raw_data/published/table10_spoke_stiffness.csv", description="Table 10 of the paper"
    )
    published: str = Field(
        "raw_data/published/table11_lca_validation.csv", description="Table 11 of the paper"
    )
    published_loads: str = Field(
        "raw_data/published/figure15_load_errors.csv",
        description="Largest errors of LCA against FEM by load, section 4.3.2",
    )
    published_fem: str = Field(
        "raw_data/published/table7_rubber_doe.csv", description="Table 7 of the paper"
    )
    shear_band_c10_mpa: float = Field(5.0, gt=0, description="C10 of the band in table 11")


class ReportSettings(Strict):
    """The report's title, and a laboratory's templates that replace the package's."""

    title: str = Field("Load-bearing study of a non-pneumatic tyre with composite spokes")
    templates: str | None = Field(
        None,
        description="Folder with page templates of your own; each replaces the package's template "
        "of the same name",
    )


class Config(Strict):
    """The configuration file ``config/config.yaml``."""

    lab_data: LabData = LabData()
    ingest: IngestSettings = IngestSettings()
    reduction: ReductionSettings = ReductionSettings()
    calibration: CalibrationSettings = CalibrationSettings()
    tyre: TyreGeometry = TyreGeometry()
    studies: tuple[Study, ...] = Field(
        min_length=1, description="Studies, independent of each other"
    )
    further_studies: tuple[Study, ...] = Field(
        (),
        description="Studies after those of `studies`, so that a second file can add some: "
        "`snakemake --configfile config/joint.yaml`",
    )
    solvers: dict[str, dict[str, Any]] = Field(
        default_factory=dict, description="Options of each solver, by its name"
    )
    campaign: Campaign = Campaign()
    sensitivity: Sensitivity = Sensitivity()
    uncertainty: Uncertainty = Uncertainty()
    tyre_responses: TyreResponseSettings = TyreResponseSettings()
    lca_validation: LcaValidationSettings = LcaValidationSettings()
    report: ReportSettings = ReportSettings()
    laboratory: Laboratory = Laboratory()

    @model_validator(mode="before")
    @classmethod
    def _join_studies(cls, values: Any) -> Any:
        if not isinstance(values, Mapping) or not values.get("further_studies"):
            return values
        further = list(values["further_studies"])
        return {**values, "studies": [*values.get("studies", ()), *further], "further_studies": ()}

    @model_validator(mode="after")
    def _study_names_differ(self) -> Self:
        names = [study.name for study in self.studies]
        if len(set(names)) < len(names):
            raise ValueError(f"studies: a name is used twice: {names}")
        return self

    @model_validator(mode="after")
    def _distributions_are_of_factors(self) -> Self:
        factors = {factor.name for study in self.studies for factor in study.factors}
        if stray := sorted(set(self.sensitivity.distributions) - factors):
            raise ValueError(f"sensitivity.distributions: not a factor of any study: {stray}")
        return self

    def published_inputs(self) -> list[str]:
        """Name the published tables that the configuration compares with, those of studies last."""
        check = self.lca_validation
        named: list[str | None] = [
            self.sensitivity.published_impact,
            check.spoke_stiffness,
            check.published,
            check.published_loads,
            check.published_fem,
        ]
        for study in self.studies:
            named += [study.published_coefficients, study.published_spoke_stiffness]
        return [name for name in named if name]

    def page_inputs(self) -> list[str]:
        """Name the laboratory's own files for the report: its logo and its templates."""
        folder, logo = self.report.templates, self.laboratory.logo
        templates = files_below(folder) if folder else []
        return [*filter(None, [logo]), *map(str, templates)]

    @property
    def decisions(self) -> tuple[Decision, ...]:
        """The decisions of all studies, each with the name of its study."""
        return tuple(
            decision.model_copy(update={"study": study.name})
            for study in self.studies
            for decision in study.decisions
        )

    @model_validator(mode="after")
    def _surface_is_of_a_study(self) -> Self:
        known = [name for study in self.studies if study.terms for name in surface_names(study)]
        if (name := self.uncertainty.surface) is not None and known and name not in known:
            raise ValueError(
                f"uncertainty.surface: no study has a surface {name!r}; there are "
                f"{', '.join(dict.fromkeys(known))}"
            )
        return self

    @model_validator(mode="after")
    def _decisions_are_of_studies(self) -> Self:
        names = [decision.name for decision in self.decisions]
        if len(set(names)) < len(names):
            raise ValueError(f"decisions: a name is used twice: {names}")
        if "reference" in names:
            raise ValueError("decisions: the name 'reference' is reserved for the reference design")
        for study in self.studies:
            for decision in study.decisions:
                if decision.study not in ("", study.name):
                    raise ValueError(
                        f"decisions.{decision.name}.study: it is a decision of study {study.name}"
                    )
        for decision in self.decisions:
            self.check_decision(decision)
        return self

    def check_decision(self, decision: Decision) -> None:
        """Refuse a decision that its study cannot answer, whatever its cases give.

        Raises
        ------
        ValueError
            For a solver, a surface or a factor that the study does not have.
        """
        study = self.study(decision.study)
        key = f"decisions.{decision.name}"
        if not study.terms:
            raise ValueError(f"{key}.study: study {study.name} has no surface: it has no terms")
        if decision.solver not in study.solvers:
            raise ValueError(
                f"{key}.solver: study {study.name} is solved by {', '.join(study.solvers)}, not by "
                f"{decision.solver!r}"
            )
        known = surface_names(study)
        if decision.surface is not None and decision.surface not in known:
            raise ValueError(
                f"{key}.surface: no surface {decision.surface!r} in study {study.name}; it has "
                f"{', '.join(known)}"
            )
        factors = [factor.name for factor in study.factors]
        if stray := sorted({*decision.hold, *decision.steps} - set(factors)):
            raise ValueError(f"{key}: not a factor of study {study.name}: {stray}")

    def study(self, name: str) -> Study:
        """Return the study of that name."""
        return next(study for study in self.studies if study.name == name)

    def solver_options(self, study: Study) -> dict[str, dict[str, Any]]:
        """Return the options of each solver of a study: the study overrides the general ones."""
        return {
            name: {**self.solvers.get(name, {}), **study.solver_options.get(name, {})}
            for name in study.solvers
        }

    def options_of(self, study: str, solver: str) -> dict[str, Any]:
        """Return the options of one solver of a study."""
        return self.solver_options(self.study(study))[solver]


def read_config(values: Mapping[str, Any], file: str = "config/config.yaml") -> Config:
    """Check configuration values against the schema.

    Parameters
    ----------
    values : mapping
        Content of the YAML file.
    file : str
        Name of the file, for the message.

    Returns
    -------
    Config

    Raises
    ------
    InputError
        All faults in one message: the key's path, the value, and the nearest known key.

    Examples
    --------
    >>> read_config({"studys": []}, "mine.yaml")
    Traceback (most recent call last):
    nptcs.errors.InputError: ...studys: unknown key; did you mean 'studies'?...
    """
    try:
        return Config.model_validate(values)
    except ValidationError as error:
        raise InputError(describe_faults(error, Config), file=file) from None


def surface_names(study: Study) -> list[str]:
    """Name the surfaces that can answer for a study with terms, each once."""
    process = GaussianProcessModel(kind="gaussian_process")
    return list(
        dict.fromkeys(["polynomial", *map(surface_name, study.surfaces), surface_name(process)])
    )
