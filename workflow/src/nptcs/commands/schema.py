"""``nptcs schema``: the configuration's schema and the reference pages, from models and parsers."""

from __future__ import annotations

import argparse
import json
from functools import partial
from pathlib import Path
from typing import Any, TypeAlias

from nptcs.arguments import add_command, existing_folder

Commands: TypeAlias = "argparse._SubParsersAction[argparse.ArgumentParser]"

SCHEMA = Path("workflow/schemas/config.schema.json")
REFERENCE = Path("docs/configuration.md")
TABLES_PAGE = Path("docs/tables.md")
COMMANDS_PAGE = Path("docs/commands.md")


def register(subparsers: Commands) -> None:
    """Declare the command."""
    parser = add_command(
        subparsers,
        "schema",
        "rewrite the configuration schema and the reference pages in docs/",
        "Writes the JSON schema that editors use to complete and check the configuration, and the "
        "reference pages of configuration, result tables and commands, from the code. For "
        "developers who change these.",
        "nptcs schema",
    )
    parser.add_argument(
        "--root",
        type=existing_folder,
        default=".",
        help="the project folder; default: the current one",
    )
    parser.set_defaults(run=partial(run, subparsers))


def run(subparsers: Commands, arguments: argparse.Namespace) -> int:
    """Write all four files; `subparsers` contains the commands."""
    from nptcs.files import write_text

    root = Path(arguments.root)
    write_text(root / SCHEMA, schema_text())
    write_text(root / REFERENCE, reference_text())
    write_text(root / TABLES_PAGE, tables_text())
    write_text(root / COMMANDS_PAGE, commands_text(subparsers))
    print(f"wrote {SCHEMA}, {REFERENCE}, {TABLES_PAGE} and {COMMANDS_PAGE} in {root}")
    return 0


def schema_text() -> str:
    """Return the JSON schema of the configuration, for completion and checks in editors."""
    from nptcs.config.root import Config

    schema = {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        **Config.model_json_schema(),
    }
    return json.dumps(schema, indent=1, ensure_ascii=False) + "\n"


def reference_text() -> str:
    """Return the reference page: a table of keys for each section."""
    from nptcs.config.root import Config
    from nptcs.solvers.registry import MODULES, load_solver

    lines = [
        "# Configuration reference",
        "",
        "Written by `nptcs schema` from the models in `workflow/src/nptcs/config` and in the "
        "solvers; do not edit.",
        "",
    ]
    lines += _section("config/config.yaml", Config.model_json_schema())
    for name, module in MODULES.items():
        lines += _section(f"solvers.{name}", load_solver(module).options.model_json_schema())
    return "\n".join(lines)


KINDS = {
    "string[python]": "text",
    "float64": "number",
    "int64": "whole number",
    "Int64": "whole number",
    "bool": "True or False",
    "boolean": "True or False",
}
"""What a column contains, in words, by pandera's name of its type."""


def tables_text() -> str:
    """Return the page that describes each result table and its columns."""
    from nptcs.tables.catalogue import TABLES

    lines = [
        "# Result tables",
        "",
        "Written by `nptcs schema` from the contracts in `workflow/src/nptcs/tables`; do not "
        "edit. Each table is a CSV file in `results/tables` and a sheet of "
        "`results/workbook.xlsx`; empty means not given.",
        "",
    ]
    for file, table in TABLES.items():
        schema = table.contract.to_schema()
        text = " ".join((table.contract.__doc__ or "").split())
        lines += [f"## `{file}`", "", f"{table.title}. Rule {table.rule}; from {table.source}."]
        lines += ["", text, "", "| column | type | may be empty | meaning |"]
        lines += ["|---|---|---|---|"]
        for name, column in schema.columns.items():
            empty = "yes" if column.nullable else "no"
            meaning = (column.description or "").replace("|", "\\|")
            lines.append(f"| `{name}` | {KINDS[str(column.dtype)]} | {empty} | {meaning} |")
        lines.append("")
    return "\n".join(lines)


def commands_text(subparsers: Commands) -> str:
    """Return the page that describes each command, with its arguments and its examples."""
    summaries = {action.dest: action.help for action in subparsers._choices_actions}
    lines = [
        "# Commands",
        "",
        "Written by `nptcs schema` from the parsers of the commands; do not edit. `nptcs COMMAND "
        "--help` prints the same on a terminal.",
        "",
        "| command | |",
        "|---|---|",
    ]
    lines += [f"| [`{name}`](#nptcs-{name}) | {text} |" for name, text in summaries.items()]
    for name, parser in subparsers.choices.items():
        lines += ["", *_command(name, parser, summaries.get(name) or "")]
    return "\n".join(lines) + "\n"


