"""Reactor runs as users meet them: what the files say about ignition, a network and a transient, on any number of ranks.

Usage: reactor_run_test.py EXECUTABLE RANKS MPIEXEC...
Exit code 77 (skipped) where a Python package is missing.
"""

import csv
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

import running

h5py = running.package("h5py")
running.needs("matplotlib")  # for scripts/plot
np = running.package("numpy")

CASES = running.SOURCE / "cases"


def run(program, name, folder, *pairs):
    out = folder / pathlib.Path(name).name
    result = program("run", CASES / name / "deck.yaml", "--out", out, *running.settings(*pairs), timeout=200)
    assert result.code == 0, result.err
    record = json.loads((out / "run.json").read_text(encoding="utf-8"))
    assert record["status"] == "done" and not (out / "results.xdmf").exists()
    return out, record["results"], result.out


def rows_of(path):
    with open(path, newline="", encoding="utf-8") as file:
        head, *rows = list(csv.reader(file))
    return head, rows


def ignition(program, folder):
    """Delays as Cantera 3.2 has them (tests/chemistry/ignition_test.cpp), the same in all files."""
    out, results, text = run(program, "reactor/ignition_hydrogen", folder)
    delay = results["ignition_delays_s"]["max_dTdt"]
    assert abs(delay / 4.533140061e-5 - 1) < 2e-6, delay
    assert f"{delay:.6e} s" in text, text
    head, rows = rows_of(out / "sensitivities.csv")
    assert head[:3] == ["reaction", "equation", "max_dTdt [1]"] and len(rows) == 29
    column = np.array([float(row[2]) for row in rows])
    assert abs(column.sum() + 1) < 1e-3, column.sum()
    with h5py.File(out / "results.h5", "r") as file:
        assert file["ignition/max_dTdt/delay"][()] == delay
        assert np.array_equal(file["sensitivity/max_dTdt"][()], column)
        assert np.array_equal(file["sensitivity/reaction"][()], np.arange(1, 30))
        names, history = rows_of(out / "history.csv")
        table = np.array(history, dtype=float)
        assert len(file["history"]) == len(names)
        for c, name in enumerate(names):
            assert np.array_equal(file["history"][name.split(" [")[0]][()], table[:, c]), name
        assert file["history/time"][-1] == 2e-3
    if program.ranks > 1:
        return
    # As users start it, in a process of its own.
    done = subprocess.run([sys.executable, running.SOURCE / "scripts/plot", out], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    for picture in ("reactor", "ignition", "sensitivity"):
        assert (out / "pictures" / f"{picture}.png").stat().st_size > 5000, picture


def regular_output(program, folder):
    """Rows at a regular interval, the end included, and mass fractions of the chosen species."""
    out, _, _ = run(program, "reactor/ignition_hydrogen", folder, "output.interval=30 us", "time.end=100 us",
                    "output.species=[OH, H2O]", "output.fractions=mass")
    head, rows = rows_of(out / "history.csv")
    assert head[-2:] == ["Y_OH [1]", "Y_H2O [1]"], head
    assert np.allclose([float(row[0]) for row in rows], [0, 3e-5, 6e-5, 9e-5, 1e-4], rtol=1e-12)


def network(program, folder):
    out, results, _ = run(program, "reactor/network_combustor", folder)
    head, rows = rows_of(out / "reactors.csv")
    assert [row[0] for row in rows] == list(results["reactors"])
    with h5py.File(out / "results.h5", "r") as file:
        temperature = file["reactors/temperature"][()]
        assert file["reactors"].attrs["names"].decode() == ",".join(results["reactors"])
    assert head[1] == "temperature [K]" and np.array_equal([float(row[1]) for row in rows], temperature)
    assert list(temperature) == [reactor["temperature_K"] for reactor in results["reactors"].values()]
    with h5py.File(out / "results.h5") as file:
        column = {name: file["reactors"][name][()] for name in ("volume", "density", "mass_flow", "residence_time")}
    assert np.allclose(column["volume"], [1e-4, 2e-4, 1e-4, 3e-4, 3e-4, 3e-4], rtol=1e-9), "volumes of the deck, in m3"
    assert np.allclose(column["mass_flow"][2:], 0.13, rtol=1e-6), "all that the inlets bring"
    assert np.allclose(column["residence_time"], column["density"] * column["volume"] / column["mass_flow"], rtol=1e-9)


def transient(program, folder):
    """A lit stirred reactor comes to rest at its steady state."""
    _, steady, _ = run(program, "reactor/stirred_methane", folder / "steady")
    _, after, _ = run(program, "reactor/stirred_methane", folder, "time.end=60 ms", "output.interval=10 ms")
    difference = after["final_temperature_K"] - steady["reactors"]["reactor"]["temperature_K"]
    assert abs(difference) < 1e-3, difference


def species_with_comma(program, folder):
    """A name such as KM2's C5H5O(1,3) stands in quotes wherever it heads a column; no column is shifted."""
    text = (CASES / "mechanisms/hydrogen_h2o2_10.yaml").read_text(encoding="utf-8")
    (folder / "mechanism.yaml").write_text(re.sub(r"\bH2O2\b", "H2O2(1,3)", text).replace("[H2, H, O, O2, OH, H2O, HO2, H2O2(1,3)", "[H2, H, O, O2, OH, H2O, HO2, 'H2O2(1,3)'"), encoding="utf-8")
    mechanism = f"mechanism={folder}/mechanism.yaml"
    out, _, _ = run(program, "reactor/ignition_hydrogen", folder, mechanism, "time.end=0.1 ms",
                    "ignition.species=['H2O2(1,3)']", "sensitivity.reactions=['1']")
    head, rows = rows_of(out / "history.csv")
    assert "X_H2O2(1,3) [1]" in head and all(len(row) == len(head) for row in rows), head
    sys.path.insert(0, str(running.SOURCE / "python"))
    from lampblack.results import Results  # noqa: PLC0415
    with h5py.File(out / "results.h5", "r") as file:
        written = {name: file["history"][name][()] for name in file["history"]}
    (out / "results.h5").rename(out / "away.h5")
    with h5py.File(out / "results.h5", "w"):
        pass
    read = Results(out).history()
    assert read.keys() == written.keys(), read.keys() ^ written.keys()
    assert all(np.array_equal(read[name], written[name]) for name in written)
    head, rows = rows_of(out / "sensitivities.csv")
    assert "max_Y_H2O2(1,3) [1]" in head and len(rows[0]) == len(head), head
    out, _, _ = run(program, "reactor/stirred_methane", folder)
    head, rows = rows_of(out / "reactors.csv")
    assert len(head) == len(rows[0])


def soot(program, folder):
    """Each model by one changed line, two in each kind of reactor (all in all: tests/coupling), and an ensemble in each: elements to
    round-off, in all files. On two ranks one model a kind: the first rank solves the reactor alone. Repeats of an ensemble are
    shared."""
    models = ("two_equation_dimer", "leung", "moss_brookes", "hmom", "momic", "sectional")
    short = {"closed": ("time.end=0.5 ms",), "plug_flow": ("reactor.length=1 cm",), "stirred": ()}
    for k, (kind, settings) in enumerate(short.items()):
        for model in models[2 * k + program.ranks - 1:2 * k + 2]:
            out, results, text = run(program, f"reactor/{kind}_soot", folder, f"particles.description={model}", *settings, "output.species=[A2]")
            results = results["reactors"]["reactor"] if kind == "stirred" else results
            assert results["element_imbalance"] < 1e-13 and abs(results["energy_imbalance"]) < 1e-9, (kind, model, results)
            fraction = results["soot_volume_fraction" if kind == "stirred" else "final_soot_volume_fraction"]
            assert fraction > 1e-13 and "soot" in text, (kind, model, fraction)
            with h5py.File(out / "results.h5", "r") as file:
                group = file["reactors" if kind == "stirred" else "history"]
                assert group["soot_volume_fraction"][-1] == fraction, (kind, model)
                assert ("particles" in file) == (model in ("momic", "sectional")), (kind, model)
                if model == "sectional":
                    assert file["particles/size_distribution"].shape == (group["soot_volume_fraction"].size, file["particles/diameter"].size)
            shutil.rmtree(out)
        ensemble = ("particles.description=ensemble", "particles.repeats=2", "particles.number=50", "integrator.relative_tolerance=1e-6",
                    "particles.coupling_change=0.3", *settings, *(("time.end=0.2 ms",) if kind == "stirred" else ()))
        out, results, text = run(program, f"reactor/{kind}_soot", folder, *ensemble)
        with h5py.File(out / "results.h5", "r") as file:
            history = file["history"]
            assert results["repeats"] == 2 and history["soot_volume_fraction"][-1] == results["final_soot_volume_fraction"]
            assert history["soot_volume_fraction"][-1] > 0 and history["soot_volume_fraction_error"][-1] > 0
            if kind != "stirred":
                assert np.max(history["element_imbalance"]) < 1e-13 and np.max(np.abs(history["energy_imbalance"])) < 1e-7
        if program.ranks == 1 and kind == "plug_flow":  # along a duct; in time: ensembles_in_networks
            done = running.script(running.SOURCE / "scripts/plot", out)
            assert done.code == 0 and (out / "pictures/particles.png").stat().st_size > 0, done.err
        shutil.rmtree(out)


def ensembles_in_networks(program, folder):
    """A network of one reactor is the stirred reactor, to the last bit; two with a recycle have soot in both, elements balance.
    Ranks share the repeats, of one reactor as of two: two ranks have the first."""
    deck = (CASES / "reactor/stirred_soot/deck.yaml").read_text(encoding="utf-8").replace("../..", str(CASES))
    inlet = deck[deck.index("inlet:"):deck.index("particles:")]
    feed = "".join(f"    {line}\n" for line in inlet.split("\n")[1:] if line)
    settings = ("particles.description=ensemble", "particles.repeats=2", "particles.number=50", "integrator.relative_tolerance=1e-4",
                "particles.coupling_change=0.3", "time.end=0.02 ms")

    def history(name, reactors, connections):
        network = deck.replace(inlet, "").replace("type: stirred\n  residence_time: 5 ms", "type: network")
        network += f"\nnetwork:\n  reactors: {{{reactors}}}\n  inlets:\n    feed:\n      to: one\n      mass_flow: 1 kg/s\n{feed}"
        (folder / f"{name}.yaml").write_text(network + connections, encoding="utf-8")
        return history_of(folder / f"{name}.yaml", name)

    def history_of(path, name):
        out = folder / name
        result = program("run", path, "--out", out, *running.settings(*settings), timeout=200)
        assert result.code == 0, result.err
        with h5py.File(out / "results.h5", "r") as file:
            return {key: file["history"][key][()] for key in file["history"]}

    stirred = history_of(CASES / "reactor/stirred_soot/deck.yaml", "stirred")
    alone = history("alone", "one: {residence_time: 5 ms}", "")
    assert stirred["soot_volume_fraction"][-1] > 0 and np.max(stirred["element_imbalance"]) < 1e-12
    for name, values in stirred.items():
        assert np.array_equal(values, alone[name if name == "time" else f"one_{name}"], equal_nan=True), name
    if program.ranks > 1:
        return
    two = history("two", "one: {residence_time: 5 ms}, two: {residence_time: 1 ms}",
                  "  connections: [{from: one, to: two}, {from: two, to: one, fraction: 0.5}]\n")
    done = running.script(running.SOURCE / "scripts/plot", folder / "two")
    assert done.code == 0, done.err
    for picture in ("reactor_one", "particles_one", "reactor_two", "particles_two"):
        assert (folder / f"two/pictures/{picture}.png").stat().st_size > 0, done.out
    for name in ("one", "two"):
        assert two[f"{name}_soot_volume_fraction"][-1] > 0 and np.max(two[f"{name}_element_imbalance"]) < 1e-12, name


def behind_a_stirred_reactor(program, folder):
    """What enters a duct behind a stirred reactor is what the stirred reactor alone has, soot included; populations arrive."""
    _, stirred, _ = run(program, "reactor/stirred_soot", folder)
    inlet = "{temperature: 300 K, composition: 'C2H4: 0.106, O2: 0.17, N2: 0.724', velocity: 1 m/s}"
    text = (f"problem: reactor\nmechanism: {CASES}/mechanisms/ethylene_abf2000_101.yaml\npressure: 1 atm\n"
            f"reactor: {{type: plug_flow, length: 1 mm}}\nupstream: {{residence_time: 5 ms}}\ninlet: {inlet}\n"
            "integrator: {relative_tolerance: 1e-6}\noutput: {spacing: 1 mm, species: [A2]}\n")
    rows = {}
    for name, more in (("hmom", "particles: {description: hmom, pah: [A2], density: 1800 kg/m^3}\n"),
                       ("trees", "particles: {description: trees, pah: [A2], density: 1800 kg/m^3, "
                                 "number: 64, repeats: 2, expected_number: 1e14 1/m^3, coupling_change: 0.5}\n")):
        deck = folder / f"{name}.yaml"
        deck.write_text(text + more, encoding="utf-8")
        result = program("run", deck, "--out", folder / name, timeout=300)
        assert result.code == 0, result.err
        head, all_rows = rows_of(folder / name / "history.csv")
        rows[name] = {column.split(" [")[0]: float(value) for column, value in zip(head, all_rows[0], strict=True)}
    reactor = stirred["reactors"]["reactor"]
    assert abs(rows["hmom"]["temperature"] / reactor["temperature_K"] - 1) < 1e-6, (rows["hmom"], reactor)
    for name in ("volume_fraction", "number_density"):
        assert abs(rows["hmom"][f"soot_{name}"] / reactor[f"soot_{name}"] - 1) < 1e-4, (name, rows["hmom"], reactor)
    # Another model of the same soot: as many within a factor of three, in the same gas.
    assert abs(rows["trees"]["temperature"] - reactor["temperature_K"]) < 1, rows["trees"]
    assert 1 / 3 < rows["trees"]["soot_number_density"] / rows["hmom"]["soot_number_density"] < 3, rows
    # What the gas was told that they took comes with them: their mass but for the noise of the sample.
    assert 0.5 < rows["trees"]["soot_mass_exchanged"] / rows["trees"]["soot_mass"] < 2, rows["trees"]


def too_few_sections(program, folder):
    """Soot that outgrows its sections: one message, exit code 3."""
    result = program("run", CASES / "reactor/closed_soot/deck.yaml", "--out", folder / "out",
                     *running.settings("particles.description=sectional", "particles.sectional.sections=6"))
    assert result.code == 3 and "is in the largest particles of the model; the limit is" in result.err and "particles.sectional.sections" in result.err, result.err


def burning_or_out(program, folder):
    """A stirred reactor, alone or before a duct, burns as long as it can, and what is out is said with its last burning time."""
    inlet = 'inlet: {temperature: 300 K, fuel: "CH4: 1", oxidizer: "O2: 1, N2: 3.76", equivalence_ratio: 1'
    top = f"problem: reactor\nmechanism: {CASES}/mechanisms/methane_gri30_53.yaml\n"
    decks = {"stirred": f"{top}reactor: {{type: stirred, residence_time: 0.1 ms}}\n{inlet}}}\n",
             "duct": f"{top}reactor: {{type: plug_flow, length: 1 mm}}\nupstream: {{residence_time: 0.1 ms}}\n{inlet}, velocity: 1 m/s}}\n"}
    for name, text in decks.items():
        (folder / f"{name}.yaml").write_text(text, encoding="utf-8")
        for time, burns in (("0.1 ms", True), ("0.07 ms", False)):
            key = "reactor" if name == "stirred" else "upstream"
            out = folder / f"{name}_{burns}"
            result = program("run", folder / f"{name}.yaml", "--out", out, *running.settings(f"{key}.residence_time={time}"))
            assert result.code == 0, result
            results = json.loads((out / "run.json").read_text(encoding="utf-8"))["results"]
            found = results["upstream"] if name == "duct" else results["reactors"]["reactor"]
            assert abs(found["temperature_K"] - (1777.65 if burns else 300)) < 0.01, found
            assert found["out"] == (not burns) and ("is out" in result.out) == (not burns), (found, result.out)
            assert burns or abs(found["last_burning_residence_time_s"] / 7.93e-5 - 1) < 0.01, found
            assert burns or f"Reactor '{key}' is out: followed from longer residence times, burning states end at 7.9" in result.out, result.out
            if name == "stirred":
                with h5py.File(out / "results.h5", "r") as file:
                    last = file["reactors"].attrs.get("last_burning_residence_time_reactor")
                    assert (last is None) == burns and (burns or last == found["last_burning_residence_time_s"]), last


def main(executable, ranks, *mpiexec):
    program = running.Program(executable, list(mpiexec), int(ranks))
    tests = [ignition, network, soot, ensembles_in_networks, too_few_sections]
    if program.ranks == 1:  # what the first rank does alone, beyond a sample
        tests += [regular_output, transient, species_with_comma, behind_a_stirred_reactor, burning_or_out]
    for test in tests:
        begun = time.perf_counter()
        with tempfile.TemporaryDirectory() as folder:
            test(program, pathlib.Path(folder))
        print(f"ok  {test.__name__}: {time.perf_counter() - begun:.1f} s", flush=True)


main(*sys.argv[1:])
