"""The datasets of results.h5 and their units against docs/formats.md, both ways, over a small run of each problem: what is
written is on the page with its unit, and what is on the page is written by one of the runs.

Usage: formats_test.py EXECUTABLE MPIEXEC...
"""

import pathlib
import re
import sys
import tempfile

import running

h5py = running.package("h5py")

CASES = running.SOURCE / "cases"
PAGE = running.SOURCE / "docs/formats.md"

COUNTERFLOW = f"""problem: flame1d
mechanism: {CASES}/mechanisms/hydrogen_h2o2_10.yaml
flame: {{type: counterflow, length: 10 mm}}
left: {{temperature: 300 K, composition: "H2: 0.25, N2: 0.75", velocity: 1 m/s}}
right: {{temperature: 300 K, composition: "O2: 0.21, N2: 0.79", velocity: 1 m/s}}
grid: {{slope: 0.3, curve: 0.5}}
continuation: {{turning_points: 1, maximum_points: 60}}
"""

# A sooting gas of given temperature on twenty points: soot, an ensemble coupled both ways, and a little time.
SOOT = f"""problem: flame1d
mechanism: {CASES}/mechanisms/ethylene_bisetti2012_47.yaml
flame: {{type: burner, energy: given, length: 6 mm}}
inlet: {{temperature: 300 K, composition: "C2H4: 0.16, O2: 0.24, N2: 0.6", velocity: 6 cm/s}}
temperature_profile: {{position: [0 mm, 1 mm, 2 mm, 6 mm], temperature: [300 K, 1500 K, 1700 K, 1600 K]}}
grid: {{refine: false, initial_points: 20}}
solver: {{species_tolerance: 1e-8}}
particles: {{description: ensemble, carried: sectional, pah: [A2], number: 50, repeats: 2, heights: [5 mm], bins: 5, coupling: two_way, iterations: 2, tolerance: 1}}
unsteady: {{end: 0.01 ms, output_interval: 0.01 ms, first_step: 1 us}}
"""

# The same with trees of primaries in place of the ensemble.
SOOT_TREES = re.sub("particles:.*\nunsteady:.*\n", "particles: {description: trees, carried: sectional, coupling: two_way, iterations: 2, "
                    "tolerance: 1, number: 256, repeats: 2, expected_number: 1e18 1/m^3, bins: 5}\n", SOOT)

POPULATION = """problem: population_balance
initial: {distribution: exponential, number: 1e6 1/cm^3, diameter: 10 nm}
processes: {coagulation: {kernel: constant, rate: 1e-6 cm^3/s}}
methods: {one: {type: dsmc, particles: 16}}
time: {end: 1 s, outputs: 2}
repeats: 2
distribution: {minimum: 1 nm^3, maximum: 1e6 nm^3, bins: 3}
"""


def documented() -> list:
    """(path with <placeholders>, units) of the tables of the page that have a column of units."""
    found, prefix, header = [], "", None
    page = PAGE.read_text(encoding="utf-8")
    for line in page[page.index("## results.h5"):page.index("## results.xdmf")].splitlines():
        if line.startswith("#"):
            path = re.fullmatch(r"#+ `(/.*)`", line)
            prefix, header = (path.group(1) + "/" if path else ""), None
        if not line.startswith("|"):
            header = None
            continue
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if header is None:
            header = cells
            continue
        if "unit" not in header or header[0] not in ("dataset", "column", "column of the history") or set(cells[0]) == {"-"}:
            continue
        folder = "/history/" if header[0] == "column of the history" else prefix
        names = []
        for name in re.findall("`([^`]+)`", cells[0]):
            folder = name[:name.rindex("/") + 1] if name.startswith("/") else folder
            names.append(folder + name[name.rfind("/") + 1:])
        units = cells[header.index("unit")].split(", ")
        assert len(units) in (1, len(names)), f"{len(names)} names and {len(units)} units: {line}"
        found += [(name, (units * len(names) if len(units) == 1 else units)[i].split(" or "))
                  for i, name in enumerate(names)]
    return found


def written(results: pathlib.Path) -> dict:
    datasets = {}

    def visit(name, item):
        if isinstance(item, h5py.Dataset):
            assert item.attrs["description"], f"{name} has no description"
            unit = item.attrs["unit"]
            datasets["/" + name] = unit.decode("utf-8") if isinstance(unit, bytes) else unit

    with h5py.File(results, "r") as file:
        file.visititems(visit)
    return datasets


def pattern(path: str) -> re.Pattern:
    return re.compile(re.sub("<[^>]*>", "[^/]+", path.replace("^", "\\^")))


def check_atoms(results: pathlib.Path) -> None:
    """As a two-way coupled run is at hand: the ensemble of a burner flame leaves with what it took from the gas."""
    with h5py.File(results, "r") as file:
        last = {name: float(column[-1]) for name, column in file["stochastic/iterations"].items()}
    for element in "CH":
        taken, leaving = last[f"{element}_taken"], last[f"{element}_leaving"]
        assert taken > 0 and abs(leaving / taken - 1) < 0.01, f"{element}: {taken} taken, {leaving} leaves"
    assert last["H_taken"] < 0.02 * last["C_taken"], "soot has less than an atom of hydrogen for four of carbon"


