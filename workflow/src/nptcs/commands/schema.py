"""``nptcs schema``: the configuration's schema and the reference pages, from the models."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import Any

from nptcs.arguments import add_command, existing_folder

SCHEMA = Path("workflow/schemas/config.schema.json")
REFERENCE = Path("docs/configuration.md")
TABLES_PAGE = Path("docs/tables.md")


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = add_command(
        subparsers,
        "schema",
        "rewrite the configuration schema and the reference pages in docs/",
        "Writes the JSON schema with which editors complete and check the configuration, and the "
        "reference pages of configuration and result tables, from the models in the code. For "
        "those who change these models.",
        "nptcs schema",
    )
    parser.add_argument(
        "--root",
        type=existing_folder,
        default=".",
        help="the project folder; default: the current one",
    )
    parser.set_defaults(run=run)


def run(arguments: argparse.Namespace) -> int:
    """Write all three files."""
    from nptcs.files import write_text

    root = Path(arguments.root)
    write_text(root / SCHEMA, schema_text())
    write_text(root / REFERENCE, reference_text())
    write_text(root / TABLES_PAGE, tables_text())
    print(f"wrote {SCHEMA}, {REFERENCE} and {TABLES_PAGE} in {root}")
    return 0


def schema_text() -> str:
    """Return the JSON schema of the configuration; editors complete and check with it."""
    from nptcs.config.root import Config

    schema = {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        **Config.model_json_schema(),
    }
    return json.dumps(schema, indent=1, ensure_ascii=False) + "\n"


def reference_text() -> str:
    """Return the reference page: a table of keys for each section."""
    from nptcs.config.root import Config
    from nptcs.solvers.registry import MODULES, load

    lines = [
        "# Configuration reference",
        "",
        "Written by `nptcs schema` from the models in `workflow/src/nptcs/config` and of the "
        "solvers; do not edit.",
        "",
    ]
    lines += _section("config/config.yaml", Config.model_json_schema())
    for name, module in MODULES.items():
        lines += _section(f"solvers.{name}", load(module).options.model_json_schema())
    return "\n".join(lines)


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
            lines.append(f"| `{name}` | {column.dtype} | {empty} | {meaning} |")
        lines.append("")
    return "\n".join(lines)


def _section(title: str, schema: dict[str, Any]) -> list[str]:
    """Describe a model and those that it holds."""
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
    """Write a default, or point to the section that holds it."""
    default = value.get("default")
    if isinstance(default, dict) and default:
        return "see there"
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
