import pytest

from nptcs.fe.calibration import PUBLISHED_PLY


@pytest.fixture(scope="session")
def published_ply():
    """Table 2 of the paper."""
    return dict(PUBLISHED_PLY)


@pytest.fixture
def ply(published_ply):
    """Give a copy that a test may change."""
    return dict(published_ply)
