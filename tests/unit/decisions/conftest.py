"""Made-up results of a plate study whose stiffness and mass are known in closed form."""

import numpy as np
import pandas as pd
import pytest

from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.config.studies.study import Study
from nptcs.config.studies.uncertainty import Uncertainty
from nptcs.tables.laboratory.material_card import MaterialCard
from nptcs.uncertainty.source import Materials, Source
from nptcs.uncertainty.study_results import results_of

FACTORS = ["spacing_mm", "thickness_mm", "angle_deg"]
WIDTH = TyreGeometry().tread_width_mm
KG_PER_PLATE_AND_MM = 0.0337


def plates(spacing):
    return np.array([TyreGeometry().plates_across(one) for one in spacing])


def stiffness(spacing, thickness, angle):
    """Softer with the pitch, stiffer with the thickness, softer with the angle; N/mm."""
    return 400 - 9 * WIDTH / plates(spacing) + 15 * thickness - 0.2 * angle - 4e-4 * angle**2


def values(case_id, spacing, thickness, angle, stress=1.0):
    """The rows of one solved design: case, responses, curve."""
    k = float(stiffness([spacing], thickness, angle)[0])
    about = {"study": "plate", "case_id": case_id, "solver": "fe_tyre_paper"}
    pitch = WIDTH / plates([spacing])[0]
    case = {
        **about,
        "status": "ok",
        "message": "",
        "spacing_mm": spacing,
        "thickness_mm": thickness,
        "angle_deg": angle,
        "shear_band_c10_mpa": 5.0,
        "load_n": 5000.0,
        "realised_spacing_mm": pitch,
        "vertical_stiffness_n_per_mm": k,
        "displacement_mm": 5000 / k,
        "wall_time_s": 1.0,
        "solver_version": "1",
        "key": case_id,
    }
    load = np.linspace(0, 5000, 11)
    curve = pd.DataFrame({**about, "displacement_mm": load / k, "force_n": load})
    mass = KG_PER_PLATE_AND_MM * plates([spacing])[0] * thickness
    mises = stress * (150 - 40 * thickness + 0.1 * angle)
    responses = pd.DataFrame(
        [
            {**about, "load_n": 5000.0, "response": n, "at": at, "value": v, "unit": u}
            for n, at, v, u in (
                ("plate_mass", "", mass, "kg"),
                ("plate_largest_mises", "5000 N", mises, "MPa"),
            )
        ]
    ).assign(status="ok", note="")
    return case, responses, curve


@pytest.fixture(scope="session")
def study():
    levels = {"spacing_mm": [10, 15, 20], "thickness_mm": [1.2, 1.8, 2.4], "angle_deg": [0, 45, 90]}
    factors = [
        {"name": name, "label": name, "unit": "", "levels": given} for name, given in levels.items()
    ]
    return Study.model_validate(
        {
            "name": "plate",
            "title": "Plates",
            "factors": factors,
            "fixed": {"shear_band_c10_mpa": 5},
            "solvers": ["fe_tyre_paper"],
            "terms": ["1", *FACTORS, "angle_deg^2", "spacing_mm^2"],
        }
    )


@pytest.fixture(scope="session")
def tables():
    designs = [
        (s, t, a) for s in (10.0, 15.0, 20.0) for t in (1.2, 1.8, 2.4) for a in (0.0, 45.0, 90.0)
    ]
    rows = [values(f"plate_{n + 1:03d}", *design) for n, design in enumerate(designs)]
    cases, responses, curves = zip(*rows, strict=True)
    return pd.DataFrame(list(cases)), pd.concat(responses), pd.concat(curves)


@pytest.fixture(scope="session")
def source(study, tables):
    settings = Uncertainty(
        tolerances={"thickness_mm": {"sd": 0.05}, "angle_deg": {"sd": 1.0}}, samples=1024
    )
    return Source(
        results=results_of(study, "fe_tyre_paper", *tables),
        rubbers=None,
        registry=None,
        materials=Materials(MaterialCard(plies={}, rubbers={}), None),
        tyre=TyreGeometry(),
        whole_plates=True,
        settings=settings,
    )


@pytest.fixture(scope="session")
def solved_design():
    return values
