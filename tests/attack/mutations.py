"""Random changes of a deck, each with what has to come of it where that is known."""

import copy
import random

import deck_text
import schema as schemas
from deck_text import Raw, Twin

# Where the schema has a number.
EXTREME = ["0", "-1", "-0.0", "1e300", "-1e300", "1e-300", "1e18", "4294967297", "4294967296", "2147483648",
           "9223372036854775808", "1e308", "5e-324", "1e9", "0x10", "1_000", "007", "1e-15"]
NO_NUMBERS = [".nan", "nan", ".inf", "-.inf", "inf", '""', '"1 2"', "1e400", '"1,5"', "1d5", "--1", "+"]
UNITS = ["m", "s", "K", "kg/m^3", "Pa", "1/m^3", "m/s", "furlong", "mm s^", "^2", "/", "m^1000"]
WRONG_TYPES = {"list": [Raw("{}"), Raw("{a: 1}"), Raw("7 8")],
               "section": [Raw("[1]"), Raw("text"), Raw("3"), Raw("[[]]")],
               "scalar": [Raw("[1, 2]"), Raw("{a: 1}"), Raw("[]"), Raw("[[[[1]]]]")]}
TEXTS = [Raw('""'), Raw('" "'), Raw("'\\'"), Raw('"../../.."'), Raw('"/dev/null"'), Raw('"/"'), Raw('"\\u0000"'),
         Raw('"' + "x" * 5000 + '"'), Raw('"%s%n%d"'), Raw('"H2: 1, H2: 1"'), Raw('"H2: -1"'), Raw('"H2: 1e308, O2: 1e308"'),
         Raw('"H2: nan"'), Raw('"N2: 1"'), Raw('"H2"'), Raw('": 1"'), Raw('"É: 1"'), Raw("NO"), Raw("all"), Raw("~")]


class Change:
    """One change made, in words, and whether the program has to refuse the deck for it."""

    def __init__(self, what: str, refused: bool = False):
        self.what = what
        self.refused = refused


def value_of(key: schemas.Key, chance: random.Random, tree) -> tuple:
    """A strange value for a key, and whether it has to be refused."""
    kind = key.kind
    if chance.random() < 0.15:
        group = kind if kind in WRONG_TYPES else "scalar"
        return chance.choice(WRONG_TYPES[group]), True
    if kind in ("quantity", "number", "integer"):
        draw = chance.random()
        if draw < 0.2:
            return Raw(chance.choice(NO_NUMBERS)), True
        if draw < 0.35 and kind == "quantity":
            return Raw(f'"1 {chance.choice(UNITS[7:])}"'), True
        if draw < 0.45 and kind != "quantity":
            return Raw(f'"1 {chance.choice(UNITS)}"'), True
        if draw < 0.55 and kind == "integer":
            return Raw(chance.choice(["1.5", "1e18", "1e-3", "0.1"])), False
        if draw < 0.75 and deck_text.has(tree, key.path):
            return scaled(deck_text.get(tree, key.path), chance)
        return Raw(chance.choice(EXTREME)), False
    if kind == "choice":
        if chance.random() < 0.3:
            return Raw(chance.choice(["nothing", "''", "1", "true"])), "1" not in key.schema["enum"]
        return chance.choice(key.schema["enum"]), False
    if kind == "boolean":
        return Raw(chance.choice(["true", "false", "yes", "2", "''"])), False
    if kind == "list":
        return chance.choice([Raw("[]"), Raw("[null]"), Raw("[1, 1]"), Raw("[[1]]"), Raw("[a, b, a]")]), False
    if kind == "section":
        return chance.choice([Raw("{}"), Raw("null"), schemas.example(key.schema)]), False
    return chance.choice(TEXTS), False


def scaled(value, chance: random.Random) -> tuple:
    """A number with another size, its unit kept."""
    number, _, unit = str(value).partition(" ")
    try:
        text = f"{float(number) * chance.choice([0.01, 0.1, 0.5, 2, 10, 100]):.6g}"
    except ValueError:
        return Raw("1"), False
    return (f"{text} {unit}" if unit else Raw(text)), False


