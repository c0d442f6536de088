"""A small reader of Abaqus decks for the tests, independent of the code that writes them.

It flattens parts and instances into one model, and refuses keywords at a level where Abaqus does
not accept them.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

# keyword: levels at which the Abaqus Keywords Reference Guide allows it
PART = {"part", "instance"}
ANYWHERE = PART | {"assembly"}
LEVELS = {
    "HEADING": {"model"},
    "PREPRINT": {"model"},
    "PART": {"model"},
    "END PART": {"part"},
    "ASSEMBLY": {"model"},
    "END ASSEMBLY": {"assembly"},
    "INSTANCE": {"assembly"},
    "END INSTANCE": {"instance"},
    "NODE": ANYWHERE,
    "ELEMENT": ANYWHERE,
    "NSET": ANYWHERE,
    "ELSET": ANYWHERE,
    "SURFACE": ANYWHERE,
    "ORIENTATION": ANYWHERE,
    "SOLID SECTION": PART,
    "SHELL SECTION": PART,
    "SURFACE SECTION": PART,
    "REBAR LAYER": PART,
    "RIGID BODY": ANYWHERE,
    "TIE": ANYWHERE,
    "EMBEDDED ELEMENT": ANYWHERE,
    "MATERIAL": {"model"},
    "HYPERELASTIC": {"model"},
    "ELASTIC": {"model"},
    "SURFACE INTERACTION": {"model"},
    "FRICTION": {"model"},
    "SURFACE BEHAVIOR": {"model"},
    "CONTACT PAIR": {"model"},
    "AMPLITUDE": {"model"},
    "BOUNDARY": {"model", "step"},
    "STEP": {"model"},
    "END STEP": {"step"},
    "STATIC": {"step"},
    "CLOAD": {"step"},
    "NODE PRINT": {"step"},
    "OUTPUT": {"step"},
    "NODE OUTPUT": {"step"},
    "ELEMENT OUTPUT": {"step"},
    "CONTACT OUTPUT": {"step"},
}
# keyword: the only keywords that it may follow, data and comments aside
AFTER = {
    "HYPERELASTIC": {"MATERIAL"},
    "ELASTIC": {"MATERIAL"},
    "REBAR LAYER": {"SURFACE SECTION"},
    "FRICTION": {"SURFACE INTERACTION"},
    "SURFACE BEHAVIOR": {"SURFACE INTERACTION", "FRICTION"},
    "STATIC": {"STEP"},
    "END INSTANCE": {"INSTANCE"},
    "NODE OUTPUT": {"OUTPUT", "NODE OUTPUT", "ELEMENT OUTPUT", "CONTACT OUTPUT"},
    "ELEMENT OUTPUT": {"OUTPUT", "NODE OUTPUT", "ELEMENT OUTPUT", "CONTACT OUTPUT"},
    "CONTACT OUTPUT": {"OUTPUT", "NODE OUTPUT", "ELEMENT OUTPUT", "CONTACT OUTPUT"},
}
OPENS = {"PART": "part", "ASSEMBLY": "assembly", "INSTANCE": "instance", "STEP": "step"}
NODES_OF = {"C3D8H": 8, "C3D6H": 6, "S4R": 4, "SFM3D4R": 4}


@dataclass
class ElementGroup:
    """A keyword with its parameters and data lines."""

    keyword: str
    parameters: dict[str, str]
    data: list[list[str]]
    level: str
    scope: str  # name of the part, "" elsewhere


@dataclass
class Part:
    positions: dict[int, np.ndarray] = field(default_factory=dict)
    elements: dict[int, tuple[str, tuple[int, ...]]] = field(default_factory=dict)
    node_sets: dict[str, list[int]] = field(default_factory=dict)
    element_sets: dict[str, list[int]] = field(default_factory=dict)
    surfaces: dict[str, ElementGroup] = field(default_factory=dict)
    blocks: list[ElementGroup] = field(default_factory=list)

    def named(self, keyword: str) -> list[ElementGroup]:
        return [block for block in self.blocks if block.keyword == keyword]


@dataclass
class Instance:
    name: str
    part: Part
    shift: np.ndarray
    turn: np.ndarray
    angle_deg: float

    def position(self, node: int) -> np.ndarray:
        return self.turn @ (self.part.positions[node] + self.shift)


@dataclass
class Deck:
    parts: dict[str, Part]
    instances: dict[str, Instance]
    assembly: Part
    model: list[ElementGroup]
    step: list[ElementGroup]

    def named(self, keyword: str) -> list[ElementGroup]:
        return [block for block in self.model + self.step if block.keyword == keyword]

    def resolve(self, name: str, kind: str) -> list[tuple[str, int]]:
        """Members of ``SET`` of the assembly or ``INSTANCE.SET`` as (instance, label)."""
        if "." in name:
            owner, own = name.split(".")
            return [(owner, label) for label in getattr(self.instances[owner].part, kind)[own]]
        members = getattr(self.assembly, kind)[name]
        return [entry if isinstance(entry, tuple) else ("", entry) for entry in members]

    def surface(self, name: str) -> ElementGroup:
        owner, own = name.split(".")
        return self.instances[owner].part.surfaces[own]


def read_blocks(text: str) -> list[ElementGroup]:
    """Cut a deck into blocks; check spelling, nesting and order."""
    blocks: list[ElementGroup] = []
    stack = ["model"]
    scope = ""
    for number, line in enumerate(text.splitlines(), 1):
        assert line.strip(), f"line {number} is blank: Abaqus reads it as data"
        assert len(line) <= 256, f"line {number} is longer than Abaqus reads"
        if line.startswith("**"):
            continue
        if not line.startswith("*"):
            entries = [entry.strip() for entry in line.split(",")]
            assert len(entries) <= 17, f"line {number} has more than 16 entries"
            blocks[-1].data.append(entries)
            continue
        keyword, *rest = [word.strip() for word in line[1:].split(",")]
        assert keyword in LEVELS, f"line {number}: *{keyword} is not a keyword of the list"
        level = stack[-1]
        assert level in LEVELS[keyword], f"line {number}: *{keyword} at level {level}"
        if keyword in AFTER:
            before = blocks[-1].keyword
            assert before in AFTER[keyword], f"line {number}: *{keyword} after *{before}"
        parameters = dict(word.split("=", 1) if "=" in word else (word, "") for word in rest)
        if keyword == "PART":
            scope = parameters["NAME"]
        blocks.append(ElementGroup(keyword, parameters, [], level, scope))
        if keyword in OPENS:
            stack.append(OPENS[keyword])
        if keyword.startswith("END "):
            assert stack.pop() == keyword.split()[1].lower(), f"line {number}: wrong nesting"
            scope = "" if keyword == "END PART" else scope
    assert stack == ["model"], f"{stack[-1]} is not closed"
    return blocks


def read_deck(text: str) -> Deck:
    """Read a deck into parts, instances, assembly, model and step."""
    deck = Deck({}, {}, Part(), [], [])
    for block in read_blocks(text):
        if block.keyword == "PART":
            deck.parts[block.scope] = Part()
        elif block.keyword == "INSTANCE":
            name, part = block.parameters["NAME"], deck.parts[block.parameters["PART"]]
            assert name not in deck.instances
            deck.instances[name] = _instance(name, part, block.data)
        elif block.level == "part":
            _collect(deck.parts[block.scope], block)
        elif block.level == "assembly":
            _collect(deck.assembly, block)
        elif block.level == "step":
            deck.step.append(block)
        else:
            deck.model.append(block)
    return deck


def _collect(part: Part, block: ElementGroup) -> None:
    part.blocks.append(block)
    parameters = block.parameters
    if block.keyword == "NODE":
        for label, *place in block.data:
            assert int(label) not in part.positions
            part.positions[int(label)] = np.array([float(v) for v in place])
        if "NSET" in parameters:
            part.node_sets[parameters["NSET"]] = [int(row[0]) for row in block.data]
    elif block.keyword == "ELEMENT":
        kind = parameters["TYPE"]
        for label, *nodes in block.data:
            assert int(label) not in part.elements
            assert len(nodes) == NODES_OF[kind]
            part.elements[int(label)] = (kind, tuple(int(node) for node in nodes))
    elif block.keyword in ("NSET", "ELSET"):
        sets = part.node_sets if block.keyword == "NSET" else part.element_sets
        entries = [entry for row in block.data for entry in row if entry]
        owner = parameters.get("INSTANCE")
        labels = [int(entry) for entry in entries]
        own = labels if owner is None else [(owner, label) for label in labels]
        sets.setdefault(parameters[block.keyword], []).extend(own)  # Abaqus adds to a set
    elif block.keyword == "SURFACE":
        part.surfaces[parameters["NAME"]] = block


def _instance(name: str, part: Part, data: list[list[str]]) -> Instance:
    """Translation first, then a rotation about the axis from point a to point b."""
    rows = [[float(value) for value in row] for row in data]
    shift = np.array(rows[0]) if rows else np.zeros(3)
    turn, angle = np.eye(3), 0.0
    if len(rows) > 1:
        a, b, angle = np.array(rows[1][:3]), np.array(rows[1][3:6]), rows[1][6]
        assert np.allclose(a, 0.0), "the tests support only axes through the origin"
        n = (b - a) / np.linalg.norm(b - a)
        cross = np.array([[0.0, -n[2], n[1]], [n[2], 0.0, -n[0]], [-n[1], n[0], 0.0]])
        rad = np.radians(angle)
        turn = np.eye(3) + np.sin(rad) * cross + (1.0 - np.cos(rad)) * cross @ cross
    return Instance(name, part, shift, turn, angle)


CORNERS = np.array(
    [
        *[(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1)],
        *[(-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)],
    ]
)
"""Natural places of a brick's nodes in Abaqus' order."""


def corners(part, element_set=None):
    """Positions (elements, nodes, 3) of a part's elements."""
    labels = part.element_sets[element_set] if element_set else part.elements
    return np.array([[part.positions[n] for n in part.elements[label][1]] for label in labels])


