"""A flow that starts from the results of another: the same fields on the same mesh, those between on a finer one, and what is told
where the results do not fit.

Usage: initial_flow_test.py EXECUTABLE MPIEXEC...
"""

import pathlib
import shutil
import sys
import tempfile

import running

h5py = running.package("h5py")
np = running.package("numpy")

NO_FUEL = 'boundaries.fuel.composition="N2: 1"'
START = "initial={layer: none, flow: {results: ../earlier}}"


def fields(folder, which, results="results.h5"):
    """Cell centres and fields of the first or last output."""
    with h5py.File(folder / results, "r") as file:
        step = file["steps"][which(file["steps"])]
        return file["mesh/cellCentre"][()], {name: step[name][()] for name in step}


def same_mesh(program, deck, folder):
    """The start is the earlier run's end: gas and soot as they were; the velocity meets the divergence of its own gas."""
    out = folder / "same"
    result = program("run", deck, "--out", out, *running.settings(START, "time.end=2 us"))
    assert result.code == 0, result.err
    _, before = fields(folder / "earlier", max)
    _, after = fields(out, min)
    assert before["soot_number"].max() > 0 and before["swirl_velocity"].max() > 0
    for name in before:
        if name in ("temperature", "swirl_velocity", "soot_number", "soot_carbon") or name.startswith("X_"):
            error = np.abs(after[name] - np.maximum(before[name], 0)).max() / max(np.abs(before[name]).max(), 1e-12)
            assert error < 1e-9, (name, error)
    # A start has no rates yet: where nothing burns its velocities have the divergence of the earlier run's end.
    out = folder / "same_cold"
    result = program("run", deck, "--out", out, *running.settings(START.replace("earlier", "cold"), NO_FUEL, "time.end=2 us"))
    assert result.code == 0, result.err
    _, before = fields(folder / "cold", max)
    _, after = fields(out, min)
    error = np.abs(after["velocity"] - before["velocity"]).max() / np.abs(before["velocity"]).max()
    own = np.abs(fields(folder / "cold", min)[1]["velocity"] - before["velocity"]).max() / np.abs(before["velocity"]).max()
    assert error < 0.1 < own, (error, own)


def of_an_earlier_time(program, deck, folder):
    """The output next to the time that is given."""
    out = folder / "early"
    start = "initial={layer: none, flow: {results: ../earlier/results.h5, time: 1 us}}"
    result = program("run", deck, "--out", out, *running.settings(start, "time.end=2 us"))
    assert result.code == 0, result.err
    _, before = fields(folder / "earlier", min)
    _, after = fields(out, min)
    assert np.abs(after["temperature"] - before["temperature"]).max() < 1e-6


def finer_mesh(program, deck, folder):
    """Linear between the cells: nowhere beyond what was there, and nowhere far from the cell it lies in."""
    out = folder / "finer"
    result = program("run", deck, "--out", out, *running.settings(START, "time.end=2 us", "mesh.refinement=2"))
    assert result.code == 0, result.err
    coarse, before = fields(folder / "earlier", max)
    fine, after = fields(out, min)
    assert len(fine) == 4 * len(coarse)
    assert after["temperature"].max() <= before["temperature"].max() * (1 + 1e-9)
    assert after["temperature"].min() >= before["temperature"].min() * (1 - 1e-9)
    places = [np.unique(coarse[:, axis]) for axis in (0, 1)]
    order = np.lexsort((coarse[:, 1], coarse[:, 0]))
    grid = before["temperature"][order].reshape(len(places[0]), len(places[1]))
    for at in range(0, len(fine), 7):
        lines = [np.interp(fine[at, 1], places[1], grid[i]) for i in range(len(places[0]))]
        expected = np.interp(fine[at, 0], places[0], lines)
        assert abs(after["temperature"][at] - expected) < 1e-6 * expected, (fine[at], after["temperature"][at], expected)


