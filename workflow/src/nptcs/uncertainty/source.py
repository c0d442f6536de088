"""What predictions of a study are based on: its cases, materials, surfaces and settings."""

from __future__ import annotations

from dataclasses import dataclass

from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.config.studies.goals import ResponseName
from nptcs.config.studies.uncertainty import Uncertainty
from nptcs.surface.registry import SurfaceRegistry
from nptcs.tables.laboratory.material_card import MaterialCard, PlyCard
from nptcs.uncertainty.answering_surface import answering_surface
from nptcs.uncertainty.fitted import FittedResponse, fit_response
from nptcs.uncertainty.inputs import Inputs, uncertain_inputs
from nptcs.uncertainty.study_results import StudyResults


@dataclass(frozen=True)
class Materials:
    """What is known about the materials.

    Parameters
    ----------
    card : MaterialCard
    ply : PlyCard or None
        Ply of the study's plates; None where the solver does not use one.
    """

    card: MaterialCard
    ply: PlyCard | None


@dataclass(frozen=True)
class Source:
    """What the predictions of a study and solver are based on.

    Parameters
    ----------
    results : StudyResults
        Results of the study by the solver.
    rubbers : StudyResults or None
        Results of the study that varies the rubbers, by the same solver.
    registry : SurfaceRegistry or None
        Stored surfaces of the study.
    materials : Materials
    tyre : TyreGeometry
    whole_plates : bool
        Whether the solver uses a whole number of plates.
    settings : Uncertainty
    """

    results: StudyResults
    rubbers: StudyResults | None
    registry: SurfaceRegistry | None
    materials: Materials
    tyre: TyreGeometry
    whole_plates: bool
    settings: Uncertainty

    def fit(self, response: ResponseName, surface: str | None = None) -> FittedResponse:
        """Return the model of a response, through the named surface or `answering_surface`."""
        study, solver = self.results.study, self.results.solver
        name = answering_surface(surface, self.settings.surface, study, solver, self.registry)
        ply = self.materials.ply.values() if self.materials.ply is not None else None
        return fit_response(
            self.results, response, name, self.tyre, ply, self.rubbers, self.registry
        )

    def inputs(self) -> Inputs:
        """List what is uncertain about any design of the study."""
        solved = self.results.solved
        names = [*self.results.factors, *self.results.study.fixed]
        values = {name: float(solved[name].iloc[0]) for name in names}
        return uncertain_inputs(
            self.settings, self.materials.card, self.materials.ply, values, self.results.factors
        )
