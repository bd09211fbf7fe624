"""Every way in which a reactor deck can be wrong ends in exit code 2 and exactly one message that names the place.

Usage: reactor_input_test.py EXECUTABLE RANKS MPIEXEC...
"""

import sys

import mistakes
import running

HYDROGEN = running.SOURCE / "cases/mechanisms/hydrogen_h2o2_10.yaml"
ETHYLENE = running.SOURCE / "cases/mechanisms/ethylene_abf2000_101.yaml"

CLOSED = f"""problem: reactor
mechanism: {HYDROGEN}
reactor:
  type: constant_pressure
initial:
  temperature: 1200 K
  fuel: "H2: 1"
  oxidizer: "O2: 1, N2: 3.76"
  equivalence_ratio: 1
time:
  end: 1 ms
sensitivity:
  reactions: [all]
"""

STIRRED = f"""problem: reactor
mechanism: {HYDROGEN}
reactor:
  type: stirred
  residence_time: 1 ms
inlet:
  temperature: 300 K
  composition: "H2: 2, O2: 1, N2: 3.76"
"""

PLUG_FLOW = f"""problem: reactor
mechanism: {HYDROGEN}
reactor:
  type: plug_flow
  length: 1 m
inlet:
  temperature: 1200 K
  composition: "H2: 2, O2: 1, N2: 3.76"
  velocity: 1 m/s
"""

NETWORK = f"""problem: reactor
mechanism: {HYDROGEN}
reactor:
  type: network
network:
  reactors:
    one: {{volume: 1 cm^3}}
    two: {{residence_time: 1 ms}}
  inlets:
    feed: {{to: one, mass_flow: 1 g/s, temperature: 300 K, composition: "H2: 2, O2: 1, N2: 3.76"}}
  connections:
    - {{from: one, to: two}}
"""

TREES = f"""problem: reactor
mechanism: {HYDROGEN}
reactor:
  type: constant_pressure
  energy: isothermal
initial:
  temperature: 1173 K
  composition: "N2: 1"
time:
  end: 1 ms
particles:
  material: silica
  description: trees
  number: 100
"""

OWN_TREES = TREES.replace(str(HYDROGEN), str(ETHYLENE)).replace("silica", "table") + """  density: 1800 kg/m^3
  table:
    name: own
    components:
      - {name: CH, weight: 13.019 g/mol, elements: [C, H], atoms: [1, 1]}
      - {name: C2, weight: 24.022 g/mol, elements: [C], atoms: [2]}
    precursor: C2H2
    product: H2
    molecule_mass: 4.3e-26 kg
    molecule_diameter: 0.4 nm
    nucleus: [2, 1]
    site: CH
    bridge: C2
    growth: [2, 0]
    growth_products: 0
"""

# Particles of nitrogen, whose heat nobody knows.
FROZEN_TREES = TREES.replace("silica", "table") + """  density: 1027 kg/m^3
  table:
    name: frozen
    components:
      - {name: site, weight: 28.014 g/mol, elements: [N], atoms: [2]}
      - {name: bulk, weight: 28.014 g/mol, elements: [N], atoms: [2]}
    precursor: N2
    product: N2
    molecule_mass: 4.65e-26 kg
    molecule_diameter: 0.4 nm
    nucleus: [1, 0]
    site: site
    bridge: bulk
    growth: [1, 0]
    growth_products: 0
"""

SOOT_TREES = TREES.replace(str(HYDROGEN), str(ETHYLENE)).replace("silica", "soot") + "  pah: [A2]\n"

# Name, deck, text to replace, its replacement, what the message says.
SOOT = f"""problem: reactor
mechanism: {ETHYLENE}
reactor:
  type: stirred
  residence_time: 1 ms
inlet:
  temperature: 300 K
  composition: "C2H4: 0.11, O2: 0.17, N2: 0.72"
particles:
  description: two_equation_dimer
  pah: [A2]
"""
ENSEMBLE = "description: two_equation_dimer", "description: ensemble"

