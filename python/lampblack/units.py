"""Units as decks write them (io/units.hpp): products, quotients, integer powers, prefixes."""

import math
import re

from .errors import InputError

BASE = ("m", "kg", "s", "K", "mol", "rad")


def _dimension(**powers):
    return tuple(powers.get(name, 0) for name in BASE)


_NONE = _dimension()
_FORCE, _PRESSURE = _dimension(m=1, kg=1, s=-2), _dimension(m=-1, kg=1, s=-2)
_ENERGY, _POWER = _dimension(m=2, kg=1, s=-2), _dimension(m=2, kg=1, s=-3)
_PREFIXED = {
    "m": (1.0, _dimension(m=1)), "g": (1e-3, _dimension(kg=1)), "s": (1.0, _dimension(s=1)), "K": (1.0, _dimension(K=1)),
    "mol": (1.0, _dimension(mol=1)), "rad": (1.0, _dimension(rad=1)), "Hz": (1.0, _dimension(s=-1)), "N": (1.0, _FORCE),
    "Pa": (1.0, _PRESSURE), "bar": (1e5, _PRESSURE), "J": (1.0, _ENERGY), "cal": (4.184, _ENERGY), "eV": (1.602176634e-19, _ENERGY),
    "W": (1.0, _POWER), "L": (1e-3, _dimension(m=3)), "l": (1e-3, _dimension(m=3)), "P": (0.1, _dimension(m=-1, kg=1, s=-1)),
}  # fmt: skip
_ALONE = {
    "deg": (math.pi / 180, _dimension(rad=1)), "°": (math.pi / 180, _dimension(rad=1)), "min": (60.0, _dimension(s=1)),
    "h": (3600.0, _dimension(s=1)), "atm": (101325.0, _PRESSURE), "Torr": (101325.0 / 760, _PRESSURE), "t": (1e3, _dimension(kg=1)),
    "%": (1e-2, _NONE), "ppm": (1e-6, _NONE), "ppb": (1e-9, _NONE), "Å": (1e-10, _dimension(m=1)), "1": (1.0, _NONE),
}  # fmt: skip
_PREFIXES = {"f": 1e-15, "p": 1e-12, "n": 1e-9, "u": 1e-6, "µ": 1e-6, "μ": 1e-6, "m": 1e-3, "c": 1e-2, "d": 0.1, "da": 10.0, "h": 1e2,
             "k": 1e3, "M": 1e6, "G": 1e9, "T": 1e12}
_PART = re.compile(r"\s*([*/]?)\s*(1|[^\s*/^()\d+-]+)(?:\^?(-?\d+))?")


def _symbol(name, text):
    if name in _ALONE:
        return _ALONE[name]
    if name in _PREFIXED:
        return _PREFIXED[name]
    for end in range(1, 3):
        if name[:end] in _PREFIXES and name[end:] in _PREFIXED:
            factor, dimension = _PREFIXED[name[end:]]
            return _PREFIXES[name[:end]] * factor, dimension
    raise InputError(f"the unit '{text}' cannot be read: '{name}' is not a unit known here")


def parse_unit(text):
    """Factor, offset and dimension of a unit: a value in it is factor * value + offset in SI. InputError."""
    text = text.strip()
    if text in ("degC", "°C"):
        return 1.0, 273.15, _dimension(K=1)
    factor, dimension, place, divided = 1.0, _NONE, 0, False
    while place < len(text):
        part = _PART.match(text, place)
        if not part or (not part[1] and divided) or (part[1] and place == 0):
            raise InputError(f"the unit '{text}' cannot be read from '{text[place:]}' on; write it as W/m/K, 1/cm^3")
        size, powers = _symbol(part[2], text)
        divided = divided or part[1] == "/"
        power = int(part[3] or 1) * (-1 if part[1] == "/" else 1)
        factor *= size**power
        dimension = tuple(a + power * b for a, b in zip(dimension, powers))
        place = part.end()
    return factor, 0.0, dimension


def quantity(text):
    """The value of a number and its unit ('900 K', '2 1/cm^3') in SI, and its dimension. InputError."""
    number, _, unit = text.strip().partition(" ")
    try:
        value = float(number)
    except ValueError as error:
        raise InputError(f"a number is expected, found '{text}'") from error
    factor, offset, dimension = parse_unit(unit) if unit else (1.0, 0.0, _NONE)
    return factor * value + offset, dimension


def si_unit(dimension):
    """A dimension in words of base units: 'kg m^-1 s^-2', '1' for a plain number."""
    return " ".join(name if power == 1 else f"{name}^{power}" for name, power in zip(BASE, dimension) if power) or "1"