MISFITS = [
    ("initial={layer: none, flow: {results: ../nowhere}}", "nowhere"),
    ("initial={low: fuel, high: oxidiser, position: 4 mm, width: 2 mm, flow: {results: ../earlier}}", "initial.layer"),
    ("initial={layer: none, formula: {temperature: 300}, flow: {results: ../earlier}}", "nothing else that gives the start"),
    ("initial={layer: none, flow: {results: ../short}}", "has no 'X_"),
]


def other_mechanism(program, deck, folder):
    """Species go by name: those that this mechanism lacks are left out and told, the others scaled to sum one; those that the earlier
    one lacks are zero. Where much would be left out the start is refused."""
    start = ("initial={layer: none, flow: {results: ../doped}}", "particles.description=none", "boundaries.fuel.composition=C2H4: 1", "time.end=1 us")
    out = folder / "other"
    result = program("run", deck, "--out", out, *running.settings(*start, f"mechanism={running.SOURCE}/cases/mechanisms/methane_gri30_53.yaml"))
    assert result.code == 0, result.err
    benzene = 0.005 * 78.11
    share = f"{benzene / (benzene + 0.995 * 28.05):.2g}"
    mass = f"up to {share} of the mass of a cell: A1 (up to {share}), "
    assert mass in result.out and "the particles of" in result.out and "this run has none" in result.out, result.out
    _, before = fields(folder / "doped", max)
    _, after = fields(out, min)
    kept = [name for name in before if name.startswith("X_") and name in after]
    assert len(kept) > 20 and "X_A1" not in after and after["X_HCN"].max() == 0
    known = sum(np.maximum(before[name], 0) for name in kept)
    assert known.min() < 0.996
    for name in kept:
        assert np.abs(after[name] - np.maximum(before[name], 0) / known).max() < 1e-6, name
    assert np.abs(sum(after[name] for name in after if name.startswith("X_")) - 1).max() < 1e-9
    hydrogen = (*start[:2], f"mechanism={running.SOURCE}/cases/mechanisms/hydrogen_h2o2_10.yaml", "boundaries.fuel.composition=H2: 1")
    result = program("run", deck, "--out", folder / "never", *running.settings(*hydrogen))
    assert result.code == 2 and "up to 1 of the mass of a cell: C2H4" in result.err and "expected 0.02 at most" in result.err, result.err


def told_mass(program, deck, folder):
    """The mass that is told is that of the molar masses in the earlier results, in hot gas too, whose density is not quite that of its
    temperature."""
    mechanism = running.SOURCE / "cases/mechanisms/ethylene_abf2000_101.yaml"
    result = program("check", deck, *running.settings(START, "particles.pah=[A4]", f"mechanism={mechanism}"))
    assert result.code == 0, result.err
    with h5py.File(folder / "earlier/results.h5") as file:
        step = file["steps"][max(file["steps"])]
        names = [name.decode() for name in file["species/name"][()]]
        masses = {name: step["X_" + name][()] * molar for name, molar in zip(names, file["species/molar_mass"][()])}
    lacking = {name: masses[name] / sum(masses.values()) for name in ("C3H6", "A-C3H5", "P-C3H4")}
    told = ", ".join(f"{name} (up to {share.max():.2g})" for name, share in lacking.items())
    assert told + ", 14 others" in result.out, (told, result.out)
    others = float(result.out.split("mechanism lacks, up to ")[1].split()[0]) - sum(lacking.values()).max()
    assert -5e-5 < others < 1e-4, (others, result.out)


