"""The map of rooms in CONTRIBUTING names every room, and what each one imports."""

import re
from pathlib import Path

import grimp

ROOT = Path(__file__).parents[3]
ROW = re.compile(r"^\| (`[^|]*`) \|[^|]*\|([^|]*)\|$", re.MULTILINE)
EVERYWHERE = {
    "arguments",
    "arrays",
    "bending",
    "console",
    "errors",
    "files",
    "language",
    "laminate",
    "likelihood",
    "loading",
    "machine_code",
    "mechanical_tests",
    "provenance",
    "ranges",
    "seal",
    "spoke_features",
    "terms",
    "text_table",
    "threads",
    "yaml_files",
}
"""Modules at the bottom, which every room may import."""


def read_map():
    """Return what each room of the map depends on, directly or indirectly."""
    rests_on = {}
    for rooms, needs in ROW.findall((ROOT / "CONTRIBUTING.md").read_text("utf-8")):
        named = set(re.findall(r"`(\w+)`", needs))
        direct = set(rests_on) if "all of the above" in needs else named
        below = set().union(*(rests_on[room] for room in direct))
        rests_on |= dict.fromkeys(re.findall(r"`(\w+)`", rooms), direct | below)
    return rests_on


def test_the_map_names_every_room_and_what_it_imports():
    graph, rests_on = grimp.build_graph("nptcs"), read_map()
    imported = {
        room: {
            target.split(".")[1]
            for module in graph.find_descendants(f"nptcs.{room}") | {f"nptcs.{room}"}
            for target in graph.find_modules_directly_imported_by(module)
            if "." in target
        }
        for room in (child.split(".")[1] for child in graph.find_children("nptcs"))
        if room not in EVERYWHERE
    }
    assert imported.keys() == rests_on.keys()
    stray = {room: names - EVERYWHERE - {room} - rests_on[room] for room, names in imported.items()}
    assert {room: names for room, names in stray.items() if names} == {}
