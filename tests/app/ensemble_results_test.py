"""What a flow with ensembles in its cells leaves: averages over time against the steps they are of, sizes that sum up to
numbers, regions against the cells in them, on one rank and two, and going on from a checkpoint to the same bits; and what is
refused.

Usage: ensemble_results_test.py EXECUTABLE MPIEXEC...
"""

import pathlib
import sys
import tempfile

import running

h5py, np = running.package("h5py"), running.package("numpy")
running.needs("matplotlib")
image = running.package("PIL.Image")

MIDDLE = 30  # of some 60 steps; within a block
SETTINGS = ("time.end=120 us", "time.maximum_step=2 us", "output.interval=40 us", "output.species=[A2]",
            "particles={description: ensemble, shape: aggregates, number: 50, minimum_number_density: 1e8 1/m^3, bins: 12, split_tolerance: 0.1}",
            "particles.statistics={start: 40 us, block: 10.5 us}",
            "particles.regions={flame: {from: [0 mm, 2 mm], to: [6 mm, 6 mm]}, cold: {from: [0 mm, 7 mm], to: [6 mm, 8 mm]}}",
            "output.lines={axis: {from: [0 mm, 1 mm], to: [0 mm, 7 mm], points: 5}}",
            "output.quantities=[soot_size_distribution, soot_number_density_mean, soot_number_density_interval]")
WRONG = (("particles.statistics.start=1 ms", "particles.statistics.start", "expected less than 'time.end'"),
         ("particles.statistics.block=0 s", "particles.statistics.block", "above"),
         ("particles.statistics.drift=1", "particles.statistics.drift", "below 1"),
         ("particles.regions.flame.to=[6 mm, 1 mm]", "particles.regions.flame.to", "more than 'from' along z"),
         ("particles.regions.flame.to=[6 mm]", "particles.regions.flame.to", "expected 2 coordinates, found 1"),
         ("particles.regions.flame.from=[5.9 mm, 2.1 mm]", "particles.regions.flame", "no cell of the mesh has its centre"),
         ("particles.regions={'a/b': {from: [0 mm, 0 mm], to: [1 mm, 1 mm]}}", "particles.regions.a/b", "that of a file"),
         ("particles.regions.flame.size=1", "particles.regions.flame.size", "unknown key"),
         ("output.quantities=[soot_size_distribution_means]", "output.quantities", "is no field of this flow"))


def run(program, *arguments):
    result = program("run", *arguments, timeout=200)
    assert result.code == 0, f"{arguments}: {result.err}"
    return result


