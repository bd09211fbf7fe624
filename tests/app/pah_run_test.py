"""Molecules that grow, from the deck to the pictures: master equations, the same numbers on any number of ranks and after
a restart or a signal, a gas from a table.

Usage: pah_run_test.py EXECUTABLE MPIEXEC...
"""

import csv
import json
import pathlib
import re
import sys
import tempfile

import running
import stopping

np = running.package("numpy")

# All processes of the edge: 20000 runs would be within 3.3 standard errors of the master equation of docs/theory/pah.md.
DECK = """problem: pah
molecule: {name: pyrene, most_rings: 7}
gas:
  temperature: 1500 K
  pressure: 1 atm
  mole_fractions: {H: 0.01, H2: 0.1, C2H2: 0.1}
  end: 5 us
repeats: 2000
output: {interval: 1 us, spectra: [2 us]}
"""
EXACT = {"carbon": 18.32999742, "hydrogen": 10.93821240, "six_rings": 4.51672391, "five_rings": 0.17916860}
LEFT, FOUR_RINGS = 1.311775e-2, 0.50457845
MECHANISM = running.SOURCE / "cases/mechanisms/ethylene_bisetti2012_47.yaml"


def results_of(out: pathlib.Path) -> dict:
    return json.loads((out / "run.json").read_text(encoding="utf-8"))["results"]


def differing(one: dict, other: dict) -> list:
    assert one.keys() == other.keys(), one.keys() ^ other.keys()
    return [name for name in one if one[name].tobytes() != other[name].tobytes()]


def check_numbers(data: dict, out: pathlib.Path) -> None:
    assert np.allclose(data["history/time"], np.arange(6) * 1e-6, rtol=1e-12)
    assert data["history/carbon"][0] == 16 and data["history/carbon_error"][0] == 0 and data["history/sites_FE"][0] == 6
    for name, exact in EXACT.items():
        mean, error = data[f"history/{name}"][-1], data[f"history/{name}_error"][-1]
        assert 0 < error and abs(mean - exact) < 3.3 * error, (name, mean, error, exact)
    left = data["history/left"][-1]
    assert abs(left - LEFT) < 3.3 * np.sqrt(LEFT / 2000), left
    # Two times of spectra; what is in them and what has left is all.
    times = data["spectrum/time"]
    assert sorted(set(times)) == [data["history/time"][2], data["history/time"][5]], set(times)
    last = times == times.max()
    assert abs(data["spectrum/fraction"][last].sum() + left - 1) < 1e-12
    inside = data["spectrum/fraction"][last] / (1 - left)
    assert abs(inside @ data["spectrum/carbon"][last] / data["history/carbon"][-1] - 1) < 1e-12
    count = round(2000 * (1 - left))
    variance = inside @ (data["spectrum/carbon"][last] - data["history/carbon"][-1]) ** 2 * count / (count - 1)
    assert abs(data["history/carbon_error"][-1] / np.sqrt(variance / count) - 1) < 1e-9
    four = data["spectrum/fraction"][last & (data["spectrum/rings"] == 4)].sum()
    assert abs(four - FOUR_RINGS) < 3.3 * np.sqrt(FOUR_RINGS * (1 - FOUR_RINGS) / 2000), four
    pyrene = (data["spectrum/carbon"] == 16) & (data["spectrum/hydrogen"] == 10)
    assert np.allclose(data["spectrum/mass"][pyrene], 0.202256, rtol=1e-6)
    # Each event changes the atoms by its row.
    gained = {"G6R_AC": 2, "G6R_FE": 4, "D6R_FE_AC": -2, "D6R_FE3": -4, "G5R_ZZ": 2, "D5R_R5": -2, "C5R_RFE": 2, "C6R_AC_FE3": -2}
    atoms = 16 + sum(n * data[f"history/events_{name}"][-1] for name, n in gained.items())
    assert abs(atoms - data["history/carbon"][-1]) < 1e-9, atoms
    assert data["history/events_G6R_FE"][-1] > 0 and data["history/events_O6R_FE3"][-1] == 0
    assert abs(data["rates/G6R_FE"][0] / 1.64276207e4 - 1) < 1e-6
    # Rings of the first molecules, with their formulas.
    for repeat, carbon in enumerate(data["molecules/formulas/carbon"]):
        six = (data["molecules/six_rings"][:, 0] == repeat).sum()
        rings = six + (data["molecules/five_rings"][:, 0] == repeat).sum()
        assert carbon - data["molecules/formulas/hydrogen"][repeat] == 2 * (rings - 1), repeat
    record = json.loads((out / "run.json").read_text(encoding="utf-8"))
    assert record["status"] == "done" and record["results"]["repeats"] == 2000 and record["results"]["events"] == record["steps"] > 1000
    with open(out / "spectrum.csv", encoding="utf-8") as file:
        assert len(list(csv.DictReader(file))) == len(times)


