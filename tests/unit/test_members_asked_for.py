"""A question about one member of a closed set is looked at again when the set gets a new member.

``match`` with ``assert_never`` covers the branches (`test_closed_sets`). A plain question such as
``ring == "paper_mesh"`` has an answer for any other member, and nobody is told when one is added.
So the members that were known when those questions were last read are listed.
"""

import ast
import json
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

import nptcs

PACKAGE = Path(nptcs.__file__).parent
KNOWN = json.loads(Path(__file__).with_name("members_asked_for.json").read_text("utf-8"))


def trees() -> Iterator[tuple[str, ast.Module]]:
    for file in sorted(PACKAGE.rglob("*.py")):
        yield str(file.relative_to(PACKAGE)), ast.parse(file.read_text("utf-8"))


def literal_members(annotation: ast.AST | None) -> list[str]:
    """Words of all ``Literal[…]`` in an annotation; none if there are fewer than two."""
    words = []
    for node in ast.walk(annotation) if annotation else ():
        if isinstance(node, ast.Subscript) and ast.unparse(node.value) == "Literal":
            inside = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
            words += [part.value for part in inside if isinstance(part, ast.Constant)]
    words = [word for word in words if isinstance(word, str) and word]
    return words if len(words) > 1 else []


def enum_members(node: ast.ClassDef) -> list[str]:
    if not any("Enum" in ast.unparse(base) for base in node.bases):
        return []
    values = [part.value for part in node.body if isinstance(part, ast.Assign)]
    return [v.value for v in values if isinstance(v, ast.Constant) and isinstance(v.value, str)]


def closed_sets() -> dict[str, list[str]]:
    """Members of each closed set of the package, by ``file: name``."""
    found = {}
    for file, tree in trees():
        for node in ast.walk(tree):
            name, members = "", []
            if isinstance(node, ast.ClassDef):
                name, members = node.name, enum_members(node)
            elif isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
                name, members = node.targets[0].id, literal_members(node.value)
            elif isinstance(node, ast.AnnAssign):
                name, members = ast.unparse(node.target), literal_members(node.annotation)
            elif isinstance(node, ast.arg):
                name, members = node.arg, literal_members(node.annotation)
            if members:
                found[f"{file}: {name}"] = sorted(members)
    return found


def questions() -> dict[str, list[str]]:
    """Places that compare with a word, or with a member of an enumeration, by word."""
    found: dict[str, list[str]] = defaultdict(list)
    for file, tree in trees():
        for node in ast.walk(tree):
            if not isinstance(node, ast.Compare) or isinstance(node.ops[0], ast.In | ast.NotIn):
                continue
            for side in (node.left, *node.comparators):
                place = f"{file}:{node.lineno}: {ast.unparse(node)}"
                if isinstance(side, ast.Constant) and isinstance(side.value, str):
                    found[side.value].append(place)
                if isinstance(side, ast.Attribute) and side.attr.isupper():
                    found[ast.unparse(side)].append(place)
    return dict(found)


def places_that_ask(name: str, members: list[str], asked: dict[str, list[str]]) -> list[str]:
    short = name.rsplit(" ", 1)[1]
    words = [*members, *(word for word in asked if word.startswith(f"{short}."))]
    return [place for word in words for place in asked.get(word, [])]


def test_members_are_those_known_when_the_questions_were_read() -> None:
    asked = questions()
    for name, members in closed_sets().items():
        if places := places_that_ask(name, members, asked):
            known = KNOWN.get(name)
            assert known == members, (
                f"{name} has the members {members}; {known} were known when these places were read:"
                "\n  " + "\n  ".join(places) + "\nRead them, then write the members into "
                "tests/unit/members_asked_for.json."
            )


def test_the_list_has_no_set_that_is_gone() -> None:
    asked, sets = questions(), closed_sets()
    gone = [
        name for name in KNOWN if name not in sets or not places_that_ask(name, sets[name], asked)
    ]
    assert gone == []


def test_the_search_sees_a_new_member() -> None:
    tree = ast.parse("Ring = Literal['converged', 'paper_mesh', 'new']")
    assert literal_members(tree.body[0].value) == ["converged", "paper_mesh", "new"]  # type: ignore[attr-defined]
