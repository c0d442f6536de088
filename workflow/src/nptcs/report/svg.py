"""Figures as SVG for the page: compact, with real text, in colours that follow the page's mode.

Matplotlib's SVG comes in; the same picture goes out without groups and ids that nothing refers to,
with thinned paths, with shared attributes written once, and with CSS variables for its colours.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import groupby
from xml.etree import ElementTree

import numpy as np
from markupsafe import escape

from nptcs.report.figures.theme import LIGHT
from nptcs.report.svg_path import Stroke, extent, extent_of, read_path, short, thinned, write_path

FONTS = "Verdana,'DejaVu Sans',Geneva,sans-serif"
"""Fonts of the width that the layout was made for; every system has one of them."""

ROOM = 'xmlns="http://www.w3.org/2000/svg"'
VARIABLES = {colour: name for name, colour in LIGHT.items()}
DEFAULTS = {
    "fill": "none",
    "stroke-linejoin": "round",
    "stroke-linecap": "butt",
    "stroke-dashoffset": "0",
    "text-anchor": "start",
    "opacity": "1",
}
TURN = re.compile(r"rotate\((-?[\d.]+)")
MOVE = re.compile(r"translate\((-?[\d.]+)[ ,]+(-?[\d.]+)\)")
LEAVES = ("path", "use", "text")


@dataclass(frozen=True)
class Leaf:
    """One thing that is drawn.

    Parameters
    ----------
    tag : {"path", "use", "text"}
    look : tuple of (str, str)
        Attributes that it shares with others of the same look.
    place : str
        Its own attributes, as they are written.
    words : str
        Content of a text.
    axis : str
        Id of the axis to which it belongs; within an axis the order does not matter.
    strokes : tuple of Stroke
        Strokes of a path.
    """

    tag: str
    look: tuple[tuple[str, str], ...]
    place: str = ""
    words: str = ""
    axis: str = ""
    strokes: tuple[Stroke, ...] = ()


def compact(svg: str) -> str:
    """Write Matplotlib's SVG for the page.

    Parameters
    ----------
    svg : str
        As `nptcs.report.figures.style.to_svg` returns it.
    """
    root = ElementTree.fromstring(svg)
    for element in root.iter():
        element.tag = element.tag.rsplit("}", 1)[-1]
    ids = {
        element.get("id", ""): element
        for element in root.iter()
        if element.tag in ("path", "clipPath", "pattern") and element.get("id")
    }
    leaves = list(_sorted_axes(list(_leaves(root, {}, "", ids))))
    body = "".join(
        _run(look, list(run)) for look, run in groupby(leaves, key=lambda leaf: leaf.look)
    )
    used = [name for name in ids if f"#{name}" in body]
    definitions = "".join(_definition(name, ids[name]) for name in used)
    text = (f"<defs>{definitions}</defs>" if definitions else "") + body
    mark = hashlib.sha256(text.encode()).hexdigest()[:5]
    for number, name in enumerate(used):
        text = text.replace(f"#{name}", f"#f{mark}{number}")
        text = text.replace(f'id="{name}"', f'id="f{mark}{number}"')
    width, height = (float(size) for size in root.get("viewBox", "0 0 0 0").split()[2:])
    size = f'width="{width * 96 / 72:.0f}" height="{height * 96 / 72:.0f}"'
    return (
        f'<svg {ROOM} {size} viewBox="0 0 {width:g} {height:g}" fill="none" '
        f'stroke-linejoin="round" font-family="{FONTS}">{text}</svg>'
    )


def _leaves(
    parent: ElementTree.Element,
    inherited: dict[str, str],
    axis: str,
    ids: dict[str, ElementTree.Element],
) -> Iterator[Leaf]:
    """List what is drawn, in order, each with all that it inherits."""
    for element in parent:
        if element.tag == "defs":
            continue
        look = inherited | _look(element)
        if element.tag == "g":
            name = element.get("id", "")
            inside = f"{axis}{name}" if name.startswith("matplotlib.axis") else axis
            yield from _leaves(element, look, inside, ids)
        elif element.tag in LEAVES:
            yield from _leaf(element, look, axis, ids)


def _look(element: ElementTree.Element) -> dict[str, str]:
    """Read style and clip path of an element."""
    look = {name: value for name in ("fill", "stroke") if (value := element.get(name))}
    look.update(_style(element.get("style", "")))
    if clip := element.get("clip-path"):
        look["clip-path"] = clip
    return look


@lru_cache(maxsize=1000)
def _style(text: str) -> tuple[tuple[str, str], ...]:
    """Read the attribute ``style``, which the marks of a line share."""
    parts = (part.partition(":") for part in text.split(";"))
    return tuple((name.strip(), value.strip()) for name, _, value in parts if value.strip())


def _leaf(
    element: ElementTree.Element,
    look: dict[str, str],
    axis: str,
    ids: dict[str, ElementTree.Element],
) -> Iterator[Leaf]:
    if element.tag == "text":
        yield _text(element, look, axis)
        return
    drawn = element
    if element.tag == "use":
        name = next(value for key, value in element.attrib.items() if key.endswith("href"))
        drawn = ids[name.removeprefix("#")]
        look = look | _look(drawn)
    x, y = (round(100 * float(element.get(name, 0))) for name in ("x", "y"))
    strokes = read_path(drawn.get("d", ""))
    if not strokes or look.get("fill") == look.get("stroke", "none") == "none":
        return
    if element.tag == "use" and sum(len(stroke.commands) for stroke in strokes) > 2:
        (left, top), (right, bottom) = extent_of(drawn.get("d", ""))
        low, high = (100 * left + x, 100 * top + y), (100 * right + x, 100 * bottom + y)
        look = _unclipped(look, ids, low, high)
        place = f'href="{name}" x="{short(x)}" y="{short(y)}"'
        yield Leaf("use", _attributes(look), place, axis=axis)
        return
    moved = strokes
    if x or y:
        shift = np.array([x / 100, y / 100])
        moved = tuple(
            replace(stroke, points=tuple(points + shift for points in stroke.points))
            for stroke in strokes
        )
    low, high = (tuple(100 * end for end in ends) for ends in extent(moved))
    look = _unclipped(look, ids, low, high)
    yield Leaf("path", _attributes(look), axis=axis, strokes=tuple(map(thinned, moved)))


def _unclipped(
    look: dict[str, str],
    ids: dict[str, ElementTree.Element],
    low: Sequence[float],
    high: Sequence[float],
) -> dict[str, str]:
    """Leave out a clip path that clips nothing off; places are in hundredths of a point."""
    name = look.get("clip-path", "")[5:-1]
    box = ids[name].find("rect") if name in ids else None
    if box is None:
        return look
    start = [100 * float(box.get(side, 0)) for side in ("x", "y")]
    size = [100 * float(box.get(side, 0)) for side in ("width", "height")]
    inside = all(
        at - 100 <= least and most <= at + length + 100
        for at, length, least, most in zip(start, size, low, high, strict=True)
    )
    return {key: value for key, value in look.items() if key != "clip-path"} if inside else look


def _text(element: ElementTree.Element, look: dict[str, str], axis: str) -> Leaf:
    """Write a text with its place and its rotation, if any."""
    transform = element.get("transform", "")
    moved = MOVE.search(transform)
    at = moved.groups() if moved else (element.get("x", "0"), element.get("y", "0"))
    x, y = (short(round(100 * float(number))) for number in at)
    place = f'x="{x}" y="{y}"'
    turned = TURN.search(transform)
    if turned and float(turned.group(1)):
        place += f' transform="rotate({float(turned.group(1)):g} {x} {y})"'
    size = look.get("font-size") or re.search(r"[\d.]+px", look.get("font", "10px")).group()  # type: ignore[union-attr]
    bold = "bold" in look.get("font", "") or look.get("font-weight", "") in ("bold", "700")
    kept = {
        "fill": look.get("fill", "#000000"),
        "font-size": size.removesuffix("px"),
        "text-anchor": look.get("text-anchor", "start"),
        "opacity": look.get("opacity", "1"),
        **({"font-weight": "bold"} if bold else {}),
    }
    words = "".join(element.itertext())
    return Leaf("text", _attributes(kept), place, words, axis)


def _attributes(look: dict[str, str]) -> tuple[tuple[str, str], ...]:
    """Write a look as attributes, with the variables of the page as colours."""
    return _written_look(tuple(look.items()))


@lru_cache(maxsize=1000)
def _written_look(look: tuple[tuple[str, str], ...]) -> tuple[tuple[str, str], ...]:
    full = {"fill": "#000000", **dict(look)}
    if full.get("stroke", "none") == "none":
        full = {name: value for name, value in full.items() if not name.startswith("stroke")}
    found = []
    for name, value in full.items():
        if value == DEFAULTS.get(name):
            continue
        if name in ("fill", "stroke") and value.lower() in VARIABLES:
            value = f"var({VARIABLES[value.lower()]})"
        elif name == "stroke-dasharray":
            value = " ".join(f"{float(part):.3g}" for part in value.split(","))
        elif name in ("stroke-width", "opacity", "fill-opacity", "stroke-opacity"):
            value = f"{float(value):.3g}".removeprefix("0") or "0"
        if value not in ("1",) or name not in ("stroke-width",):
            found.append((name, value))
    return tuple(sorted(found))


def _sorted_axes(leaves: list[Leaf]) -> Iterator[Leaf]:
    """Group what looks the same within each axis."""
    for axis, run in groupby(leaves, key=lambda leaf: leaf.axis):
        group = list(run)
        if not axis:
            yield from group
            continue
        looks = list(dict.fromkeys((leaf.tag, leaf.look) for leaf in group))
        yield from sorted(group, key=lambda leaf: looks.index((leaf.tag, leaf.look)))


def _run(look: tuple[tuple[str, str], ...], run: list[Leaf]) -> str:
    """Write neighbours of the same look, their attributes once."""
    attributes = "".join(f' {name}="{value}"' for name, value in look)
    whole = [leaf.strokes for leaf in run if leaf.tag == "path"]
    if run[0].axis and len(whole) == len(run):
        joined = [stroke for strokes in whole for stroke in strokes]
        return f'<path{attributes} d="{write_path(joined)}"/>'
    if len(run) == 1:
        return _element(run[0], attributes)
    return f"<g{attributes}>{''.join(_element(leaf, '') for leaf in run)}</g>"


def _element(leaf: Leaf, attributes: str) -> str:
    written = {
        "text": f"<text{attributes} {leaf.place}>{escape(leaf.words)}</text>",
        "use": f"<use{attributes} {leaf.place}/>",
        "path": f'<path{attributes} d="{write_path(leaf.strokes)}"/>',
    }
    return written[leaf.tag]


def _definition(name: str, element: ElementTree.Element) -> str:
    """Write a marker, a clip path or a hatch."""
    if element.tag == "path":
        return f'<path id="{name}" d="{write_path(read_path(element.get("d", "")))}"/>'
    attributes = "".join(f' {key}="{_rounded(value)}"' for key, value in element.attrib.items())
    inside = "".join(_inside(part) for part in element)
    return f"<{element.tag}{attributes}>{inside}</{element.tag}>"


def _inside(part: ElementTree.Element) -> str:
    """Write what a clip path or a hatch consists of."""
    look = "".join(f' {name}="{value}"' for name, value in _attributes(_look(part)))
    if part.tag == "path":
        return f'<path{look} d="{write_path(read_path(part.get("d", "")))}"/>'
    sizes = "".join(
        f' {key}="{_rounded(part.get(key, "0"))}"' for key in ("x", "y", "width", "height")
    )
    return f"<{part.tag}{look}{sizes}/>"


def _rounded(value: str) -> str:
    try:
        return f"{float(value):.2f}".rstrip("0").rstrip(".")
    except ValueError:
        return value
