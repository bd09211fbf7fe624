"""Every particle of a reactor run with trees of primaries as tables: what they add up to, and pictures from them.

Usage: particle_tables_test.py EXECUTABLE MPIEXEC...
Exit code 77 (skipped) where a Python package is missing.
"""

import pathlib
import sys
import tempfile

import running

h5py = running.package("h5py")
running.needs("matplotlib")  # for scripts/plot
np = running.package("numpy")

DECK = running.SOURCE / "cases/reactor/silica_batch/deck.yaml"
COMPONENTS = ("Si", "O", "OH")


def compute(program, out, *pairs):
    return program("run", DECK, "--out", out, *running.settings(
        "time.end=0.3 s", "output.interval=0.1 s", "particles.number=128", "particles.repeats=2", *pairs), timeout=300)


def read(out):
    """Columns of each table of each moment, and the attributes of the moment."""
    with h5py.File(out / "results.h5", "r") as file:
        return [({table: {name: values[()] for name, values in group[table].items()} for table in group}, dict(group.attrs))
                for group in (file["particles/tables"][name] for name in sorted(file["particles/tables"], key=int))]


def close(one, other, what):
    assert np.allclose(one, other, rtol=1e-11, atol=0), f"{what}: {one} and {other}"


def check_sums(tables):
    particles, primaries, necks = tables["particles"], tables["primaries"], tables["necks"]
    row = {name.removeprefix("silica_"): values[0] for name, values in tables["row"].items()}
    number = particles["number"]
    close(number.sum(), row["number_density"], "number")
    assert len(number) == row["numerical_particles"]
    for name, total in (("volume", "volume_fraction"), ("surface", "surface_area"), *zip(COMPONENTS, COMPONENTS, strict=True)):
        close((number * particles[name]).sum(), row[total], name)
    for name in ("primaries", "collision_diameter", "sphere_diameter", "primary_diameter", "sintering_level"):
        close((number * particles[name]).sum() / number.sum(), row[name], name)
    assert particles["primaries"].max() == row["largest"]

    of = primaries["particle"]
    assert np.all(np.diff(of) >= 0)
    close(np.bincount(of), particles["primaries"], "primaries of each particle")
    for name in COMPONENTS:
        close(np.bincount(of, primaries[name]), particles[name], f"{name} of each particle")
    close(np.bincount(of, np.pi / 6 * primaries["diameter"] ** 3), particles["volume"], "volume of each particle")
    close(np.bincount(of, primaries["diameter"]) / np.bincount(of), particles["primary_diameter"], "primary diameter")

    many = particles["primaries"] > 1
    assert many.any() and len(necks["particle"]) == len(of) - len(number)
    close(np.bincount(necks["particle"], minlength=len(number)), particles["primaries"] - 1, "necks of each particle")
    levels = np.bincount(necks["particle"], necks["sintering_level"], len(number))
    assert np.allclose(levels[many] / (particles["primaries"][many] - 1), particles["sintering_level"][many], rtol=0, atol=1e-9)
    # The k-th neck joins both parts, each by one of its primaries, all of one particle.
    k = np.arange(len(of))[np.r_[np.diff(of) == 0, False]]
    assert np.all((necks["first"] <= necks["left"]) & (necks["left"] <= k) & (k < necks["right"]) & (necks["right"] <= necks["last"]))
    assert np.all(of[necks["first"]] == necks["particle"]) and np.all(of[necks["last"]] == necks["particle"])


def main(executable, *mpiexec):
    program = running.Program(executable, list(mpiexec), 1)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        plain, out = folder / "plain", folder / "tables"
        assert compute(program, plain).code == 0
        result = compute(program, out, "particles.tables_at=[0.3 s, 0 s, 0.1 s]")
        assert result.code == 0, result.err
        moments = read(out)
        assert [attributes["time"] for _, attributes in moments] == [0, 0.1, 0.3] and moments[0][1]["repeat"] == 1
        assert len(moments[0][0]["particles"]["number"]) == 0
        for tables, _ in moments[1:]:
            check_sums(tables)
        # Tables at rows that there are anyway change nothing else.
        with h5py.File(plain / "results.h5", "r") as one, h5py.File(out / "results.h5", "r") as other:
            assert "tables" not in one["particles"]
            for column in one["history"]:
                assert np.array_equal(one["history"][column], other["history"][column]), column
        for pair in ("particles.tables_at=[0.4 s]", "particles.tables_at=[-1 s]", "particles.tables_at_place=[1 mm]"):
            wrong = compute(program, folder / "wrong", pair)
            assert wrong.code == 2 and "particles.tables_at" in wrong.err, wrong.err

        none = compute(program, folder / "none", "particles.tables_at=[]", "time.end=1 ms", "output.interval=1 ms")
        assert none.code == 0, none.err

        drawn = running.script(running.SOURCE / "scripts/plot", out)
        assert drawn.code == 0, drawn.err
        for picture in ("micrographs_1", "micrographs_2", "particle_distributions_2", "particle_classes_2"):
            assert (out / f"pictures/{picture}.png").stat().st_size > 0, drawn.out
    return 0


sys.exit(main(*sys.argv[1:]))
