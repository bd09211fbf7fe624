"""The keys a deck may have, from the program's own JSON schema."""

import dataclasses
import json
import re
import subprocess

import execution


@dataclasses.dataclass
class Key:
    path: list  # in a deck; names and numbers of items are chosen
    kind: str  # quantity, number, integer, boolean, choice, text, list, section
    schema: dict
    required: bool = False

    @property
    def dotted(self) -> str:
        return "".join(f"[{step}]" if isinstance(step, int) else f".{step}" for step in self.path).lstrip(".")


def of_program(program: execution.Program) -> dict:
    """The schema of each problem's deck."""
    text = subprocess.run([program.executable, "deck-reference", "--json-schema"], env=execution.environment(),
                          capture_output=True, text=True, check=True, timeout=60).stdout
    whole = json.loads(text)["anyOf"][-1]  # of a deck without a base
    problems = [(part["if"]["properties"]["problem"], part["then"]) for part in whole["allOf"]]
    return {name.get("const") or name["enum"][0]: then for name, then in problems}


def kind_of(schema: dict) -> str:
    types = schema.get("type", [])
    types = [types] if isinstance(types, str) else types
    if "enum" in schema:
        return "choice"
    if "object" in types:
        return "section"
    if "array" in types:
        return "list"
    if "boolean" in types:
        return "boolean"
    if "integer" in types:
        return "integer"
    if types[:1] == ["number"]:
        return "quantity" if "(for instance" in schema.get("description", "") else "number"
    return "text"


def example(schema: dict):
    """A value that the schema has no objection to."""
    kind = kind_of(schema)
    description = schema.get("description", "")
    instance = re.search(r"\(for instance '([^']*)'\)", description)
    if kind == "choice":
        return [choice for choice in schema["enum"] if choice not in schema.get("x-former", [])][-1]
    if kind == "section":
        return {name: example(part) for name, part in schema.get("properties", {}).items()
                if name in schema.get("required", [])}
    if kind == "list":
        return [example(schema["items"])]
    if kind == "quantity" and instance:
        return instance[1]
    if kind in ("integer", "number", "quantity"):
        return schema.get("minimum", schema.get("exclusiveMinimum", 0) + 1)
    return True if kind == "boolean" else "H2: 1"


def keys(schema: dict, tree, path: list | None = None) -> list:
    """Every key of the schema as it could stand in this deck: with its names and items where it has some."""
    path = path or []
    found = []
    here = tree if isinstance(tree, (dict, list)) else {}
    if schema.get("properties") or isinstance(schema.get("additionalProperties"), dict):
        parts = dict(schema.get("properties", {}))
        if isinstance(schema.get("additionalProperties"), dict):
            names = [name for name in here if name not in parts] if isinstance(here, dict) else []
            parts.update({str(name): schema["additionalProperties"] for name in names or ["extra"]})
        for name, part in parts.items():
            if part.get("deprecated"):  # a former name of another key
                continue
            value = here.get(name) if isinstance(here, dict) else None
            found.append(Key([*path, name], kind_of(part), part, name in schema.get("required", [])))
            found += keys(part, value, [*path, name])
    elif "items" in schema:
        items = here if isinstance(here, list) and here else [None]
        for number, value in enumerate(items):
            found.append(Key([*path, number], kind_of(schema["items"]), schema["items"]))
            found += keys(schema["items"], value, [*path, number])
    return found
