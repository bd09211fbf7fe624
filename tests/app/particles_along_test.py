"""Particles along a given gas: the shortened case on any number of ranks, what its files say, models beside ensembles, the
path through a flame; and what is refused.

Usage: particles_along_test.py EXECUTABLE RANKS MPIEXEC...
"""

import csv
import pathlib
import sys
import tempfile

import running

h5py, np = running.package("h5py"), running.package("numpy")

CASE = running.SOURCE / "cases/particles_along/premixed_ethylene_abf"
SILICA = running.SOURCE / "cases/particles_along/silica_teos"
MECHANISM = running.SOURCE / "cases/mechanisms/ethylene_abf2000_101.yaml"
MOLECULES = running.SOURCE / "cases/particles_along/premixed_ethylene_molecules"
SHORT = ("particles.number=256", "particles.repeats=3", "gas.end=8 ms", "output.interval=2 ms", "output.times=[5 ms]",
         "particles.split_tolerance=0.05", "particles.smallest=0.5 nm")
GAS = ("time [s],temperature [K],pressure [Pa],X_AR,X_A4,X_H\n0,1700,1e5,0.999,1e-6,1e-4\n0.01,1700,1e5,0.999,1e-6,1e-4\n")
MODEL = """problem: prescribed_gas
mechanism: {mechanism}
gas: {{file: gas.csv}}
particles: {{description: {model}, pah: [A4]}}
output: {{interval: 5 ms}}
"""

FLAME = f"""problem: flame1d
mechanism: {MECHANISM.parent}/ethylene_bisetti2012_47.yaml
flame: {{type: burner, energy: given, length: 6 mm}}
inlet: {{temperature: 300 K, composition: "C2H4: 0.16, O2: 0.24, N2: 0.6", velocity: 6 cm/s}}
temperature_profile: {{position: [0 mm, 1 mm, 2 mm, 6 mm], temperature: [300 K, 1500 K, 1700 K, 1600 K]}}
grid: {{refine: false, initial_points: 20}}
solver: {{species_tolerance: 1e-8}}
"""
ALONG_FLAME = f"""problem: prescribed_gas
mechanism: {MECHANISM.parent}/ethylene_bisetti2012_47.yaml
gas: {{flame: flame/results.h5}}
particles: {{description: ensemble, pah: [A2], number: 100, repeats: 2}}
"""
# Without the gas.
TREES_ALONG_FLAME = f"""problem: prescribed_gas
mechanism: {MECHANISM.parent}/ethylene_bisetti2012_47.yaml
particles: {{description: trees, pah: [A2], number: 50, repeats: 2, expected_number: 1e16 1/m^3}}
"""

# Rows of the gas, keys, and words of the message.
WRONG_GAS = (("0,1700,1e5,0.999,1e-6,1e-4\n0,1700,1e5,0.999,1e-6,1e-4\n", "the times have to rise"),
             ("0,1700,1e5,0.999,1e-6,1e-4\n0.01,-3,1e5,0.999,1e-6,1e-4\n", "above 0 K"),
             ("0,1700,0,0.999,1e-6,1e-4\n0.01,1700,1e5,0.999,1e-6,1e-4\n", "above 0 Pa"),
             ("0,1700,1e5,0.5,1e-6,1e-4\n0.01,1700,1e5,0.999,1e-6,1e-4\n", "add up to 0.5001"),
             ("0,1700,1e5,0.999,-1e-3,1e-4\n0.01,1700,1e5,0.999,1e-6,1e-4\n", "mole fraction of A4"),
             ("0,1700,1e5,0.999,nan,1e-4\n0.01,1700,1e5,0.999,1e-6,1e-4\n", "line 2"))
WRONG = (("particles.coupling_change=0.1", "particles.coupling_change", "one_way"),
         ("gas.depleted=[A4]", "gas.depleted", "two_way"),
         ("gas.file=nowhere.csv", "gas.file", "nowhere.csv"),
         ("gas.flame=gas.csv", "gas", "either 'file'"),
         ("gas.side=right", "gas.side", "leave it out"),
         ("gas.end=1 s", "gas.end", "as far as the gas is known"),
         ("output.times=[30 ms]", "output.times", "outside the run"),
         ("particles.description=hmom", "particles.method", "does not have this"),
         ("particles.pah=[A2, A4]", "particles.pah", "one PAH"),
         ("particles.surface.growth=[1, 2]", "particles.surface.growth", "3"),
         ("particles.surface.growth=[-1, 2, 3]", "particles.surface.growth", "zero or more"),
         ("particles.growth_by=never", "particles.growth_by", "events"),
         ("particles.inception_by=dimers", "particles.monomer_mass", "monomers"))


