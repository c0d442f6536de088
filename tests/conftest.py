"""Settings of all tests."""

import os

from hypothesis import HealthCheck, settings

# tests type commands as a user does, even when `make` starts the tests
os.environ.pop("MAKELEVEL", None)

# no test may fail because the machine is slow
settings.register_profile("nptcs", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("nptcs")
