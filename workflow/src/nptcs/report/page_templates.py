"""The templates of the page: the package's, or a laboratory's own in their place.

A file of the same name in the folder ``report.templates`` is taken instead of the package's;
templates that the folder does not have are the package's. A file may build on the original:
``{% extends "nptcs/report.html.j2" %}`` or ``{% include "nptcs/cover.html.j2" %}``.
"""

from __future__ import annotations

import traceback
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from jinja2 import (
    BaseLoader,
    ChoiceLoader,
    Environment,
    FileSystemLoader,
    PackageLoader,
    PrefixLoader,
    StrictUndefined,
    TemplateError,
    TemplateNotFound,
    TemplateSyntaxError,
)
from jinja2.meta import find_referenced_templates

from nptcs.errors import InputError
from nptcs.files import files_below
from nptcs.language import tr, tr_count
from nptcs.report.blocks import macro_of
from nptcs.report.kept_together import kept

KEY = "report.templates"
PACKAGE = "nptcs"
"""Prefix of the package's own templates, for templates that build on them."""


def page_environment(folder: str | None = None) -> Environment:
    """Return the environment in which the page is rendered.

    Parameters
    ----------
    folder : str or None
        A laboratory's own templates.
    """
    own = PackageLoader("nptcs.report")
    loaders: list[BaseLoader] = [own, PrefixLoader({PACKAGE: own})]
    if folder is not None:
        loaders.insert(0, FileSystemLoader(folder))
    environment = Environment(
        loader=ChoiceLoader(loaders),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["kept"] = kept
    environment.globals |= {"tr": tr, "tr_count": tr_count, "macro_of": macro_of}
    return environment


def template_faults(folder: str | None) -> list[InputError]:
    """Find what makes a laboratory's own templates unusable, without rendering them.

    Returns
    -------
    list of InputError
        For a folder that does not exist, a template that cannot be read (with its line), and one
        that neither has the name of a template of the package nor is included by another.
    """
    if folder is None:
        return []
    if not Path(folder).is_dir():
        return [InputError("this folder does not exist", f"correct the key {KEY}", folder)]
    environment = page_environment(folder)
    faults, referred = [], set(PackageLoader("nptcs.report").list_templates())
    known = sorted(referred)
    for path in files_below(folder):
        try:
            tree = environment.parse(path.read_text(encoding="utf-8"), filename=str(path))
            referred |= {name for name in find_referenced_templates(tree) if name}
        except UnicodeDecodeError:
            faults.append(InputError("this template is not UTF-8", "save it as UTF-8", path))
        except TemplateSyntaxError as error:
            faults.append(_broken(str(error.message), path, error.lineno))
    for path in files_below(folder):
        name = path.relative_to(folder).as_posix()
        if name not in referred:
            remedy = f"name it as one of: {', '.join(known)}"
            faults.append(InputError("no template of the report has this name", remedy, path))
    return faults


@contextmanager
def clear_template_errors(folder: str | None) -> Iterator[None]:
    """Report errors in a laboratory's own template with its file and line.

    Raises
    ------
    InputError
    """
    try:
        yield
    except TemplateSyntaxError as error:
        if not _own(error.filename, folder):
            raise
        raise _broken(str(error.message), Path(str(error.filename)), error.lineno) from error
    except (TemplateError, TypeError, ValueError, KeyError, AttributeError) as error:
        frames = [f for f in traceback.extract_tb(error.__traceback__) if _own(f.filename, folder)]
        if not frames:
            raise
        missing = isinstance(error, TemplateNotFound)
        text = f"there is no template {error}" if missing else str(error)
        raise _broken(text, Path(frames[-1].filename), frames[-1].lineno) from error


def _own(filename: str | None, folder: str | None) -> bool:
    """Tell whether a file is one of a laboratory's own templates."""
    if folder is None or filename is None:
        return False
    return Path(filename).absolute().is_relative_to(Path(folder).absolute())


def _broken(message: str, path: Path, line: int | None) -> InputError:
    remedy = "correct this template, or remove it: the package's own is then used"
    return InputError(f"this template cannot be used: {message}", remedy, path, line)