def shape_and_slope(natural):
    """Trilinear shape functions (..., 8) and derivatives (..., 8, 3) at natural places (..., 3)."""
    terms = 1.0 + CORNERS * natural[..., None, :]
    x, y, z = np.moveaxis(terms, -1, 0)
    slope = CORNERS * np.stack([y * z, x * z, x * y], axis=-1)
    return x * y * z / 8.0, slope / 8.0


def volumes(bricks):
    """Volume of each brick and its smallest Jacobian at 2 × 2 × 2 points and at the corners."""
    total, smallest = np.zeros(len(bricks)), np.full(len(bricks), np.inf)
    for scale, weight in ((1.0 / np.sqrt(3.0), 1.0), (1.0, 0.0)):
        for natural in CORNERS * scale:
            jacobian = np.linalg.det(np.einsum("enx,nj->exj", bricks, shape_and_slope(natural)[1]))
            total += weight * jacobian
            smallest = np.minimum(smallest, jacobian)
    return total, smallest


def held(bricks, points):
    """Which of the points lie in one of the bricks."""
    return host(bricks, points)[0] >= 0


def host(bricks, points):
    """Number of a brick that contains each point, or -1, and the point's natural place in it.

    By Newton's method, in all bricks near the point.
    """
    low, high = bricks.min(axis=1) - 1e-6, bricks.max(axis=1) + 1e-6
    near = [np.flatnonzero(((low <= point) & (point <= high)).all(axis=1)) for point in points]
    which = np.repeat(np.arange(len(points)), [len(found) for found in near])
    tried = np.concatenate(near)
    natural = np.zeros((len(tried), 3))
    for _ in range(12):
        shape, slope = shape_and_slope(natural)
        miss = np.einsum("pn,pnx->px", shape, bricks[tried]) - points[which]
        jacobian = np.einsum("pnx,pnj->pxj", bricks[tried], slope)
        natural -= np.linalg.solve(jacobian, miss[..., None])[..., 0]
    inside = np.abs(natural).max(axis=1) <= 1.0 + 1e-6
    brick, place = np.full(len(points), -1), np.zeros((len(points), 3))
    brick[which[inside]] = tried[inside]
    place[which[inside]] = natural[inside]
    return brick, place


def places(part):
    """Positions of all nodes, array (nodes, 3)."""
    return np.array(list(part.positions.values()))


def material(deck, name):
    """Blocks of a material by keyword."""
    start = next(
        i
        for i, block in enumerate(deck.model)
        if block.keyword == "MATERIAL" and block.parameters["NAME"] == name
    )
    blocks = {}
    for block in deck.model[start + 1 :]:
        if block.keyword not in ("ELASTIC", "HYPERELASTIC"):
            break
        blocks[block.keyword] = block
    return blocks


def face_radii(part, surface):
    """Radii of the nodes of a surface's faces S1 (nodes 1 to 4) or S2 (5 to 8)."""
    ((name, face),) = part.surfaces[surface].data
    nodes = {"S1": slice(0, 4), "S2": slice(4, 8)}[face]
    return np.hypot(*corners(part, name)[:, nodes].reshape(-1, 3)[:, :2].T)
