"""Decks that run in a moment, as several tests want them."""

import running


def population(methods: str, repeats: int, outputs: int, bins: int, times: list) -> str:
    """Equal particles that coagulate, until the last of the times (in s) of a size distribution."""
    return f"""problem: population_balance
initial: {{distribution: monodisperse, number: 1e6 1/cm^3, volume: 1 m^3}}
processes: {{coagulation: {{kernel: constant, rate: 1e-6 cm^3/s}}}}
methods: {{{methods}}}
time: {{end: {times[-1]} s, outputs: {outputs}}}
repeats: {repeats}
distribution: {{minimum: 0.5 m^3, maximum: 50.5 m^3, bins: {bins}, spacing: linear, times: {times}}}
"""


def free_flame(mechanism: str, fuel: str, slope: float, curve: float) -> str:
    """A stoichiometric flame in air."""
    return f"""problem: flame1d
mechanism: {running.SOURCE}/cases/mechanisms/{mechanism}
flame: {{type: free, length: 20 mm}}
inlet: {{temperature: 298 K, fuel: "{fuel}: 1", oxidizer: "O2: 1, N2: 3.76", equivalence_ratio: 1}}
grid: {{slope: {slope:g}, curve: {curve:g}}}
"""
