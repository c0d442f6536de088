"""A laboratory's own files for the report, checked before a run begins."""

from __future__ import annotations

from nptcs.config.root import Config
from nptcs.errors import InputError
from nptcs.report.logo import logo_uri
from nptcs.report.page_templates import template_faults


def page_faults(config: Config) -> list[InputError]:
    """Find what would keep the report from being written: a bad logo, a broken template."""
    faults = template_faults(config.report.templates)
    if config.laboratory.logo:
        try:
            logo_uri(config.laboratory.logo)
        except InputError as error:
            faults.append(error)
    return faults
