import pytest

PLY = {
    "e1_mpa": 128000.0,
    "e2_mpa": 8800.0,
    "e3_mpa": 8800.0,
    "nu12": 0.357,
    "nu13": 0.357,
    "nu23": 0.35,
    "g12_mpa": 3147.0,
    "g13_mpa": 3147.0,
    "g23_mpa": 2300.0,
}


@pytest.fixture(scope="session")
def ply():
    """Table 2 of the paper."""
    return dict(PLY)