def lit(program, deck, folder):
    """A cold mixture that is lit is hot, and burnt."""
    whole = "initial={layer: none, composition: 'C2H4: 0.05, O2: 0.2, N2: 0.75', temperature: 300 K}"
    result = program("run", deck, "--out", folder / "mixed", *running.settings(whole, "particles.description=none", "time.end=1 us"))
    assert result.code == 0, result.err
    start = "initial={layer: none, flow: {results: ../mixed, light: true}}"
    result = program("run", deck, "--out", folder / "lit", *running.settings(start, "particles.description=none", "time.end=1 us"))
    assert result.code == 0, result.err
    _, before = fields(folder / "mixed", max)
    _, after = fields(folder / "lit", min)
    assert before["temperature"].max() < 400 and after["temperature"].min() > 1500, (before["temperature"].max(), after["temperature"].min())
    assert after["X_CO2"].min() > 0.05 and after["X_C2H4"].max() < 1e-3


def other_particles(program, deck, folder):
    """Particles are taken only where all that the model carries is there with the same meaning; else the gas alone, which is told."""
    shutil.copytree(folder / "earlier", folder / "renamed")
    with h5py.File(folder / "renamed/results.h5", "a") as file:
        for step in file["steps"].values():
            step["soot_hydrogen"].attrs["description"] = np.bytes_("hydrogen of something else")
    for earlier, missing in (("sootless", "soot_number"), ("renamed", "soot_hydrogen")):
        out = folder / f"from_{earlier}"
        start = f"initial={{layer: none, flow: {{results: ../{earlier}}}}}"
        result = program("run", deck, "--out", out, *running.settings(start, "time.end=1 us"))
        assert result.code == 0 and f"has no '{missing}'" in result.out, (result.err, result.out)
        _, before = fields(folder / earlier, max)
        _, after = fields(out, min)
        assert np.abs(after["temperature"] - before["temperature"]).max() < 1e-6
        for name in ("soot_number", "soot_carbon", "soot_hydrogen"):
            assert after[name].max() == 0, (earlier, name)


def misfits(program, deck, folder):
    """Results that do not fit are refused in one message, and with them the deck by `check`."""
    for start, told in MISFITS:
        result = program("run", deck, "--out", folder / "never", *running.settings(start))
        assert result.code == 2 and told in result.err, (start, result.code, result.err)
        problems = running.differs_from_check(program, result, deck, *running.settings(start))
        assert not problems, problems
    wide = [START, "mesh.r=[{to: 30 mm, cells: 12}]"]
    result = program("run", deck, "--out", folder / "never", *running.settings(*wide))
    assert result.code == 2 and "this mesh goes from 0 to 0.03 m" in result.err, result.err


def closed_vessel(program, folder):
    """Goes on with the pressure that it had, and so with its mass."""
    deck = running.SOURCE / "cases/flow/heated_cavity_lowmach/deck.yaml"
    coarse = ("mesh.refinement=0.5", "output.interval=0.1 s")
    result = program("run", deck, "--out", folder / "warmed", *running.settings(*coarse, "time.end=0.2 s"))
    assert result.code == 0, result.err
    # What a run that was stopped leaves has no history but in the table beside it.
    shutil.copytree(folder / "warmed", folder / "stopped")
    (folder / "stopped/results.h5").rename(folder / "stopped/results.h5.part")
    with h5py.File(folder / "stopped/results.h5.part", "a") as file:
        del file["history"]
    start = f"initial={{layer: none, flow: {{results: {folder / 'stopped'}}}}}"
    result = program("run", deck, "--out", folder / "on", *running.settings(*coarse, start, "time.end=1 ms"))
    assert result.code == 0, result.err
    with h5py.File(folder / "warmed/results.h5") as before, h5py.File(folder / "on/results.h5") as after:
        pressures = [file["history/thermodynamic_pressure"][()] for file in (before, after)]
        masses = [file["history/mass_content"][()] for file in (before, after)]
    assert abs(pressures[0][-1] / pressures[0][0] - 1) > 1e-3, pressures[0]
    assert abs(pressures[1][0] / pressures[0][-1] - 1) < 1e-3, pressures[1]
    assert abs(masses[1][0] / masses[0][-1] - 1) < 1e-6, masses