def check_ensembles(program, folder: pathlib.Path) -> None:
    out = folder / f"out_{program.ranks}"
    result = program("run", CASE / "deck.yaml", "--out", out, *running.settings(*SHORT), timeout=300)
    assert result.code == 0, result.err
    with open(out / "history.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    times = [float(row["time [s]"]) for row in rows]
    assert np.allclose(times, [0, 2e-3, 4e-3, 5e-3, 6e-3, 8e-3], rtol=1e-12), times
    with h5py.File(out / "results.h5", "r") as file:
        history = {name: values[()] for name, values in file["history"].items()}
        rates = {name: values[()] for name, values in file["rates"].items()}
        edges, sizes = file["particles/bin_edges"][()], file["particles/size_distribution"][()]
    number = history["soot_number_density"]
    assert number[0] == 0 and number[-1] > 1e17, number
    # Sizes add up to the number; nuclei, the smallest, are 0.878 nm large.
    widths = np.diff(np.log10(edges))
    assert np.allclose(sizes @ widths, number, rtol=1e-10)
    assert np.all(sizes[:, edges[1:] < 0.87e-9] == 0)
    # Student's t of three repeats: 4.303 and 31.60.
    error = history["soot_mass_error"][-1]
    assert error > 0
    assert abs(history["soot_mass_ci95"][-1] / error / 4.3027 - 1) < 1e-4
    assert abs(history["soot_mass_ci999"][-1] / error / 31.599 - 1) < 1e-4
    # Mass: what processes gave and took over each interval is what became of it.
    gained = sum((rates["to"] - rates["from"]) * sign * rates[name] for name, sign in (
        ("nucleation", 1), ("condensation", 1), ("growth", 1), ("oxidation_O2", -1), ("oxidation_OH", -1),
        ("dilution_carbon", -1), ("resampled_carbon", 1)))
    assert np.allclose(np.cumsum(gained), history["soot_mass"][1:], rtol=1e-9), (gained, history["soot_mass"])
    assert np.all(rates["nucleation"][2:] > 0) and np.all(rates["oxidation_OH"][2:] > 0)
    assert history["soot_coagulation_events"][-1] > 100


def check_rank_independence(programs: tuple, folder: pathlib.Path) -> None:
    """Of each kind a small one, the same to the last bit on one rank and on two."""
    (folder / "gas.csv").write_text(GAS, encoding="utf-8")
    flame_file(programs[0], folder)
    trees = ("particles.number=32", "particles.repeats=3", "particles.tables_at=[]", "gas.end=20 ms")
    spheres = ("particles.number=64", *SHORT[1:])
    decks = {"spheres": (CASE / "deck.yaml", spheres), "depleting": (CASE / "deck.yaml", (
        *spheres, "gas.exchange=two_way", "particles.coupling_change=0.3")), "silica": (SILICA / "deck.yaml", trees),
        "molecules": (MOLECULES / "deck.yaml", ("particles.number=64", "particles.repeats=3", "gas.end=2.6 ms", "particles.coagulation=true")),
        "pairs": (MOLECULES / "deck.yaml", ("particles.number=64", "particles.repeats=3", "gas.end=2.6 ms", "particles.coagulation=true",
                                            "particles.molecules.inception=pairs", "gas.exchange=two_way"))}
    for name, text in (("sectional", MODEL.format(mechanism=MECHANISM, model="sectional")), ("flame", ALONG_FLAME),
                       ("trees", TREES_ALONG_FLAME + "gas: {flame: flame/results.h5, exchange: two_way}\n")):
        (folder / f"{name}.yaml").write_text(text, encoding="utf-8")
        decks[name] = (folder / f"{name}.yaml", ())
    for name, (deck, pairs) in decks.items():
        for program in programs:
            result = program("run", deck, "--out", folder / f"{name}_{program.ranks}", *running.settings(*pairs), timeout=200)
            assert result.code == 0, f"{name}: {result.err}"
        one, two = ((folder / f"{name}_{program.ranks}/history.csv").read_bytes() for program in programs)
        assert one == two, f"{name}: the history depends on the number of ranks"


def check_models(program, folder: pathlib.Path) -> None:
    (folder / "gas.csv").write_text(GAS, encoding="utf-8")
    for model in ("sectional", "hmom", "two_equation_dimer", "leung"):
        deck = folder / f"{model}.yaml"
        deck.write_text(MODEL.format(mechanism=MECHANISM, model=model), encoding="utf-8")
        result = program("run", deck, "--out", folder / f"{model}_{program.ranks}", timeout=120)
        assert result.code == 0, f"{model}: {result.err}"
        with h5py.File(folder / f"{model}_{program.ranks}/results.h5", "r") as file:
            number = file["history/soot_number_density"][()]
            assert ("particles" in file) == (model == "sectional")
        assert number.shape == (3,) and number[0] == 0, number
        assert (number[-1] > 0) == (model != "leung"), f"{model}: {number}"  # which needs acetylene


def check_depletion(program, folder: pathlib.Path) -> None:
    """What an ensemble and a model leave of their PAH: less than given, the same of both, by two ways of coupling."""
    left, given = {}, {}
    for name, more in (("hmom", ""), ("ensemble", ", number: 1000, repeats: 3")):
        deck = folder / f"depleted_{name}.yaml"
        deck.write_text(f"problem: prescribed_gas\nmechanism: {MECHANISM}\ngas: {{file: {CASE}/gas.csv, exchange: two_way, end: 16 ms}}\n"
                        f"particles: {{description: {name}, pah: [A4]{more}}}\noutput: {{interval: 4 ms}}\n", encoding="utf-8")
        result = program("run", deck, "--out", folder / f"depleted_{name}_{program.ranks}", timeout=120)
        assert result.code == 0, f"{name}: {result.err}"
        with h5py.File(folder / f"depleted_{name}_{program.ranks}/results.h5", "r") as file:
            left[name] = file["history/X_A4"][()]
    with open(CASE / "gas.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    time = next(name for name in rows[0] if name.startswith("time"))
    pah = next(name for name in rows[0] if name.startswith("X_A4"))
    given = np.interp(16e-3, [float(row[time]) for row in rows], [float(row[pah]) for row in rows])
    assert left["hmom"].shape == (5,) and left["hmom"][0] > 0, left
    assert 0.7 * given < left["hmom"][-1] < 0.9 * given, (left, given)
    assert np.allclose(left["ensemble"], left["hmom"], rtol=2e-3), left


def check_trees(program, folder: pathlib.Path) -> None:
    """Silica along the gas of a reactor without particles is what it is in the reactor with them."""
    short = ("particles.number=128", "particles.repeats=8", "particles.tables_at=[]")
    along, reactor = folder / f"along_{program.ranks}", folder / f"reactor_{program.ranks}"
    result = program("run", SILICA / "deck.yaml", "--out", along, *running.settings(*short, "gas.end=40 ms"), timeout=200)
    assert result.code == 0, result.err
    result = program("run", running.SOURCE / "cases/reactor/silica_batch/deck.yaml", "--out", reactor, *running.settings(
        *short[:2], "time.end=40 ms", "output.interval=20 ms", "particles.seed=7"), timeout=200)
    assert result.code == 0, result.err
    with h5py.File(along / "results.h5", "r") as one, h5py.File(reactor / "results.h5", "r") as two:
        for name in ("silica_number_density", "silica_volume_fraction", "silica_surface_area", "X_H4O4SI"):
            mean, error = (tuple(file[f"history/{column}"][1:] for file in (one, two)) for column in (name, f"{name}_error"))
            z = (mean[0] - mean[1]) / np.hypot(*error)
            assert np.all(np.abs(z) < 4), f"{name}: {mean} are {z} joint errors apart"
            assert np.all(np.hypot(*error) < 0.1 * mean[1]), f"{name}: {error} of {mean}"
        given = 4.8e-6
        assert one["history/X_H4O4SI"][2] < 0.05 * given, one["history/X_H4O4SI"][()]


def flame_file(program, folder: pathlib.Path) -> None:
    flame = folder / "burner.yaml"
    flame.write_text(FLAME, encoding="utf-8")
    result = program("run", flame, "--out", folder / "flame", timeout=200)
    assert result.code == 0, result.err


def check_flame(program, folder: pathlib.Path) -> None:
    """The path through a burner flame of twenty points: rows in the order of its time, gas as hot as the flame."""
    flame_file(program, folder)
    deck = folder / "along.yaml"
    deck.write_text(ALONG_FLAME, encoding="utf-8")
    result = program("run", deck, "--out", folder / "along", timeout=200)
    assert result.code == 0, result.err
    with h5py.File(folder / "along/results.h5", "r") as file:
        temperature, number = file["history/temperature"][()], file["history/soot_number_density"][()]
    assert abs(temperature[0] - 300) < 1 and 1650 < temperature.max() < 1701, temperature
    assert number[-1] > 0 and len(number) == 101
    # As trees they are as many, but for their noise; nothing but coagulation and dilution tells spheres of them apart.
    trees = folder / "trees.yaml"
    trees.write_text(TREES_ALONG_FLAME.replace("number: 50", "number: 200") + "gas: {flame: flame/results.h5}\n", encoding="utf-8")
    result = program("run", trees, "--out", folder / "trees", timeout=200)
    assert result.code == 0, result.err
    with h5py.File(folder / "trees/results.h5", "r") as file:
        assert np.allclose(file["history/temperature"][()], temperature, rtol=1e-6)
        assert 0.4 < file["history/soot_number_density"][-1] / number[-1] < 2.5, (file["history/soot_number_density"][-1], number[-1])
    # What they leave of their precursor is what the flame has, or less.
    result = program("run", trees, "--out", folder / "trees_two_way", *running.settings("gas.exchange=two_way"), timeout=200)
    assert result.code == 0, result.err
    with h5py.File(folder / "flame/results.h5", "r") as flame, h5py.File(folder / "trees_two_way/results.h5", "r") as file:
        left, most = file["history/X_A2"][()], np.max(flame["flame/X/A2"][()])
    assert 0 < np.max(left) < 1.001 * most, (left, most)
    wrong = program("run", deck, "--out", folder / "wrong_flame", *running.settings(f"mechanism={MECHANISM}", "particles.pah=[A4]"))
    assert wrong.code == 2 and "other species" in wrong.err, wrong.err


def check_refusals(program, folder: pathlib.Path) -> list:
    problems = []

    def refused(result, words, what):
        said = [line for line in result.err.splitlines()
                if line.startswith("lampblack: ") and not line.startswith("lampblack: warning")]
        if result.code != 2 or len(said) != 1 or any(word not in result.err for word in words):
            problems.append(f"{what}: exit code {result.code}, expected {words} in\n{result.err}")

    head = GAS.split("\n", maxsplit=1)[0] + "\n"
    (folder / "bad").mkdir()
    # All messages on one rank; that only one of several ranks speaks does not need every one of them.
    every = 1 if program.ranks == 1 else 4
    for i, (rows, words) in enumerate(WRONG_GAS[::every]):
        (folder / f"bad/gas_{i}.csv").write_text(head + rows, encoding="utf-8")
        result = program("run", CASE / "deck.yaml", "--out", folder / "never", *running.settings(
            *SHORT, f"gas.file={folder}/bad/gas_{i}.csv"))
        refused(result, (words, f"gas_{i}.csv"), rows)
    for setting, key, words in WRONG[::every]:
        result = program("run", CASE / "deck.yaml", "--out", folder / "never", *running.settings(*SHORT, setting))
        refused(result, (key, words), setting)
    for what, words in (("[A9]", "A9"), ("[CH4]", "CH4")):
        result = program("run", CASE / "deck.yaml", "--out", folder / "never", *running.settings(
            *SHORT, "gas.exchange=two_way", f"gas.depleted={what}"))
        refused(result, ("gas.depleted", words), f"depleted {what}")
    for setting, words in (("particles.tables_at=[1 s]", "outside the run"), ("particles.material=gold", "particles.material")):
        result = program("run", SILICA / "deck.yaml", "--out", folder / "never", *running.settings(setting))
        refused(result, (setting.split("=", maxsplit=1)[0], words), setting)
    deck = folder / "hmom_of_monomers.yaml"
    deck.write_text(MODEL.format(mechanism=MECHANISM, model="hmom").replace("pah: [A4]", "pah: [A4], inception_by: monomers"),
                    encoding="utf-8")
    refused(program("run", deck, "--out", folder / "never"), ("particles.inception_by", "does not have this"), "hmom of monomers")
    for setting, words in (("particles.pah=[A2]", "molecules"), ("particles.pah=[A2, A4]", "one species"),
                           ("gas.exchange=two_way", "as_in_gas"), ("particles.alpha=1", "leave it out"),
                           ("particles.molecules.molecule=buckminsterfullerene", "particles.molecules.molecule"),
                           ("particles.molecules.sticks=by_size", "sticking_constants"),
                           ("particles.molecules.processes=[G7R]", "particles.molecules.processes"),
                           ("particles.molecules.inception=by_formation", "by_formation needs formation"),
                           ("particles.molecules.growth_factor=1.5", "particles.molecules.growth_factor"),
                           ("particles.material=silica", "particles.pah"))[::every]:
        result = program("run", MOLECULES / "deck.yaml", "--out", folder / "never", *running.settings(setting))
        refused(result, ("particles", words), setting)
    if (folder / "never").exists():
        problems.append("a refused run left a folder")
    return problems


def main(executable: str, ranks: str, *mpiexec: str) -> int:
    program = running.Program(executable, list(mpiexec), int(ranks))
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        if program.ranks > 1:
            check_rank_independence((running.Program(executable, list(mpiexec), 1), program), folder)
        else:
            check_ensembles(program, folder)
            check_models(program, folder)
            check_depletion(program, folder)
            check_trees(program, folder)
            check_flame(program, folder)
        problems = check_refusals(program, folder)
    print("\n".join(problems))
    return 1 if problems else 0


sys.exit(main(*sys.argv[1:]))
