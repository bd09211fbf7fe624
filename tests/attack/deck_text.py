"""Decks as trees of Python that can be spoilt, and written again as YAML.

Read with all scalars as texts, so that nothing is changed by being read (NO is a species, 1e-5 a number); written with
one top-level key a line, flow style below.
"""

import copy
import json
import pathlib
import re

import yaml

NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?$")


class Raw(str):
    """A scalar or key that is written as it is."""


class Twin(str):
    """A key equal to no other, so that a dict can hold it beside its like."""
    __hash__ = object.__hash__

    def __eq__(self, other):
        return self is other

    def __ne__(self, other):
        return self is not other


def read(path: pathlib.Path) -> dict:
    return yaml.load(path.read_text(encoding="utf-8"), yaml.BaseLoader)


def scalar(value) -> str:
    if isinstance(value, Raw):
        return str(value)
    if value is None:
        return "null"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if NUMBER.match(value) or value in ("true", "false"):
        return value
    return json.dumps(str(value), ensure_ascii=False)


def flow(node) -> str:
    if isinstance(node, dict):
        return "{" + ", ".join(f"{key_text(key)}: {flow(value)}" for key, value in node.items()) + "}"
    if isinstance(node, list):
        return "[" + ", ".join(map(flow, node)) + "]"
    return scalar(node)


def key_text(key) -> str:
    return str(key) if isinstance(key, Raw) or re.fullmatch(r"\w+", str(key)) else json.dumps(str(key))


def write(tree) -> str:
    if not isinstance(tree, dict):
        return flow(tree) + "\n"
    return "".join(f"{key_text(key)}: {flow(value)}\n" for key, value in tree.items())


def steps(path: str) -> list:
    """"a.b[0].c" as a, b, 0, c."""
    return [int(step) if step.isdigit() else step for step in re.findall(r"[^.\[\]]+", path)]


def get(tree, path: list):
    for step in path:
        tree = tree[step]
    return tree


def has(tree, path: list) -> bool:
    try:
        get(tree, path)
        return True
    except (KeyError, IndexError, TypeError):
        return False


def put(tree, path: list, value) -> None:
    """Sets a key, making the sections it needs."""
    for i, step in enumerate(path[:-1]):
        if isinstance(tree, dict) and not isinstance(tree.get(step), (dict, list)):
            tree[step] = [] if isinstance(path[i + 1], int) else {}
        elif isinstance(tree, list) and step == len(tree):
            tree.append({})
        tree = tree[step]
    if isinstance(tree, list) and path[-1] == len(tree):
        tree.append(value)
    else:
        tree[path[-1]] = value


def remove(tree, path: list) -> None:
    del get(tree, path[:-1])[path[-1]]


def from_setting(text: str) -> tuple:
    """"a.b=value" as a path and a tree."""
    key, _, value = text.partition("=")
    return steps(key), yaml.load(value, yaml.BaseLoader)


def changed(tree, changes: dict):
    """A copy with each "a.b[0]" set to its value; REMOVE takes a key away."""
    tree = copy.deepcopy(tree)
    for path, value in changes.items():
        if value is REMOVE:
            remove(tree, steps(path))
        else:
            put(tree, steps(path), copy.deepcopy(value))
    return tree


REMOVE = object()