CLOSED_SOOT = CLOSED[:CLOSED.index("sensitivity:")].replace(str(HYDROGEN), str(ETHYLENE)) + "particles:\n  description: two_equation_dimer\n  pah: [A2]\n"

SOOT_MISTAKES = [
    ("soot of another mechanism", STIRRED, "inlet:", "particles: {description: hmom}\ninlet:", ("particles",)),
    ("diffusion in a reactor", SOOT, "pah: [A2]", "diffusion: true", ("particles.diffusion: a reactor is well mixed",)),
    ("unknown model", SOOT, "description: two_equation_dimer", "description: three_equation", ("particles.description",)),
    ("PAH that is none", SOOT, "pah: [A2]", "pah: [A1]", ("particles.pah", "is not a polycyclic aromatic hydrocarbon")),
    ("sensitivities with soot", CLOSED_SOOT, "pah: [A2]", "pah: [A2]\nsensitivity: {reactions: [all]}",
     ("sensitivity: sensitivities are those of a gas alone",)),
    ("ignition with an ensemble", CLOSED_SOOT, "description: two_equation_dimer\n  pah: [A2]", "description: ensemble\nignition: {species: [OH]}",
     ("ignition: ignition delays of a gas with an ensemble",)),
    ("steady ensemble in a network", NETWORK.replace(str(HYDROGEN), str(ETHYLENE)), "\nnetwork:\n", "\nparticles: {description: ensemble}\nnetwork:\n",
     ("particles: the steady state of an ensemble is a mean over time",)),
    ("network in time without ensembles", NETWORK, "\nnetwork:\n", "\ntime: {end: 1 ms}\nnetwork:\n",
     ("time.end: the steady state of a network is computed",)),
    ("ensemble of a reactor whose name no results can have", NETWORK.replace(str(HYDROGEN), str(ETHYLENE)).replace("one", "a/b"),
     "\nnetwork:\n", "\ntime: {end: 1 ms}\nparticles: {description: ensemble}\nnetwork:\n", ("network.reactors.a/b: results of ensembles",)),
    ("particles without a description", SOOT, "description: two_equation_dimer", "density: 1800 kg/m^3",
     ("particles.description: this key is missing",)),
    ("ensemble beside a model of former sections", SOOT, "particles:\n  description: two_equation_dimer", "stochastic: {repeats: 2}\nsoot:\n  model: hmom",
     ("soot.model: an ensemble or trees take the place of a model",)),
    ("former sections beside the present one", SOOT, "particles:", "soot: {pah: [A2]}\nparticles:",
     ("soot: the section 'particles' has taken its place",)),
    ("a number of a model", SOOT, "pah: [A2]", "number: 100", ("particles.number: 'particles.description: two_equation_dimer' does not have this",)),
    ("a model beside an ensemble", SOOT, "description: two_equation_dimer", "description: ensemble\n  carried: hmom", ("unknown key 'carried'",)),
    ("spheres of silica", TREES, "description: trees", "description: ensemble\n  shape: spheres", ("particles.shape: spheres are of soot",)),
    ("a model of silica", TREES, "description: trees\n  number: 100", "description: hmom", ("particles.description: hmom is a model of soot",)),
    ("a method of silica", TREES, "description: trees", "description: ensemble\n  method: dsmc", ("particles.method: 'particles.material: silica' does not have this",)),
    ("a kernel of spheres", SOOT, "description: two_equation_dimer", "description: ensemble\n  kernel: continuum",
     ("particles.kernel: 'particles.description: ensemble' does not have this; leave it out, or choose: trees, molecules, none; or 'particles.material': silica, table",)),
    ("steady ensemble", SOOT, *ENSEMBLE,
     ("particles: the steady state of an ensemble is a mean over time",)),
    ("key of flames", SOOT, "description: two_equation_dimer", "description: ensemble\n  coupling: two_way", ("particles.coupling",)),
    ("a fractal dimension of spheres", SOOT, "description: two_equation_dimer", "description: ensemble\n  fractal_dimension: 1.8",
     ("particles.fractal_dimension: 'particles.description: ensemble' does not have this",)),
    ("a fractal dimension above three", SOOT, "description: two_equation_dimer", "description: ensemble\n  shape: surface_volume\n  fractal_dimension: 3.5",
     ("particles.fractal_dimension", "from 1 to 3")),
    ("one repeat", SOOT, "description: two_equation_dimer", "description: ensemble\n  repeats: 1", ("particles.repeats",)),
]

