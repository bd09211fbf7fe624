"""Which flames of a study belong together: series of runs that differ in one thing only, and by how much."""

import json

from .damage import reading
from .results import text_of

# What does not make a flame another one.
IGNORED = ("title", "initial", "mechanism_path")
FEWEST, MOST_SERIES = 3, 4


class Series:
    """Runs in the order of what is varied. `values` are None where that is not a number."""

    def __init__(self, name, quantity, runs, values, labels):
        self.name, self.quantity, self.runs, self.values, self.labels = name, quantity, runs, values, labels


def flattened(deck, prefix=""):
    """{"left.velocity": 0.2, ...}; lists count as one value."""
    flat = {}
    for key, value in deck.items():
        if isinstance(value, dict):
            flat.update(flattened(value, prefix + key + "."))
        else:
            flat[prefix + key] = value
    return flat


def mole_fractions(text):
    """{"O2": 0.25, "N2": 0.75} of "O2: 1, N2: 3"; nothing where the text is no composition."""
    try:
        parts = {name.strip(): float(amount) for name, amount in (part.split(":") for part in text.split(","))}
        total = sum(parts.values())
        return {name: amount / total for name, amount in parts.items()}
    except (AttributeError, ValueError, ZeroDivisionError):
        return {}


def _partition(values):
    first = {}
    return tuple(first.setdefault(json.dumps(value, sort_keys=True), len(first)) for value in values)


def _factors(decks):
    """Groups of keys that change together, as [(keys, partition of the runs)]; finest partitions first."""
    keys = [key for key in dict.fromkeys(key for deck in decks for key in deck) if key not in IGNORED]
    found = []
    for key in keys:
        partition = _partition([deck.get(key) for deck in decks])
        if len(set(partition)) > 1:
            found.append((key, partition))
    factors = []
    for key, partition in sorted(found, key=lambda item: -len(set(item[1]))):
        # A key that another one determines, like a model's own density, is not varied by itself.
        owner = next((f for f in factors if len(set(zip(f[1], partition))) == len(set(f[1]))), None)
        if owner:
            owner[0].append(key)
        else:
            factors.append(([key], partition))
    return factors


def _measure(keys, runs):
    """Name, quantity for axes, and the value of each run: a number, or None."""
    decks = [run["flat"] for run in runs]
    key = keys[0]
    strains = [run["results"].get("strain_global_per_s") for run in runs]
    if any("velocity" in k or "mass_flux" in k for k in keys) and None not in strains:
        return "strain", "strain rate, 1/s", strains
    values = [deck.get(key) for deck in decks]
    fractions = [mole_fractions(value) for value in values]
    for species in fractions[0] if all(fractions) else {}:
        of_species = [mixture.get(species, 0.0) for mixture in fractions]
        if len(set(of_species)) > 1:
            return species, f"mole fraction of {species} ({key.split('.')[0]})", of_species
    if all(isinstance(value, (int, float)) and not isinstance(value, bool) for value in values):
        return key.rsplit(".", 1)[-1], key, values
    return key.rsplit(".", 1)[-1], key, [None] * len(runs)


def read_runs(folder, rows):
    """The finished runs of a study with the decks they had and the numbers they gave."""
    runs = []
    for row in rows:
        try:
            record = json.loads(reading(folder / row["run"] / "run.json").read_text(encoding="utf-8"))
        except (OSError, ValueError):
            continue
        runs.append({"folder": folder / row["run"], "flat": flattened(record.get("deck", {})),
                     "results": record.get("results", {}), "variant": text_of(row.get("variant", ""))})
    return runs


def series_of(runs):
    """All series of at least three runs that differ in one thing only."""
    if len(runs) < FEWEST:
        return []
    factors = _factors([run["flat"] for run in runs])
    found = []
    for number, (keys, partition) in enumerate(factors):
        others = [p for i, (_, p) in enumerate(factors) if i != number]
        groups = {}
        for i, run in enumerate(runs):
            groups.setdefault(tuple(p[i] for p in others), []).append((partition[i], run))
        for group in groups.values():
            if len({value for value, _ in group}) < FEWEST:
                continue
            members = [run for _, run in group]
            name, quantity, values = _measure(keys, members)
            if None not in values:
                order = sorted(range(len(members)), key=lambda i: values[i])
                members, values = [members[i] for i in order], [values[i] for i in order]
                labels = [f"{value:.3g}" for value in values]
            else:
                labels = [run["variant"] or str(run["flat"].get(keys[0])) for run in members]
            found.append(Series(name, quantity, members, values, labels))
    if len(found) > MOST_SERIES:
        return []
    for series in found:
        twins = [s for s in found if s.name == series.name]
        if len(twins) > 1:
            for number, twin in enumerate(twins, start=1):
                twin.name = f"{twin.name}_{number}"
    return found