def _command(name: str, parser: argparse.ArgumentParser, summary: str) -> list[str]:
    """Describe a command: what it is for, how it is called, its arguments, its examples."""
    actions = [a for a in parser._actions if not isinstance(a, argparse._HelpAction)]
    nested = [a for a in actions if isinstance(a, argparse._SubParsersAction)]
    text = " ".join((parser.description or f"{summary[:1].upper()}{summary[1:]}.").split())
    lines = [f"## `nptcs {name}`", "", text.replace("``", "`"), ""]
    if nested:
        for group in nested:
            words = {action.dest: action.help or "" for action in group._choices_actions}
            for part, inner in group.choices.items():
                lines += [*_command(f"{name} {part}", inner, words.get(part, "")), ""]
        return lines[:-1]
    options = ["[options]"] if any(action.option_strings for action in actions) else []
    call = ["nptcs", name, *map(_positional, filter(_is_positional, actions)), *options]
    lines += ["```text", " ".join(call), "```", ""]
    if actions:
        lines += ["| argument | meaning |", "|---|---|", *map(_argument, actions), ""]
    if parser.epilog:
        lines += ["```text", parser.epilog.strip("\n"), "```", ""]
    return lines[:-1]


def _is_positional(action: argparse.Action) -> bool:
    return not action.option_strings


def _positional(action: argparse.Action) -> str:
    """Write a positional argument as it is called: ``FILE``, ``[FILE]`` or ``FILE [FILE ...]``."""
    written = {"?": "[{0}]", "*": "[{0} ...]", "+": "{0} [{0} ...]"}
    return written.get(str(action.nargs), "{0}").format(_value(action))


def _value(action: argparse.Action) -> str:
    """Return the word that stands for the value of an argument; empty for a switch."""
    if action.nargs == 0:
        return ""
    if action.choices is not None:
        return "|".join(map(str, action.choices))
    if isinstance(action.metavar, tuple):
        return " ".join(action.metavar)
    return action.metavar or action.dest.upper().replace("_", "-")


def _argument(action: argparse.Action) -> str:
    """Write the row of an argument."""
    value = _value(action)
    names = [f"`{f'{option} {value}'.strip()}`" for option in action.option_strings]
    default = action.default
    words = " ".join(default) if isinstance(default, list) else default
    meaning = (action.help or "") % {**vars(action), "default": words, "prog": "nptcs"}
    cells = [cell.replace("|", "\\|") for cell in (", ".join(names) or f"`{value}`", meaning)]
    return f"| {cells[0]} | {cells[1]} |"


def _section(title: str, schema: dict[str, Any]) -> list[str]:
    """Describe a model and those that it contains."""
    lines: list[str] = []
    for name, part in [("", schema), *schema.get("$defs", {}).items()]:
        if not part.get("properties"):
            continue
        lines += [f"## {title}" if not name else f"### {name}", ""]
        lines += [(part.get("description") or "").split("\n\n")[0].replace("\n", " "), ""]
        lines += ["| key | type | default | meaning |", "|---|---|---|---|"]
        required = part.get("required", [])
        for key, value in part["properties"].items():
            default = "(required)" if key in required else _default(value)
            meaning = str(value.get("description", "")).replace("|", "\\|")
            lines.append(f"| `{key}` | {_type(value)} | {default} | {meaning} |")
        lines.append("")
    return lines


def _default(value: dict[str, Any]) -> str:
    """Write a default, or point to the section that has it."""
    default = value.get("default")
    if isinstance(default, dict) and default:
        return "see its section"
    return f"`{json.dumps(default, ensure_ascii=False)}`".replace("|", "\\|")


def _type(value: dict[str, Any]) -> str:
    """Name the type of a key."""
    if "$ref" in value:
        return str(value["$ref"]).rsplit("/", 1)[-1]
    if "enum" in value or "const" in value:
        return " \\| ".join(f"`{item}`" for item in value.get("enum", [value.get("const")]))
    if options := value.get("anyOf") or value.get("oneOf") or value.get("allOf"):
        return " or ".join(_type(option) for option in options)
    if value.get("type") == "array":
        if "prefixItems" in value:
            return "[" + ", ".join(_type(item) for item in value["prefixItems"]) + "]"
        return f"list of {_type(value.get('items', {}))}"
    if value.get("type") == "object" and isinstance(value.get("additionalProperties"), dict):
        return f"mapping to {_type(value['additionalProperties'])}"
    return str(value.get("type", "any"))