def check_restarts(executable: str, mpiexec: list, folder: pathlib.Path, deck: pathlib.Path) -> None:
    one, two = (running.Program(executable, mpiexec, ranks) for ranks in (1, 2))
    part, whole = folder / "part", folder / "whole"
    running.run_deck(two, deck, part, *running.settings("repeats=300", "checkpoint.at_end=true"))
    assert [file.name for file in (part / "checkpoint").iterdir()] == ["step_000300.h5"]
    result = running.run_deck(one, deck, part, "--restart", *running.settings("repeats=700"))
    assert "continues from" in result.out and "300 molecules" in result.out, result.out
    running.run_deck(one, deck, whole, *running.settings("repeats=700"))
    different = differing(running.datasets(part / "results.h5"), running.datasets(whole / "results.h5"))
    assert not different, f"after a restart: other numbers in {different}"
    assert results_of(part) == results_of(whole)
    for setting, message in (("molecule.name=coronene", "of another molecule"), ("gas.temperature=1600 K", "of another gas, rates or rows"),
                             ("seed=2", "of another seed"), ("repeats=200", "more than 'repeats: 200'"),
                             ("output.spectra=[3 us]", "of another gas, rates or rows")):
        result = running.run_deck(one, deck, part, "--restart", *running.settings("repeats=700", setting), code=2)
        assert message in result.err, result.err

    # A signal: what had ended is kept.
    stopped = folder / "stopped"
    process = running.Process(executable, mpiexec, 1)
    err = stopping.stopped_in_the_middle([*process.command, "run", str(deck), *running.settings("repeats=100000000")], stopped)
    done = int(re.search(r"after (\d+) molecules", err).group(1))
    running.run_deck(two, deck, stopped, "--restart", *running.settings(f"repeats={done + 100}"))
    running.run_deck(two, deck, folder / "left_alone", *running.settings(f"repeats={done + 100}"))
    different = differing(running.datasets(stopped / "results.h5"), running.datasets(folder / "left_alone" / "results.h5"))
    assert not different, f"after a signal: other numbers in {different}"


def check_table(program, folder: pathlib.Path, data: dict) -> None:
    """The same gas in a table, once as it is and once hotter at its end; and rates from a file."""
    gas = "X_H [1],X_H2 [1],X_C2H2 [1],X_N2 [1]\n"
    for name, end in (("same", 1500), ("hotter", 1800)):
        (folder / f"{name}.csv").write_text(f"time [us],temperature [K],pressure [atm],{gas}0,1500,1,0.01,0.1,0.1,0.79\n"
                                            f"5,{end},1,0.01,0.1,0.1,0.79\n", encoding="utf-8")
        deck = folder / f"{name}.yaml"
        deck.write_text(f"problem: pah\nmechanism: {MECHANISM}\nmolecule: {{name: pyrene, most_rings: 7}}\n"
                        f"gas: {{file: {name}.csv}}\nrepeats: 2000\noutput: {{interval: 1 us, spectra: [2 us]}}\n", encoding="utf-8")
        running.run_deck(program, deck, folder / name)
    same, hotter = (running.datasets(folder / name / "results.h5") for name in ("same", "hotter"))
    assert np.allclose(same["history/carbon"], data["history/carbon"], rtol=1e-3), "a table of a constant gas"
    assert hotter["history/events_G6R_FE"][-1] > 1.3 * same["history/events_G6R_FE"][-1]
    assert abs(hotter["history/temperature"][-1] - 1800) < 1e-9

    (folder / "rates.yaml").write_text("growth_free_edge: [0, 0, 0]\ngrowth_zigzag: [0, 0, 0]\n", encoding="utf-8")
    running.run_deck(program, folder / "deck.yaml", folder / "none", *running.settings("rates.file=rates.yaml", "repeats=50"))
    none = running.datasets(folder / "none" / "results.h5")
    assert none["history/carbon"][-1] <= 16 and none["rates/G6R_FE"][0] == 0 and none["rates/G6R_AC"][0] > 0
    running.run_deck(program, folder / "deck.yaml", folder / "again", *running.settings(
        "rates.file=rates.yaml", "rates.growth_free_edge=[1.1e7, 1.71, 3.9, 3.3e33, -5.7, 25.5]", "repeats=50"))
    assert running.datasets(folder / "again" / "results.h5")["rates/G6R_FE"][0] == data["rates/G6R_FE"][0], "the deck's numbers come first"


def main(executable: str, *mpiexec: str) -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        deck = folder / "deck.yaml"
        deck.write_text(DECK, encoding="utf-8")
        runs = {}
        for ranks in (1, 3):
            program = running.Program(executable, list(mpiexec), ranks)
            result = running.run_deck(program, deck, folder / str(ranks))
            assert not result.err, result.err
            runs[ranks] = running.datasets(folder / str(ranks) / "results.h5")
        different = differing(runs[1], runs[3])
        assert not different, f"3 ranks: other numbers than on one in {different}"
        check_numbers(runs[1], folder / "1")
        check_restarts(executable, list(mpiexec), folder, deck)
        check_table(running.Program(executable, list(mpiexec), 1), folder, runs[1])
        drawn = running.script(running.SOURCE / "scripts/plot", folder / "1")
        assert drawn.code == 0, drawn
        for picture in ("history", "spectrum", "molecules"):
            assert (folder / "1/pictures" / f"{picture}.png").exists(), picture
    print("master equation, ranks, restarts and tables agree")


main(*sys.argv[1:])