def datasets(out):
    found = {}
    with h5py.File(out / "results.h5", "r") as file:
        file.visititems(lambda name, item: found.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
    return found


def check_averages(data):
    """Of equal steps, from 40 us on, blocks of six: the seventh is not full."""
    steps = sorted({name.split("/")[1] for name in data if name.startswith("steps/")})
    assert len(steps) == 4
    last = {name.split("/")[2]: values for name, values in data.items() if name.startswith(f"steps/{steps[-1]}/")}
    first = [name for name in data if name.startswith(f"steps/{steps[1]}/") and name.endswith(("_mean", "_interval"))]
    assert not first, f"averages before they start: {first}"
    history = {name[8:]: values for name, values in data.items() if name.startswith("history/")}
    since, blocks = history["soot_averages_since"], history["soot_averaged_blocks"]
    assert np.isnan(since[0]) and since[-1] >= 40e-6 * (1 - 1e-9) and since[-1] < 42.1e-6, since[-1]
    assert blocks[0] == 0 and 6 <= blocks[-1] <= 8, blocks[-1]
    # What grows is in its mean between start and end.
    number, mean = last["soot_number_density"], last["soot_number_density_mean"]
    early = data[f"steps/{steps[1]}/soot_number_density"]
    assert number.sum() > mean.sum() > early.sum() > 0, (number.sum(), mean.sum(), early.sum())
    assert np.all(last["soot_number_density_interval"] >= 0) and last["soot_number_density_interval"].max() > 0
    line = data["lines/axis/soot_number_density_mean"].reshape(-1, 5)
    assert np.all(np.isnan(line[:2])) and np.all(np.isfinite(line[-1])), line
    return steps, last


def region_weights(data):
    """Shares of the cells in the volume of the region `flame`."""
    volume, centre = data["mesh/cellVolume"], data["mesh/cellCentre"]
    inside = (centre[:, 0] <= 6e-3) & (centre[:, 1] >= 2e-3) & (centre[:, 1] <= 6e-3)
    return np.where(inside, volume, 0.0) / volume[inside].sum()


def check_sizes(data, steps, last):
    """Sums of bins; regions against their cells."""
    edges = data["soot_sizes/bin_edges"]
    assert edges.shape == (13,) and abs(edges[0] / 0.5e-9 - 1) < 1e-12 and abs(edges[-1] / 500e-9 - 1) < 1e-12
    width = np.log10(edges[1] / edges[0])
    sizes, number, weights = last["soot_size_distribution"], last["soot_number"], region_weights(data)
    assert np.allclose(sizes.sum(axis=1) * width, number, rtol=1e-12, atol=0)
    assert np.allclose(last["soot_size_distribution_mean"].sum(axis=1) * width, last["soot_number_density_mean"],
                       rtol=0.2, atol=0.2 * number.max()), "of about the same time"
    table = {name.split("/")[-1]: values for name, values in data.items() if name.startswith("regions/flame/sizes/")}
    assert table["size_distribution"].size == len(steps) * 12
    assert np.allclose(table["size_distribution"][-12:], weights @ sizes, rtol=1e-12, atol=0)
    joint = {name.split("/")[-1]: values for name, values in data.items() if name.startswith("regions/flame/joint/")}
    now = joint["step"] == float(int(steps[-1]))
    mass = last["soot_carbon"] + last["soot_hydrogen"]
    for column, field in (("number_density", number), ("mass_density", mass), ("surface_area", last["soot_surface"])):
        assert abs(joint[column][now].sum() / (weights @ field) - 1) < 1e-12, column
    assert data["regions/cold/joint/step"].size == 0, "no particles in the cold"
    assert data["regions/cold/sizes/size_distribution"].max() == 0


def check_restart(program, mpiexec, executable, folder, deck, whole):
    options = running.settings(*SETTINGS)
    checkpoint = whole / f"checkpoint/step_{MIDDLE:06}.h5"
    expected = datasets(whole)
    run(program, deck, *options, "--out", folder / "rest", "--restart", checkpoint)
    found = datasets(folder / "rest")
    assert found.keys() == expected.keys(), found.keys() ^ expected.keys()
    different = [name for name in expected if found[name].tobytes() != expected[name].tobytes()]
    assert not different, f"a run that goes on differs in {different}"
    for path in (whole / "tables").iterdir():
        assert path.read_text() == (folder / "rest/tables" / path.name).read_text(), path.name
    # Another number of ranks: the same but for what the solvers' tolerances leave.
    run(running.Program(executable, mpiexec, 2), deck, *options, "--out", folder / "two", "--restart", checkpoint)
    found = datasets(folder / "two")
    last = max(name for name in expected if name.startswith("steps/")).rsplit("/", 1)[0]
    for name in ("soot_number_density_mean", "soot_volume_fraction_mean"):
        value, reference = found[f"{last}/{name}"], expected[f"{last}/{name}"]
        assert abs(value - reference).max() < 0.05 * reference.max(), name
    assert found["history/soot_averaged_blocks"][-1] == expected["history/soot_averaged_blocks"][-1]
    # In a gas that stays as it is the particles do not show the ranks: the same bits.
    frozen = [*options, *running.settings("particles.frozen_gas=50 us")]
    run(program, deck, *frozen, "--out", folder / "alone", "--restart", checkpoint)
    run(running.Program(executable, mpiexec, 2), deck, *frozen, "--out", folder / "together", "--restart", checkpoint)
    alone, together = datasets(folder / "alone"), datasets(folder / "together")
    fields = [name for name in alone if name.startswith(f"{last}/soot_")]
    assert len(fields) > 5 and any(alone[name].max() > 0 for name in fields)
    assert any(alone[name].tobytes() != expected[name].tobytes() for name in fields), "nothing was frozen"
    different = [name for name in fields if alone[name].tobytes() != together[name].tobytes()]
    assert not different, f"on two ranks other particles: {different}"
    # Averages that are left out are gone; those that the run before did not have begin.
    without = [setting for setting in SETTINGS if "statistics" not in setting and "quantities" not in setting]
    run(program, deck, *running.settings(*without, "time.end=66 us"), "--out", folder / "without", "--restart", checkpoint)
    assert not any(name.endswith("_mean") for name in datasets(folder / "without")), "averages that nobody asked for"
    short = running.settings(*without, "checkpoint.at_end=true", "time.end=20 us", "output.interval=20 us")
    run(program, deck, *short, "--out", folder / "later")
    run(program, deck, *options, *running.settings("particles.statistics.start=10 us", "output.interval=20 us", "time.end=40 us"),
        "--out", folder / "later", "--restart")
    found = datasets(folder / "later")
    assert abs(found["history/soot_averages_since"][-1] - 20e-6) < 1e-9 and found["history/soot_averaged_blocks"][-1] == 1


def check_without_sizes(program, folder, deck):
    settings = [s for s in SETTINGS if "quantities" not in s] + [
        "particles.size_distribution=false", "particles.shape=spheres", "particles.statistics.start=10 us",
        "time.end=30 us", "output.interval=10 us"]
    run(program, deck, *running.settings(*settings), "--out", folder / "spheres")
    data = datasets(folder / "spheres")
    assert not any("size_distribution" in name for name in data if name.startswith("steps/"))
    assert not any("joint" in name for name in data)
    # The table of each region has its rows.
    last = max(name for name in data if name.startswith("steps/")).split("/")[1]
    weights = region_weights(data)
    for name, number in (("flame", weights @ data[f"steps/{last}/soot_number"]), ("cold", 0.0)):
        table = data[f"regions/{name}/sizes/size_distribution"].reshape(4, 12)
        width = np.log10(data["soot_sizes/bin_edges"][1] / data["soot_sizes/bin_edges"][0])
        assert abs(table[-1].sum() * width - number) <= 1e-12 * number, name


def check_pictures(whole):
    drawn = running.script(running.SOURCE / "scripts/plot", whole)
    assert drawn.code == 0, drawn.err
    for name in ("soot_averages.png", "sizes_region_flame.png", "sizes_line_axis.png", "sizes_centreline.png", "sizes_plane.png"):
        assert (whole / "pictures" / name).read_bytes()[1:4] == b"PNG", (name, drawn.out)
    film = image.open(whole / "pictures/sizes.gif")
    assert film.n_frames == 3, "a frame for each output with particles"


def check_wrong(program, deck, folder):
    def check(mistake):
        setting, key, words = mistake
        result = program("run", deck, *running.settings(*SETTINGS, setting), "--out", folder / "wrong")
        assert result.code == 2 and result.err.count("lampblack: ") == 1, (setting, result)
        assert key in result.err and words in result.err, (setting, result.err)
        assert not (folder / "wrong").exists(), setting

    running.at_once(check, WRONG)


def main(executable: str, *mpiexec: str) -> int:
    program = running.Program(executable, list(mpiexec), 1)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        deck = running.small_case(folder)
        text = deck.read_text(encoding="utf-8")
        deck.write_text(text[:text.index("trajectories:")], encoding="utf-8")
        check_wrong(program, deck, folder)
        whole = folder / "whole"
        result = run(program, deck, *running.settings(*SETTINGS, f"checkpoint.steps={MIDDLE}"), "--out", whole)
        assert "averages of the soot since t = 4" in result.out, result.out
        data = datasets(whole)
        check_sizes(data, *check_averages(data))
        check_pictures(whole)
        check_restart(program, list(mpiexec), executable, folder, deck, whole)
        check_without_sizes(program, folder, deck)
    return 0


sys.exit(main(*sys.argv[1:]))
