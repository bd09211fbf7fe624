"""Every way in which a population balance deck can be wrong ends in exit code 2 and exactly one message with its place.

Usage: population_input_test.py EXECUTABLE RANKS MPIEXEC...
"""

import os
import resource
import sys

import mistakes
import running

DECK = """problem: population_balance
initial:
  distribution: lognormal
  number: 1e6 1/cm^3
  diameter: 10 nm
  geometric_deviation: 1.5
processes:
  coagulation: {kernel: constant, rate: 1e-6 cm^3/s}
  breakage: {rate: 1 1/s}
methods:
  one: {type: dsmc, particles: 100}
time: {end: 50 s, outputs: 100}
repeats: 20
"""
COAGULATION = "{kernel: constant, rate: 1e-6 cm^3/s}"
BREAKAGE = "breakage: {rate: 1 1/s}"
METHOD = "{type: dsmc, particles: 100}"
NUCLEATION = "processes:\n  nucleation: "
INITIAL = DECK[DECK.index("initial:"):DECK.index("processes:")]
EMPTY = NUCLEATION + "{rate: 1 1/m^3/s, volume: 1 m^3}\n"

# Name, text to replace, its replacement, what the message says.
MISTAKES = [
    # More than the machine has, or than the limit that main() sets.
    ("particles beyond the memory", METHOD, "{type: dsmc, particles: 1e9}",
     ("methods.one.particles: a sample of 1000000000 particles needs at least 37.3 GiB of memory; there are",)),
    ("sizes beyond the memory", METHOD, "{type: hybrid, threshold: 100000000000}", ("methods.one.threshold",)),
    # The population at the start.
    ("unknown distribution", "lognormal", "gaussian", ("initial.distribution", "expected one of: none, monodisperse")),
    ("no size", "  diameter: 10 nm\n", "", ("initial: ", "needs either 'volume' or 'diameter'")),
    ("two sizes", "  diameter: 10 nm\n", "  diameter: 10 nm\n  volume: 1 nm^3\n", ("needs either 'volume' or 'diameter'",)),
    ("no width", "  geometric_deviation: 1.5\n", "", ("needs the key 'geometric_deviation'",)),
    ("width of none", "lognormal", "exponential", ("initial.geometric_deviation", "'initial.distribution: exponential' does not have this")),
    ("wrong unit of number", "1e6 1/cm^3", "1e6 1/cm^2", ("expected a number per volume", "found '1e6 1/cm^2', a number per area")),
    ("no number", "1e6 1/cm^3", "0 1/cm^3", ("initial.number", "above 0")),
    ("wrong in a mode", INITIAL, "initial:\n- {distribution: exponential, number: 1, volume: 1}\n- {distribution: lognormal, number: 1, volume: 1}\n",
     ("deck.yaml:4:3: initial[1]: ", "needs the key 'geometric_deviation'")),
    ("unknown key of a mode", INITIAL, "initial: [{distribution: exponential, number: 1, volum: 1}]\n", ("initial[0].volum: unknown key", "did you mean 'volume'?")),
    ("list of no particles", INITIAL, "initial: []\n", ("initial: there are no particles",)),
    ("table without a file", INITIAL, "initial: {distribution: table}\n", ("initial: the initial distribution table needs the key 'file'",)),
    ("no such table", INITIAL, "initial: {distribution: table, file: bins.csv}\n", ("initial.file: ", "bins.csv: there is no such file")),
    ("file of no table", "  diameter: 10 nm\n", "  diameter: 10 nm\n  file: bins.csv\n", ("initial.file", "'initial.distribution: lognormal' does not have this")),
    ("weights of equal ones", METHOD, "{type: dsmc, initial_weights: equal}", ("methods.one.initial_weights",)),
    ("no particles at all", INITIAL, "", ("initial: there are no particles",)),
    # Kernels.
    ("unknown kernel", "kernel: constant", "kernel: constnat", ("processes.coagulation.kernel", "did you mean 'constant'?")),
    ("unit of another kernel", COAGULATION, "{kernel: additive, rate: 1e-6 cm^3/s}",
     ("processes.coagulation.rate", "the kernel additive has this in 1/s", "found '1e-6 cm^3/s', a volume flow")),
    ("unit of the multiplicative kernel", COAGULATION, "{kernel: multiplicative, rate: 1 1/s}",
     ("has this in 1/m^3/s", "found '1 1/s', a rate")),
    ("negative rate", "1e-6 cm^3/s", "-1e-6 cm^3/s", ("processes.coagulation.rate", "at least 0")),
    ("no rate", COAGULATION, "{kernel: constant}", ("the kernel constant needs the key 'rate'",)),
    ("rate of a physical kernel", "kernel: constant", "kernel: continuum", ("rate", "'processes.coagulation.kernel: continuum' does not have this")),
    ("no temperature", COAGULATION, "{kernel: free_molecular}", ("processes.coagulation.kernel", "the kernel free_molecular needs 'gas.temperature'")),
    ("no viscosity", f"{COAGULATION}\n  {BREAKAGE}\n", "{kernel: transition}\ngas: {temperature: 300 K, pressure: 1 atm}\n",
     ("gas: ", "needs 'gas.viscosity'")),
    ("gas that nobody needs", "time:", "gas: {temperature: 300 K}\ntime:", ("gas.temperature", "'processes.coagulation.kernel: constant' does not have this")),
    ("gas without coagulation", f"  coagulation: {COAGULATION}\n  {BREAKAGE}\n", "  breakage: {rate: 1 1/s}\ngas: {temperature: 300 K}\n",
     ("gas.temperature: this counts only with 'processes.coagulation.kernel'",)),
    ("no shear rate", COAGULATION, "{kernel: shear}", ("needs the key 'shear_rate'",)),
    ("efficiency above one", "rate: 1e-6 cm^3/s", "rate: 1, efficiency: 1.5", ("efficiency", "at most 1")),
    ("half an efficiency", "rate: 1e-6 cm^3/s", "rate: 1, efficiency_diameter: 1 nm", ("belong together",)),
    # Other processes.
    ("no nucleus", "processes:\n", NUCLEATION + "{rate: 1 1/m^3/s}\n", ("nucleation needs either 'volume' or 'diameter'",)),
    ("no nucleation rate", "processes:\n", NUCLEATION + "{volume: 1 m^3}\n", ("nucleation with the source constant needs the key 'rate'",)),
    ("key of another source", "processes:\n", NUCLEATION + "{rate: 1, volume: 1, precursor: 1}\n", ("precursor", "'processes.nucleation.source: constant' does not have this")),
    ("table of unequal length", "processes:\n", NUCLEATION + "{source: table, volume: 1, times: [0, 1, 2], rates: [1, 2]}\n",
     ("processes.nucleation.rates", "as many rates as times", "found 2 rates and 3 times")),
    ("table that goes back", "processes:\n", NUCLEATION + "{source: table, volume: 1, times: [0, 1, 1], rates: [1, 2, 3]}\n",
     ("processes.nucleation.times[2]", "have to rise")),
    ("three uniform daughters", BREAKAGE, "breakage: {rate: 1 1/s, fragments: 3, daughters: uniform}", ("breakage.daughters", "uniform daughters are two")),
    ("one fragment", BREAKAGE, "breakage: {rate: 1 1/s, fragments: 1}", ("breakage.fragments", "from 2 to")),
    ("reference of a constant rate", BREAKAGE, "breakage: {rate: 1 1/s, reference_volume: 1 m^3}", ("does not depend on the volume",)),
    ("growth of nothing", BREAKAGE, "growth: {step: 1 s}", ("processes.growth: there is no condensation, surface_growth or oxidation",)),
    ("jumps without a monomer", BREAKAGE, "condensation: {rate: 1 1/s}\n  growth: {treatment: jumps}", ("the treatment jumps needs the key 'monomer'",)),
    ("negative oxidation", BREAKAGE, "oxidation: {rate: -1 m/s}", ("processes.oxidation.rate", "above 0")),
    # Methods.
    ("no methods", DECK[DECK.index("methods:"):DECK.index("time:")], "", ("methods: this section is missing or empty",)),
    ("unknown method", "type: dsmc", "type: dscm", ("methods.one.type", "did you mean 'dsmc'?")),
    ("unknown key of a method", "particles: 100", "particels: 100", ("unknown key 'particels'", "did you mean 'particles'?")),
    ("name of a method", "  one:", "  one/two:", ("methods.one/two", "letters, digits")),
    ("key of another method", METHOD, "{type: dsmc, merging: relative}", ("methods.one.merging", "'methods.one.type: dsmc' does not have this; leave it out, or choose: sammc")),
    ("sections of a Monte Carlo method", METHOD, "{type: mmc, sections: 100}", ("'methods.one.type: mmc' does not have this; leave it out, or choose: sectional",)),
    ("particles of the sections", METHOD, "{type: sectional, particles: 100}", ("methods.one.particles", "does not have this")),
    ("no particles", "particles: 100", "particles: 0", ("methods.one.particles", "from 2 to")),
    ("fraction constant of zero", METHOD, "{type: wfmc, fraction: constant, fraction_constant: 0}", ("fraction_constant", "above 0")),
    ("fraction constant above one", METHOD, "{type: wfmc, fraction: constant, fraction_constant: 1.01}", ("fraction_constant", "at most 1")),
    ("no fraction constant", METHOD, "{type: wfmc, fraction: constant}", ("needs the key 'fraction_constant'",)),
    ("constant of another fraction", METHOD, "{type: wfmc, fraction: hyperbolic, fraction_constant: 0.5}", ("'methods.one.fraction: hyperbolic' does not have this",)),
    ("fraction of nothing", METHOD, "{type: wfmc, fraction_of: weights}", ("methods.one.fraction_of: this counts only with 'methods.one.fraction'",)),
    ("weight of zero", METHOD, "{type: sammc, nucleus_weight: 0}", ("methods.one.nucleus_weight", "above 0")),
    ("negative weight", METHOD, "{type: sammc, nucleus_weight: -1}", ("methods.one.nucleus_weight", "above 0")),
    ("weight without nucleation", METHOD, "{type: sammc, nucleus_weight: 1}", ("methods.one.nucleus_weight", "there is no nucleation")),
    ("empty start", INITIAL + "processes:\n", EMPTY, ("methods.one", "needs the key 'expected_number'")),
    ("expected number of particles that are there", METHOD, "{type: dsmc, expected_number: 1 1/m^3}", ("that of 'initial'; leave this key out",)),
    ("claims", METHOD, "{type: dsmc, unbiased_moments: [M4]}", ("methods.one.unbiased_moments", "M0, M1, M2, M3")),
    ("no first section", METHOD, "{type: sectional, spacing: 2}", ("needs the key 'smallest'",)),
    ("two spacings", METHOD, "{type: sectional, smallest: 1 nm^3, spacing: 2, largest: 1 um^3}", ("needs either 'spacing' or 'largest'",)),
    ("sections above the particles", METHOD, "{type: sectional, smallest: 1 um^3, largest: 1000 um^3}", ("methods.one.smallest: the first pivot is above the initial particles",)),
    ("the same claim twice", METHOD, "{type: dsmc, unbiased_moments: [M0, M1, M0]}", ("methods.one.unbiased_moments: M0 is named twice",)),
    ("nuclei that never come", INITIAL + "processes:\n", NUCLEATION + "{source: table, volume: 1 nm^3, times: [51 s, 60 s], rates: [1, 1]}\n",
     ("processes.nucleation.rates: there are no particles",)),
    ("nuclei that vanish at once", "processes:\n", NUCLEATION + "{rate: 1, diameter: 1 nm}\n  oxidation: {rate: 1e-12 m/s}\n  growth: {smallest_volume: 1 nm^3}\n",
     ("processes.growth.smallest_volume: particles begin with 5.236e-28 m3",)),
    ("monomers above nuclei", "processes:\n", NUCLEATION + "{rate: 1, diameter: 1 nm}\n  surface_growth: {rate: 1e-12 m/s}\n  growth: {treatment: jumps, monomer: 1 nm^3}\n",
     ("processes.growth.monomer: expected at most the 5.236e-28 m3",)),
    ("monomer of split growth", "processes:\n", "processes:\n  surface_growth: {rate: 1e-12 m/s}\n  growth: {monomer: 1 nm^3}\n",
     ("processes.growth.monomer: 'processes.growth.treatment: split' does not have this; leave it out, or choose: jumps",)),
    ("condensation beyond numbers", BREAKAGE, "condensation: {rate: 1e3 1/s}", ("processes.condensation.rate: until time.end every volume changes by the factor e^5e+04", "a rate up to 12 1/s")),
    ("collisions beyond numbers", f"{COAGULATION}\n  {BREAKAGE}\n", "{kernel: constant, rate: 1e300 m^3/s}\n",
     ("processes.coagulation.rate: until time.end collisions lower the number density by the factor e^inf; expected e^600 at most",)),
    ("additive collisions beyond numbers", f"{COAGULATION}\n  {BREAKAGE}\n", "{kernel: additive, rate: 1e300 1/s}\n",
     ("processes.coagulation.rate: until time.end collisions lower the number density",)),
    ("evaporation beyond numbers", BREAKAGE, "condensation: {rate: -1e3 1/s}", ("processes.condensation.rate: until time.end",)),
    ("deposition beyond numbers", BREAKAGE, "deposition: {rate: 1e30 1/s}", ("processes.deposition.rate: until time.end the number density",)),
    ("breakage beyond numbers", BREAKAGE, "breakage: {rate: 13 1/s}", ("processes.breakage.rate: until time.end the number density",)),
    ("dilution beyond numbers", BREAKAGE, "dilution: {rate: -13 1/s}", ("processes.dilution.rate: until time.end every number density",)),
    # The rest.
    ("zero repeats", "repeats: 20", "repeats: 0", ("repeats", "from 1 to")),
    ("negative seed", "repeats: 20", "seed: -1", ("seed", "at least 0")),
    ("zero time", "end: 50 s", "end: 0 s", ("time.end", "above 0")),
    ("no first row", "outputs: 100", "spacing: logarithmic", ("needs the key 'first'",)),
    ("first row at the end", "outputs: 100", "spacing: logarithmic, first: 50 s", ("time.first", "before time.end")),
    ("first of linear rows", "outputs: 100", "first: 5 s", ("time.first", "'time.spacing: linear' does not have this")),
    ("bins from zero", "repeats: 20", "distribution: {minimum: 0, maximum: 1}", ("distribution.minimum", "above 0")),
    ("bins backwards", "repeats: 20", "distribution: {minimum: 1, maximum: 1}", ("distribution.maximum", "above distribution.minimum")),
    ("distribution after the end", "repeats: 20", "distribution: {minimum: 1, maximum: 2, times: [1 s, 51 s]}", ("distribution.times[1]", "after time.end")),
]


def main(executable: str, ranks: str, *mpiexec: str) -> int:
    program = running.Program(executable, list(mpiexec), int(ranks))
    # A machine of 16 GiB, whatever it is; the address sanitizer (scripts/test sets its options) cannot live with that.
    if "ASAN_OPTIONS" not in os.environ:
        resource.setrlimit(resource.RLIMIT_AS, (16 << 30, resource.getrlimit(resource.RLIMIT_AS)[1]))
    return 1 if mistakes.failures_of(program, [(name, DECK, *rest) for name, *rest in MISTAKES]) else 0


sys.exit(main(*sys.argv[1:]))