def set_value(tree, keys, chance):
    key = chance.choice(keys)
    value, refused = value_of(key, chance, tree)
    deck_text.put(tree, key.path, value)
    return Change(f"{key.dotted}: {deck_text.flow(value)[:60]}", refused)


def set_present(tree, keys, chance):
    """As set_value, of the keys the deck has: those matter more often."""
    present = [key for key in keys if deck_text.has(tree, key.path)]
    return set_value(tree, present, chance)


def misspell(tree, keys, chance):
    sections = [key for key in keys if key.kind == "section" and key.schema.get("additionalProperties") is False
                and isinstance(deck_text.get(tree, key.path) if deck_text.has(tree, key.path) else None, dict)]
    section = deck_text.get(tree, chance.choice(sections).path) if sections and chance.random() < 0.8 else tree
    name = chance.choice(list(section) or ["key"])
    name = chance.choice([str(name) + "s", str(name)[1:] or "x", "x", str(name).upper(), "a.b", " "])
    section[name] = Raw("1")
    return Change(f"unknown key {name!r}", name.lower() != name or name in ("x", "a.b", " "))


def repeat_key(tree, keys, chance):
    present = [key for key in keys if deck_text.has(tree, key.path) and isinstance(key.path[-1], str)]
    key = chance.choice(present)
    section = deck_text.get(tree, key.path[:-1])
    section[Twin(key.path[-1])] = copy.deepcopy(section[key.path[-1]])
    return Change(f"{key.dotted} twice", True)


def take_away(tree, keys, chance):
    present = [key for key in keys if deck_text.has(tree, key.path)]
    key = chance.choice(present)
    deck_text.remove(tree, key.path)
    return Change(f"without {key.dotted}", key.required)


def repeat_item(tree, keys, chance):
    lists = [key for key in keys if deck_text.has(tree, key.path) and isinstance(deck_text.get(tree, key.path), list)]
    if not lists:
        return take_away(tree, keys, chance)
    key = chance.choice(lists)
    items = deck_text.get(tree, key.path)
    items += copy.deepcopy(items[-1:])
    return Change(f"last item of {key.dotted} twice")


def key_of_another_choice(tree, keys, chance):
    absent = [key for key in keys if not deck_text.has(tree, key.path) and deck_text.has(tree, key.path[:-1])]
    key = chance.choice(absent or keys)
    deck_text.put(tree, key.path, schemas.example(key.schema))
    return Change(f"also {key.dotted}")


def size(tree, keys, chance):
    """Another size for a number: mostly an ordinary deck."""
    present = [key for key in keys if key.kind in ("quantity", "number", "integer") and deck_text.has(tree, key.path)]
    key = chance.choice(present)
    value, _ = scaled(deck_text.get(tree, key.path), chance)
    deck_text.put(tree, key.path, value)
    return Change(f"{key.dotted}: {deck_text.flow(value)}")


KINDS = [(set_present, 30), (set_value, 20), (misspell, 6), (repeat_key, 6), (take_away, 10), (repeat_item, 6),
         (key_of_another_choice, 12), (size, 20)]


def mutate(tree, schema: dict, chance: random.Random) -> tuple:
    """A spoilt copy of a deck and the changes in it: one, two or three."""
    tree = copy.deepcopy(tree)
    changes = []
    for _ in range(chance.choices([1, 2, 3], [70, 22, 8])[0]):
        keys = [key for key in schemas.keys(schema, tree) if key.path != ["problem"]]
        kind = chance.choices([kind for kind, _ in KINDS], [weight for _, weight in KINDS])[0]
        try:
            changes.append(kind(tree, keys, chance))
        except (KeyError, IndexError, TypeError, AttributeError):
            continue  # a change before it has taken away what it needs
    return tree, changes
