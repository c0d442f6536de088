"""A laboratory's logo: checked, and as a data URI, so that the page needs no other file."""

from __future__ import annotations

import base64
import io
from pathlib import Path
from xml.etree import ElementTree

from nptcs.errors import InputError

LARGEST_BYTES = 500_000
KEY = "laboratory.logo"


def logo_uri(path: str | Path) -> str:
    """Return a logo as a data URI.

    Parameters
    ----------
    path : str or Path
        PNG or SVG file.

    Raises
    ------
    InputError
        If it does not exist, is larger than `LARGEST_BYTES`, is damaged, is of another type, or is
        an SVG that needs other files or contains a script.
    """
    path = Path(path)
    if not path.is_file():
        raise InputError("this logo does not exist", f"correct the key {KEY}", path)
    size = path.stat().st_size
    if size > LARGEST_BYTES:
        raise InputError(
            f"this logo has {size:,} bytes, more than {LARGEST_BYTES:,}",
            "save it smaller, 600 pixels wide for example",
            path,
        )
    content = path.read_bytes()
    if content.startswith(b"\x89PNG"):
        _check_png(content, path)
        kind = "image/png"
    else:
        _check_svg(content, path)
        kind = "image/svg+xml"
    return f"data:{kind};base64,{base64.b64encode(content).decode('ascii')}"


def _check_png(content: bytes, path: Path) -> None:
    from PIL import Image

    try:
        with Image.open(io.BytesIO(content), formats=("PNG",)) as image:
            image.load()
    except (OSError, SyntaxError, ValueError, Image.DecompressionBombError) as error:
        raise InputError(f"this PNG is damaged: {error}", "export it again", path) from None


def _check_svg(content: bytes, path: Path) -> None:
    if b"<!ENTITY" in content:
        raise InputError("this SVG declares entities", "export it as plain SVG", path)
    try:
        root = ElementTree.fromstring(content)
    except ElementTree.ParseError:
        root = None
    if root is None or _local(root.tag) != "svg":
        raise InputError("this logo is neither PNG nor SVG", "save it as one of these", path)
    for element in root.iter():
        if _local(element.tag) in ("script", "foreignObject"):
            raise InputError(
                f"this SVG contains an element <{_local(element.tag)}>",
                "export it as plain SVG",
                path,
            )
        for name, value in element.attrib.items():
            if _local(name) == "href" and not value.startswith(("#", "data:")):
                raise InputError(
                    "this SVG needs another file, which the report does not have",
                    "embed its images before exporting",
                    path,
                    value=value,
                )


def _local(name: str) -> str:
    """Return an XML name without its namespace."""
    return str(name).rpartition("}")[2]
