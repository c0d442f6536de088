"""The map of rooms in CONTRIBUTING is that of the imports: no circle, nothing left out."""

import ast
import re
from pathlib import Path

ROOT = Path(__file__).parents[3]
PACKAGE = ROOT / "workflow" / "src" / "nptcs"
ROW = re.compile(r"^\| (`[^|]*`) \|[^|]*\|([^|]*)\|$", re.MULTILINE)
EVERYWHERE = {"errors", "files", "arrays", "__version__"}
"""What every room may import."""


def read_map():
    """Return what each room of the map rests on, directly or not."""
    text = (ROOT / "CONTRIBUTING.md").read_text("utf-8")
    direct = {}
    for rooms, needs in ROW.findall(text):
        above = set(direct) if "all of the above" in needs else set()
        for room in re.findall(r"`(\w+)`", rooms):
            direct[room] = above | set(re.findall(r"`(\w+)`", needs))
    return {room: closure(room, direct) for room in direct}


def closure(room, direct):
    found, waiting = set(), list(direct[room])
    while waiting:
        found.add(name := waiting.pop())
        waiting += direct.get(name, set()) - found
    return found


def imports():
    """Return the rooms that the modules of each room import."""
    found = {}
    for file in PACKAGE.rglob("*.py"):
        room = file.relative_to(PACKAGE).parts[0].removesuffix(".py")
        for node in ast.walk(ast.parse(file.read_text("utf-8"))):
            names = []
            if isinstance(node, ast.ImportFrom) and node.module == "nptcs":
                names = [alias.name for alias in node.names]
            elif isinstance(node, ast.ImportFrom) and (node.module or "").startswith("nptcs."):
                names = [node.module.split(".")[1]]
            elif isinstance(node, ast.Import):
                names = [a.name.split(".")[1] for a in node.names if a.name.startswith("nptcs.")]
            found.setdefault(room, set()).update(set(names) - {room})
    return found


def test_the_map_has_no_circle():
    assert [room for room, needs in read_map().items() if room in needs] == []


def test_every_import_between_rooms_is_on_the_map():
    rooms = read_map()
    stray = {
        (room, needed)
        for room, names in imports().items()
        if room in rooms
        for needed in names - EVERYWHERE - rooms[room]
    }
    assert stray == set()


def test_every_room_is_on_the_map():
    folders = {file.parent.name for file in PACKAGE.glob("*/__init__.py")}
    assert folders - set(read_map()) == set()
