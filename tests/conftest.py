"""Settings of all tests."""

from hypothesis import HealthCheck, settings

# no test may fail because the machine is slow
settings.register_profile("nptcs", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("nptcs")