def main(executable: str, *mpiexec: str) -> int:
    program = running.Program(executable, list(mpiexec), 1)
    page = [(pattern(path), path, units) for path, units in documented()]
    assert len(page) > 150, f"only {len(page)} datasets were found on the page"
    problems, used = [], set()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        runs = {"flow": (running.small_case(folder), *running.settings(
            "radiation.model=optically_thin", "boundaries.fuel.swirl_velocity=1 m/s", "time.sweeps=2", "time.tolerance=0.1", "time.steady={}",
            "output.probes={p: {at: [1 mm, 5 mm]}}", "output.lines={l: {from: [0 mm, 1 mm], to: [0 mm, 7 mm], points: 3}}",
            "output.boundaries=[fuel, fuel_flange]", "output.wall_distance=true", "output.mixture_fraction={fuel: fuel, oxidizer: oxidiser}",
            "chemistry.reference_map={fuel: fuel, oxidizer: oxidiser}"))}
        from flow_mesh_run_test import DECKS, HEAD, gmsh_text

        (folder / "mesh.msh").write_text(gmsh_text(5, 3, lambda i, j: i > 2), encoding="utf-8")
        (folder / "mixed.yaml").write_text(HEAD + DECKS["mixed"], encoding="utf-8")
        runs["mixed"] = (folder / "mixed.yaml", *running.settings("time.end=0.1 ms"))
        ensembles = folder / "flame/ensembles.yaml"
        text = runs["flow"][0].read_text(encoding="utf-8")
        ensembles.write_text(text[:text.index("trajectories:")], encoding="utf-8")
        steady = folder / "flame/steady.yaml"  # of cold nitrogen, which is soon steady enough
        steady.write_text(text.replace("  end: 10 us", "  mode: steady"), encoding="utf-8")
        cold = ("'N2: 1'", "boundaries.fuel.composition='N2: 1'", "boundaries.oxidiser.composition='N2: 1'")
        runs["steady"] = (steady, *running.settings(f"initial={{layer: none, composition: {cold[0]}, temperature: 298 K}}", *cold[1:],
                                                    "boundaries.fuel.swirl_velocity=1 m/s", "time.steady.residual=0.9",
                                                    "time.steady.stability={time: 0.1 ms, vectors: 2}", "time.steady.continuation={maximum_points: 2, key: pressure}"))
        for model in ("sa", "sst", "wray_agarwal", "k_epsilon"):
            runs[f"turbulent_{model}"] = (CASES / "flow/turbulent_channel/deck.yaml", *running.settings(
                f"turbulence.model={model}", "time.end=1 ms", "output.interval=1 ms", "output.boundaries=[wall]",
                f"combustion={{model: {'pasr' if model == 'k_epsilon' else 'laminar'}}}"))
        runs["one_time"] = (CASES / "flow/hm1e/deck.yaml", *running.settings(
            "mesh.refinement=0.25", "time={mode: steady, steady: {residual: 1e-2, attempts: 0, steps: 2, iterations: 30, one_time: true}, first_step: 1 us, maximum_step: 1 ms}"))
        # All blocks of an instant: five are soon over.
        runs["flow_ensembles"] = (ensembles, *running.settings(
            "time.end=30 us", "time.maximum_step=2 us", "output.species=[A2]", "particles={description: ensemble, number: 50, shape: aggregates, bins: 5, minimum_number_density: 1e8 1/m^3}",
            "particles.statistics={start: 10 us, block: 2 us}",
            "particles.regions.all={from: [0 mm, 0 mm], to: [14 mm, 8 mm]}"))
        runs["molecules"] = (CASES / "pah/pyrene_growth/deck.yaml", *running.settings("repeats=20", "gas.end=5 us", "output.spectra=[5 us]"))
        runs["engine"] = (CASES / "engine/hcci_natural_gas/deck.yaml", *running.settings(
            "sample.particles=4", "sample.repeats=2", "step.angle=2 deg", "output.every=8 deg", "cycles={residual: 0.1, most: 2}"))
        runs["engine_soot"] = (CASES / "engine/hcci_ethylene_soot/deck.yaml", *running.settings(
            *(line for line in (running.SOURCE / ".ci/smoke/hcci_ethylene_soot.txt").read_text(encoding="utf-8").splitlines() if line[0] != "#")))
        runs["compression"] = (CASES / "reactor/rapid_compression/deck.yaml", *running.settings(
            "volume={law: slider_crank, bore: 80 mm, stroke: 90 mm, rod: 150 mm, compression_ratio: 10, speed: 1000 rpm}"))
        runs["aggregates"] = (CASES / "aggregates/ballistic/deck.yaml", *running.settings("build.doublings=2", "build.aggregates=4", "repeats=2"))
        for text, run in ((COUNTERFLOW, "counterflow"), (SOOT, "soot"), (SOOT_TREES, "flame_trees"), (POPULATION, "population")):
            (folder / f"{run}.yaml").write_text(text, encoding="utf-8")
            runs[run] = (folder / f"{run}.yaml",)
        runs["ignition"] = (CASES / "reactor/ignition_hydrogen/deck.yaml",)
        runs["fractions"] = (CASES / "reactor/ignition_hydrogen/deck.yaml", *running.settings(
            "output.species=[OH]", "output.fractions=mass", "sensitivity.reactions=['1']"))
        runs["plug_flow"] = (CASES / "reactor/plug_flow_ethylene/deck.yaml",)
        runs["stirred"] = (CASES / "reactor/stirred_methane/deck.yaml",)
        runs["stirred_mass"] = (*runs["stirred"], *running.settings("output.fractions=mass"))
        runs["stirred_in_time"] = (CASES / "reactor/stirred_methane/deck.yaml", *running.settings("time.end=0.1 ms"))

        sections = ("particles.description=sectional", "particles.sectional.overflow=1", "output.species=[A2]")
        runs["closed_soot"] = (CASES / "reactor/closed_soot/deck.yaml", *running.settings("time.end=0.1 ms", *sections))
        runs["stirred_soot"] = (CASES / "reactor/stirred_soot/deck.yaml", *running.settings(*sections))
        runs["ensemble"] = (CASES / "reactor/plug_flow_soot/deck.yaml", *running.settings(
            "reactor.length=5 mm", "output.spacing=5 mm", "particles.description=ensemble", "particles.repeats=2", "particles.number=50",
            "particles.bins=5"))

        runs["trees"] = (CASES / "reactor/silica_batch/deck.yaml", *running.settings(
            "time.end=10 ms", "output.species=[H2O]", "particles.number=50", "particles.repeats=2", "particles.bins=5",
            "particles.tables_at=[10 ms]", "particles.classes={collision_diameter: [1 nm], primaries: [2]}"))
        runs["trees_in_space"] = (CASES / "reactor/silica_batch/spheres.yaml", *running.settings(
            "time.end=10 ms", "particles.number=50", "particles.repeats=2", "particles.tables_at=[10 ms]"))
        runs["soot_trees"] = (CASES / "reactor/plug_flow_soot/deck.yaml", *running.settings(
            "reactor.length=5 mm", "output.spacing=5 mm", "particles.description=trees", "particles.repeats=2",
            "particles.number=50", "particles.bins=5", "particles.fragmentation=true"))
        gaps = folder / "gaps.csv"
        gaps.write_text("carbon, band_gap\n10, 4\n50, 1\n", encoding="utf-8")
        runs["soot_molecules"] = (CASES / "particles_along/premixed_ethylene_molecules/deck.yaml", *running.settings(
            "particles.number=32", "particles.repeats=2", "gas.end=1 ms", "particles.tables_at=[1 ms]", "particles.bins=5",
            f"particles.molecules.band_gap={gaps}"))
        runs["site_counting"] = (CASES / "pah/site_counting/lattice.yaml", *running.settings("repeats=20", "gas.end=5 us"))
        along = CASES / "particles_along/premixed_ethylene_abf/deck.yaml"
        runs["along"] = (along, *running.settings("particles.repeats=2", "particles.number=32", "gas.end=4 ms", "output.times=[1 ms]",
                                                  "output.interval=2 ms"))
        along_model = folder / "along_model.yaml"
        along_model.write_text(f"problem: prescribed_gas\nmechanism: {CASES}/mechanisms/ethylene_abf2000_101.yaml\n"
                               f"gas: {{file: {along.parent}/gas.csv, end: 1 ms}}\nparticles: {{description: sectional, pah: [A4]}}\n"
                               "output: {interval: 1 ms}\n", encoding="utf-8")
        runs["along_model"] = (along_model,)

        def compute(run: str) -> None:
            result = program("run", *runs[run], "--out", folder / run, timeout=120)
            assert result.code == 0, f"{run}: {result.err}"

        running.at_once(compute, runs)
        check_atoms(folder / "soot/results.h5")
        check_atoms(folder / "flame_trees/results.h5")
        for run in runs:
            for path, unit in written(folder / run / "results.h5").items():
                if re.search("[a-z][0-9]", unit):
                    problems.append(f"{run}: {path} has the unit {unit}; powers are written with ^")
                matches = [entry for entry in page if entry[0].fullmatch(path)]
                # A name without placeholders says more than one with them.
                matches = [entry for entry in matches if entry[1] == path] or matches
                used.update(entry[1] for entry in matches)
                if not matches:
                    problems.append(f"{run}: {path} [{unit}] is not in docs/formats.md")
                elif not any(unit in entry[2] or entry[2] == ["of the model"] for entry in matches):
                    problems.append(f"{run}: {path} has the unit {unit}, docs/formats.md says {matches[0][2]}")
    problems += [f"docs/formats.md has {path}, which no run wrote" for _, path, _ in page if path not in used]
    print("\n".join(problems) if problems else f"{len(page)} names and units agree")
    return 1 if problems else 0


sys.exit(main(*sys.argv[1:]))