def around_a_solid(alone, program, folder):
    """From a run around a solid, and from what one that was stopped has left: on the same mesh the same fields; without the solid
    gas as beside it where it stood."""
    gas = 'composition: "GAS: 1"'
    deck = folder / "solid/deck.yaml"
    deck.parent.mkdir()
    deck.write_text(f"""problem: flow
mechanism: {running.SOURCE}/cases/mechanisms/perfect_gas_1.yaml
transport: {{model: unity_lewis}}
mesh: {{geometry: planar, x: [{{to: 8 mm, cells: 8}}], y: [{{to: 5 mm, cells: 5}}], solids: {{rod: {{x: [3 mm, 5 mm], y: [1 mm, 4 mm]}}}}}}
boundaries:
  in: {{type: inlet, side: x-min, velocity: 1 m/s, temperature: 300 K, {gas}}}
  out: {{type: outlet, side: x-max, temperature: 300 K, {gas}}}
  low: {{type: wall, side: y-min}}
  high: {{type: wall, side: y-max}}
  rod: {{type: wall, solid: rod}}
initial: {{layer: none, {gas}, formula: {{temperature: "300 + 10000*x + 20000*y"}}}}
time: {{end: 20 us, first_step: 10 us}}
""", encoding="utf-8")
    result = alone("run", deck, "--out", folder / "around")
    assert result.code == 0, result.err
    (folder / "around/results.h5").rename(folder / "around/results.h5.part")
    places, before = fields(folder / "around", max, "results.h5.part")
    start = f"initial={{layer: none, flow: {{results: {folder / 'around'}}}}}"
    result = program("run", deck, "--out", folder / "around_on", *running.settings(start))
    assert result.code == 0, result.err
    _, after = fields(folder / "around_on", min)
    assert np.abs(after["temperature"] - before["temperature"]).max() < 1e-6
    text = deck.read_text(encoding="utf-8")
    deck.write_text(text.replace(text[text.index(", solids:"):text.index("}\nboundaries")], "").replace("  rod: {type: wall, solid: rod}\n", ""),
                    encoding="utf-8")
    result = program("run", deck, "--out", folder / "whole", *running.settings(start))
    assert result.code == 0, result.err
    whole, after = fields(folder / "whole", min)
    assert len(whole) == len(places) + 6
    old = {tuple(np.round(place, 9)): value for place, value in zip(places, before["temperature"])}
    for place, value in zip(whole, after["temperature"]):
        # Each cell of the rod has one of gas at its side, whose value it gets.
        sides = [old.get(tuple(np.round(place + step, 9))) for step in ((1e-3, 0, 0), (-1e-3, 0, 0), (0, 1e-3, 0), (0, -1e-3, 0))]
        own = old.get(tuple(np.round(place, 9)))
        expected = [side for side in sides if side is not None] if own is None else [own]
        assert min(abs(value - one) for one in expected) < 1e-6, (place, value, expected)


def main(executable, *mpiexec):
    one, two = (running.Program(executable, list(mpiexec), ranks) for ranks in (1, 2))
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        deck = running.small_case(folder)
        for program, out, *setting in ((two, "earlier", "boundaries.fuel.swirl_velocity=10 cm/s"), (one, "cold", NO_FUEL, "time.end=20 ms"), (one, "short", "output.species=[O2]"),
                                      (one, "sootless", "particles.description=none"),
                                      (one, "doped", 'boundaries.fuel.composition="C2H4: 0.995, A1: 0.005"')):
            result = program("run", deck, "--out", folder / out, *running.settings(*setting))
            assert result.code == 0, result.err
        same_mesh(one, deck, folder)
        of_an_earlier_time(one, deck, folder)
        finer_mesh(two, deck, folder)
        other_mechanism(one, deck, folder)
        told_mass(one, deck, folder)
        lit(one, deck, folder)
        other_particles(two, deck, folder)
        misfits(one, deck, folder)
        closed_vessel(one, folder)
        around_a_solid(one, two, folder)
    print("passed")


if __name__ == "__main__":
    main(*sys.argv[1:])