MISTAKES = SOOT_MISTAKES + [
    ("particles without their species", TREES, "number: 100", "number: 200", ["particles", "H4O4SI"]),
    ("particles of unknown heat", FROZEN_TREES, "energy: isothermal", "energy: adiabatic", ["reactor.energy", "isothermal"]),
    ("negative sintering", TREES, "number: 100", "sintering: {prefactor: -1}", ["particles.sintering.prefactor"]),
    ("negative temperature of sintering", TREES, "number: 100", "sintering: {activation_temperature: -1 K}", ["particles.sintering"]),
    ("particles at the start by half", TREES, "number: 100", "initial: {number: 1e14 1/m^3}", ["particles.initial"]),
    ("units below zero", TREES, "number: 100", "initial: {number: 1e14 1/m^3, units: [1, -1, 0]}", ["units"]),
    ("parts by the smaller primary", TREES, "number: 100", "sintering: {between: parts}", ["particles.sintering.size"]),
    ("former sections of soot and of silica", TREES, "particles:\n  material: silica\n  description: trees", "soot: {model: none}\nparticles:\n  material: silica", ["soot: the particles of the deck are of silica"]),
    ("too much smoothing", TREES, "number: 100", "smoothing: 2.5", ["particles.smoothing"]),
    ("necks without primaries", TREES, "description: trees", "description: ensemble\n  sintering: {between: neighbours}",
     ["particles.sintering.between: 'particles.description: ensemble' does not have this"]),
    ("tables without primaries", TREES, "description: trees", "description: ensemble\n  tables_at: [1 ms]",
     ["particles.tables_at: 'particles.description: ensemble' does not have this"]),
    ("trees of a shape", SOOT_TREES, "number: 100", "shape: surface_volume", ["particles.shape: 'particles.description: trees' does not have this"]),
    ("a component without mass", OWN_TREES, "24.022 g/mol", "0 g/mol", ["particles.table.components[1].weight"]),
    ("a component of too few atoms", OWN_TREES, "[C, H], atoms: [1, 1]", "[C, H], atoms: [1]", ["components[0].atoms", "1 numbers for 2 elements"]),
    ("a nucleus of other components", OWN_TREES, "nucleus: [2, 1]", "nucleus: [2, 1, 0]", ["particles.table.nucleus", "3 numbers for 2 components"]),
    ("a nucleus of nothing", OWN_TREES, "nucleus: [2, 1]", "nucleus: [4, 0]", ["inception makes 2 atoms of H of nothing"]),
    ("a site that is no component", OWN_TREES, "site: CH", "site: CD", ["particles.table.site", "no component 'CD'"]),
    ("sites that are bridges", OWN_TREES, "bridge: C2", "bridge: CH", ["two components"]),
    ("a species that is not there", OWN_TREES, "precursor: C2H2", "precursor: TICL4", ["need the species 'TICL4'"]),
    ("a negative rate", OWN_TREES, "density: 1800", "growth_rate: -1 cm^3/mol/s\n  density: 1800", ["particles.growth_rate"]),
    ("a table without one", TREES, "material: silica", "material: table", ["particles.material", "needs the section 'particles.table'"]),
    ("a table beside a material", OWN_TREES, "material: table", "material: silica", ["particles.table: 'particles.material: silica' does not have this"]),
    ("former trees of soot with a model", SOOT_TREES, "  description: trees\n  number: 100\n  pah: [A2]", "  number: 100\nsoot: {model: hmom}", ["soot.model: an ensemble or trees take the place of a model"]),
    ("former soot of two densities", SOOT_TREES, "  description: trees\n  number: 100\n  pah: [A2]", "  density: 1800 kg/m^3\nsoot: {density: 1700 kg/m^3}",
     ["soot.density: this is 'particles.density' now, which is given too"]),
    ("PAH of silica", TREES, "number: 100", "pah: [A2]", ["particles.pah: 'particles.material: silica' does not have this"]),
    ("sites of soot", SOOT_TREES, "number: 100", "growth_rate: 1 cm^3/mol/s", ["particles.growth_rate: 'particles.material: soot' does not have this"]),
    ("necks of silica that break", TREES, "number: 100", "fragmentation: true", ["particles.fragmentation: 'particles.material: silica' does not have this"]),
    ("a factor of breaking silica", TREES, "number: 100", "fragmentation_factor: 1e5", ["particles.fragmentation_factor: 'particles.material: silica' does not have this"]),
    ("a negative factor of fragmentation", SOOT_TREES, "number: 100", "fragmentation: true\n  fragmentation_factor: -1", ["particles.fragmentation_factor", "at least 0"]),
    ("sintering of soot by nothing", SOOT_TREES, "number: 100", "sintering: {mechanism: constant}", ["particles.sintering", "needs the key 'prefactor'"]),
    ("units of soot", SOOT_TREES, "number: 100", "initial: {number: 1e14 1/m^3, units: [1, 1, 0]}", ["particles.initial.units", "3 numbers for 2 components of soot"]),
    ("soot of nothing", SOOT_TREES, "number: 100", "initial: {number: 1e14 1/m^3, units: [0, 0]}", ["an initial particle needs mass"]),
    ("a material without a name", TREES, "material: silica", "material: gold", ["particles.material"]),
    ("no problem", CLOSED, "problem: reactor\n", "", ("problem: this key is missing", "flow, flame1d, reactor")),
    ("misspelt problem", CLOSED, "problem:", "probelm:", ("unknown key 'probelm'", "did you mean 'problem'?")),
    ("mole fractions by another name", STIRRED, "composition:", "mole_fractions:", ("unknown key 'mole_fractions'", "did you mean 'composition'?")),
    ("a mechanism of CHEMKIN", CLOSED, str(HYDROGEN), str(running.SOURCE / "README.md"), ("mechanism: ", "expected YAML, which 'lampblack mechanism")),
    ("unknown problem", CLOSED, "problem: reactor", "problem: reacter", ("expected one of: flow, flame1d, reactor", "did you mean 'reactor'?")),
    ("key of another problem", CLOSED, "time:", "mesh:\n  refinement: 1\ntime:", ("mesh: unknown key 'mesh'",)),
    ("unknown phase", CLOSED, "reactor:\n  type", "phase: liquid\nreactor:\n  type", ("mechanism", "there is no phase 'liquid'", "'gas' (ideal-gas)")),
    ("unknown type", CLOSED, "constant_pressure", "constant_presure", ("reactor.type", "constant_pressure")),
    ("no initial state", CLOSED, CLOSED[CLOSED.index("initial:"):CLOSED.index("time:")], "", ("needs the section 'initial'",)),
    ("no end", CLOSED, "time:\n  end: 1 ms\n", "", ("needs the key 'end'",)),
    ("no mixture", CLOSED, CLOSED[CLOSED.index("  fuel:"):CLOSED.index("time:")], "", ("initial: the mixture is missing",)),
    ("two mixtures", CLOSED, "  fuel:", '  composition: "H2: 1"\n  fuel:', ("initial: the mixture is given twice",)),
    ("no ratio", CLOSED, "  equivalence_ratio: 1\n", "", ("'equivalence_ratio' is missing",)),
    ("fuel that is none", CLOSED, '"H2: 1"', '"N2: 1"', ("the fuel needs no oxygen",)),
    ("oxidizer that is none", CLOSED, '"O2: 1, N2: 3.76"', '"N2: 1"', ("the oxidizer has no oxygen",)),
    ("unknown species", CLOSED, '"H2: 1"', '"HH2: 1"', ("initial.fuel", "unknown species 'HH2'", "'H2'")),
    ("too hot", CLOSED, "1200 K", "12000 K", ("initial.temperature", "12000 K")),
    ("unknown reaction", CLOSED, "[all]", "['H + O2 <=> O + HO']", ("no reaction 'H + O2 <=> O + HO'", "did you mean")),
    ("reaction out of range", CLOSED, "[all]", "[30]", ("there is no reaction 30; expected 1 to 29",)),
    ("species of ignition", CLOSED, "sensitivity:", "ignition:\n  species: [OHX]\nsensitivity:", ("ignition.species", "unknown species 'OHX'")),
    ("species of ignition twice", CLOSED, "sensitivity:", "ignition:\n  species: [OH, H, OH]\nsensitivity:", ("ignition.species: 'OH' is named twice",)),
    ("species of the output twice", CLOSED, "sensitivity:", "output:\n  species: [OH, OH]\nsensitivity:", ("output.species: 'OH' is named twice",)),
    ("reaction twice", CLOSED, "[all]", "[3, 3]", ("sensitivity.reactions: the reaction '3' is named twice",)),
    ("rows beyond the disk", CLOSED, "sensitivity:", "output:\n  interval: 1e-15 s\nsensitivity:", ("output.interval: about 1e+12 rows of the history",)),
    ("rows of a plug flow", PLUG_FLOW, "  length: 1 m", "  length: 1 m\noutput:\n  spacing: 1e-12 m", ("output.spacing: about 1e+12 rows",)),
    ("profile without energy", CLOSED, "time:", "temperature_profile:\n  time: [0 s]\n  temperature: [300 K]\ntime:", ("'reactor.energy: adiabatic' does not have this; leave it out, or choose: profile",)),
    ("energy without profile", CLOSED, "  type: constant_pressure", "  type: constant_pressure\n  energy: profile", ("needs the section 'temperature_profile'",)),
    ("section of another type", CLOSED, "time:", "network: {reactors: {a: {volume: 1 m^3}}, inlets: {b: {to: a, mass_flow: 1, temperature: 300}}}\ntime:", ("network: 'reactor.type: constant_pressure' does not have this",)),
    ("sensitivity of what does not burn", CLOSED, '"O2: 1, N2: 3.76"\n  equivalence_ratio: 1', '"O2: 1, N2: 3.76"\n  equivalence_ratio: 0',
     ("sensitivity: this gas does not ignite: its equilibrium from 1200 K is at 1200",)),
    ("rise of what does not burn", CLOSED, CLOSED[CLOSED.index("  fuel"):CLOSED.index("sensitivity")],
     '  composition: "N2: 1"\ntime: {end: 1 ms}\nignition: {temperature_rise: 400 K}\n', ("ignition.temperature_rise: this gas does not ignite",)),
    ("reaction twice", CLOSED, "[all]", "[3, 3]", ("sensitivity.reactions: the reaction '3' is named twice",)),
    ("species of ignition twice", CLOSED, "sensitivity:", "ignition: {species: [OH, OH]}\nsensitivity:", ("ignition.species: 'OH' is named twice",)),
    ("all and more", CLOSED, "sensitivity:", "output: {species: [OH, all]}\nsensitivity:", ("output.species: 'all' stands alone",)),
    ("rise of an isothermal reactor", CLOSED, "constant_pressure", "constant_pressure\n  energy: isothermal\nignition: {temperature_rise: 400 K}",
     ("ignition.temperature_rise: 'reactor.energy: isothermal' does not have this; leave it out, or choose: adiabatic",)),
    ("rows beyond the end", CLOSED, "sensitivity:", "output: {interval: 2 ms}\nsensitivity:", ("output.interval: expected no more than time.end",)),
    ("rows beyond the duct", PLUG_FLOW, "inlet:", "output: {spacing: 2 m}\ninlet:", ("output.spacing: expected no more than reactor.length",)),
    ("key of another reactor", CLOSED, "  type: constant_pressure", "  type: constant_pressure\n  residence_time: 1 s",
     ("reactor.residence_time: 'reactor.type: constant_pressure' does not have this; leave it out, or choose: stirred",)),
    ("temperature of an adiabatic reactor", CLOSED, "  type: constant_pressure", "  type: constant_pressure\n  temperature: 900 K",
     ("reactor.temperature: 'reactor.energy: adiabatic' does not have this",)),
    ("profile over time along a duct", PLUG_FLOW, "  length: 1 m", "  length: 1 m\n  energy: profile\ntemperature_profile: {time: [0 s], temperature: [900 K]}",
     ("temperature_profile.time: 'reactor.type: plug_flow' does not have this",)),
    ("end of a plug flow", PLUG_FLOW, "inlet:", "time: {end: 1 s}\ninlet:", ("time.end: 'reactor.type: plug_flow' does not have this",)),
    ("area of a velocity", PLUG_FLOW, "  length: 1 m", "  length: 1 m\n  area: 1 cm^2", ("reactor.area: the area is only used with 'inlet.mass_flow'",)),
    ("plug flow near the speed of sound", PLUG_FLOW, "1 m/s", "300 m/s", ("inlet.velocity: 300 m/s is Mach 0.3",)),
    ("rows of a steady state", STIRRED, "inlet:", "output: {interval: 1 ms}\ninlet:", ("output.interval: without time.end the steady state is computed",)),
    ("tolerance of a network", NETWORK, "network:", "integrator: {relative_tolerance: 1e-6}\nnetwork:", ("integrator: without time.end the steady state is computed",)),
    ("stirred without a size", STIRRED, "  residence_time: 1 ms\n", "", ("needs either 'volume' or 'residence_time'",)),
    ("volume without flow", STIRRED, "residence_time: 1 ms", "volume: 1 cm^3", ("needs the key 'mass_flow'",)),
    ("ignition of a stirred reactor", STIRRED, "inlet:", "ignition:\n  species: [OH]\ninlet:", ("ignition: 'reactor.type: stirred' does not have this",)),
    ("plug flow without flow", PLUG_FLOW, "  velocity: 1 m/s\n", "", ("needs either 'velocity' or 'mass_flow'",)),
    ("plug flow without length", PLUG_FLOW, "  length: 1 m\n", "", ("needs the key 'length'",)),
    ("a reactor before a duct of no size", PLUG_FLOW, "inlet:", "upstream: {residence_times: 5}\ninlet:", ("upstream: a stirred reactor needs either",)),
    ("a volume before a duct without flow", PLUG_FLOW, "inlet:", "upstream: {volume: 1 cm^3}\ninlet:", ("inlet: a stirred reactor before the duct",)),
    ("an isothermal duct of an unknown temperature", PLUG_FLOW, "  length: 1 m", "  length: 1 m\n  energy: isothermal\nupstream: {residence_time: 1 ms}",
     ("reactor.energy: behind a stirred reactor",)),
    ("a reactor before a stirred one", STIRRED, "inlet:", "upstream: {residence_time: 1 ms}\ninlet:", ("upstream: 'reactor.type: stirred' does not have this",)),
    ("unknown reactor", NETWORK, "to: two", "to: twoo", ("network.connections[0].to", "no reactor 'twoo'", "did you mean 'two'?")),
    ("reactor without inflow", NETWORK, "    - {from: one, to: two}\n", "    - {from: two, to: one}\n", ("network.reactors.two: nothing flows into this reactor",)),
    ("more out than in", NETWORK, "to: two}", "to: two, mass_flow: 2 g/s}", ("network.reactors.one", "only 0.001 kg/s flow through it")),
    ("loop that lets nothing out", NETWORK, "    - {from: one, to: two}\n", "    - {from: one, to: two}\n    - {from: two, to: one}\n", ("lets nothing out",)),
]


def main(executable: str, ranks: str, *mpiexec: str) -> int:
    program = running.Program(executable, list(mpiexec), int(ranks))
    return 1 if mistakes.failures_of(program, MISTAKES) else 0


sys.exit(main(*sys.argv[1:]))
