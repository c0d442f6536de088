"""The names and numbers that an Abaqus deck uses and does not define."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

Deck = Any  # of abaqus_deck.py, which this file does not load a second time
Part = Any


def undefined(deck: Deck) -> list[str]:
    """Say what each keyword uses that the deck does not define; nothing for a complete deck."""
    materials = {block.parameters["NAME"] for block in deck.named("MATERIAL")}
    found = [
        f"part {name}: {fault}"
        for name, part in deck.parts.items()
        for fault in [*_members(part), *_sections(part, materials), *_rigid(part)]
    ]
    return found + [*_assembly(deck), *_contact(deck), *_steps(deck)]


def _lacking(keyword: str, what: str, used: Iterable[object], known: Iterable[object]) -> list[str]:
    return [f"*{keyword}: no {what} {name}" for name in sorted(set(used) - set(known), key=str)]


def _members(part: Part) -> Iterator[str]:
    """Nodes of elements, members of sets, sets of surfaces."""
    nodes, elements = part.positions, part.elements
    yield from _lacking("ELEMENT", "node", (n for _, of in elements.values() for n in of), nodes)
    for keyword, sets, known in (
        ("NSET", part.node_sets, nodes),
        ("ELSET", part.element_sets, elements),
    ):
        for name, labels in sets.items():
            if not labels:
                yield f"*{keyword}: {name} is empty"
            yield from _lacking(f"{keyword}, {name}", "member", labels, known)
    for block in part.surfaces.values():
        if block.parameters["TYPE"] == "ELEMENT":
            rows = (row[0] for row in block.data)
            yield from _lacking("SURFACE", "element set", rows, part.element_sets)


def _sections(part: Part, materials: set[str]) -> Iterator[str]:
    """Sets, orientations and materials of sections; the elements that have none or several."""
    orientations = {block.parameters["NAME"] for block in part.named("ORIENTATION")}
    kinds = ("SOLID SECTION", "SHELL SECTION", "SURFACE SECTION")
    sets = [block.parameters["ELSET"] for kind in kinds for block in part.named(kind)]
    yield from _lacking("SECTION", "element set", sets, part.element_sets)
    labels = [label for name in sets for label in part.element_sets.get(name, [])]
    if sorted(labels) != sorted(part.elements):
        yield "not each element has one section"
    for block in part.named("SOLID SECTION"):
        yield from _lacking("SOLID SECTION", "material", [block.parameters["MATERIAL"]], materials)
    for keyword, column in (("SHELL SECTION", 2), ("REBAR LAYER", 4)):
        for block in part.named(keyword):
            used = [block.parameters["ORIENTATION"]]
            yield from _lacking(keyword, "orientation", used, orientations)
            yield from _lacking(keyword, "material", (row[column] for row in block.data), materials)


def _rigid(part: Part) -> Iterator[str]:
    for block in part.named("RIGID BODY"):
        reference, surface = block.parameters["REF NODE"], block.parameters["ANALYTICAL SURFACE"]
        yield from _lacking("RIGID BODY", "node set", [reference], part.node_sets)
        yield from _lacking("RIGID BODY", "surface", [surface], part.surfaces)


def _assembly(deck: Deck) -> Iterator[str]:
    for name, members in deck.assembly.node_sets.items():
        for member in members:
            owner, label = member if isinstance(member, tuple) else (None, member)
            holder = deck.assembly if owner is None else _part(deck, owner)
            if holder is None or label not in holder.positions:
                yield f"*NSET, {name}: no member {member}"
    for block in deck.assembly.named("TIE"):
        yield from _unresolved(deck, block, "surfaces", _names(block))
    for block in deck.assembly.named("EMBEDDED ELEMENT"):
        names = [block.parameters["HOST ELSET"], *_names(block)]
        yield from _unresolved(deck, block, "element_sets", names)
    for block in deck.assembly.named("RIGID BODY"):
        names = [block.parameters["REF NODE"], block.parameters["PIN NSET"]]
        yield from _unresolved(deck, block, "node_sets", names)


def _contact(deck: Deck) -> Iterator[str]:
    interactions = {block.parameters["NAME"] for block in deck.named("SURFACE INTERACTION")}
    for block in deck.named("CONTACT PAIR"):
        used = [block.parameters["INTERACTION"]]
        yield from _lacking("CONTACT PAIR", "surface interaction", used, interactions)
        yield from _unresolved(deck, block, "surfaces", _names(block))


def _steps(deck: Deck) -> Iterator[str]:
    """Node sets of supports, loads and output; amplitudes of loads."""
    amplitudes = {block.parameters["NAME"] for block in deck.named("AMPLITUDE")}
    for block in deck.named("BOUNDARY") + deck.named("CLOAD"):
        yield from _unresolved(deck, block, "node_sets", [row[0] for row in block.data])
    for block in deck.named("CLOAD"):
        yield from _lacking("CLOAD", "amplitude", [block.parameters["AMPLITUDE"]], amplitudes)
    for block in deck.named("NODE PRINT") + deck.named("NODE OUTPUT"):
        if "NSET" in block.parameters:
            yield from _unresolved(deck, block, "node_sets", [block.parameters["NSET"]])


def _names(block: Any) -> list[str]:
    return [name for row in block.data for name in row]


def _unresolved(deck: Deck, block: Any, kind: str, names: Iterable[str]) -> Iterator[str]:
    """Names of sets or surfaces, ``SET`` of the assembly or ``INSTANCE.SET``, without members."""
    for name in names:
        owner, _, own = name.rpartition(".")
        part = _part(deck, owner) if owner else deck.assembly
        if part is None or not getattr(part, kind).get(own):
            yield f"*{block.keyword}: no {kind[:-1].replace('_', ' ')} {name}"


def _part(deck: Deck, instance: str) -> Part | None:
    found = deck.instances.get(instance)
    return None if found is None else found.part
