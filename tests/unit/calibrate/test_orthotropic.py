import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nptcs.calibrate.orthotropic import check_ply, compliance_matrix
from nptcs.errors import InputError
from nptcs.tables.laboratory.material_card import PUBLISHED_PLY


def test_table_2_is_orthotropic_and_says_so() -> None:
    checks = check_ply(PUBLISHED_PLY, "cfrp", 5.0)
    assert checks[0] == "compliance matrix is positive definite"
    # E2/(2(1+ν23)) = 3259
    assert "not transversely isotropic: G23 = 2300 MPa, E2/(2(1+nu23)) = 3259" in checks[1]
    isotropic = PUBLISHED_PLY | {"g23_mpa": 8800 / 2.7}
    assert "transversely isotropic within 5 %" in check_ply(isotropic, "cfrp", 5.0)[1]
    unequal = isotropic | {"e3_mpa": 9000.0}
    assert "e2_mpa is not e3_mpa" in check_ply(unequal, "cfrp", 5.0)[1]


def test_isotropic_limit_of_the_compliance() -> None:
    e, nu = 70000.0, 0.3
    g = e / (2 * (1 + nu))
    values = {f"e{i}_mpa": e for i in (1, 2, 3)}
    values |= {f"nu{i}": nu for i in (12, 13, 23)} | {f"g{i}_mpa": g for i in (12, 13, 23)}
    stiffness = np.linalg.inv(compliance_matrix(values))
    lame = e * nu / ((1 + nu) * (1 - 2 * nu))
    expected = np.full((3, 3), lame) + 2 * g * np.eye(3)
    assert stiffness[:3, :3] == pytest.approx(expected)
    assert np.diag(stiffness)[3:] == pytest.approx(g)


@settings(deadline=None)
@given(nu12=st.floats(-5.0, 5.0), nu23=st.floats(-1.2, 1.2))
def test_refused_exactly_where_the_textbook_inequalities_fail(nu12: float, nu23: float) -> None:
    # Jones, Mechanics of Composite Materials, 2.4: |ν_ij| < √(E_i/E_j) and
    # 1 - ν12 ν21 - ν23 ν32 - ν31 ν13 - 2 ν21 ν32 ν13 > 0
    values = PUBLISHED_PLY | {"nu12": nu12, "nu13": nu12, "nu23": nu23}
    nu21 = nu12 * 8800 / 128000
    determinant = 1 - 2 * nu12 * nu21 - nu23**2 - 2 * nu21 * nu23 * nu12
    minors = min(1 - nu12 * nu21, 1 - nu23**2)
    if min(determinant, minors) > 1e-6:
        assert check_ply(values, "cfrp", 5.0)
    elif min(determinant, minors) < -1e-6:
        with pytest.raises(InputError, match="not positive definite"):
            check_ply(values, "cfrp", 5.0)


def test_negative_modulus_is_named() -> None:
    with pytest.raises(InputError, match=r"column 'g12_mpa': material cfrp: g12_mpa must be"):
        check_ply(PUBLISHED_PLY | {"g12_mpa": -1.0}, "cfrp", 5.0)
