"""Results that are compressed, and written by one rank, against results that are not: the same fields in a smaller file, which a
restart, another flow and the pictures read. And distances from walls, which are a field on request.

Usage: compressed_results_test.py EXECUTABLE MPIEXEC...
"""

import pathlib
import sys
import tempfile

import running

h5py = running.package("h5py")
np = running.package("numpy")

SHORT = ("time.end=2 us", "time.maximum_step=1 us", "output.interval=1 us", "mesh.refinement=4.3",
         "output.species=[all]", "chemistry.share_work=false")
COMPRESSED = ("output.compression=6", "output.writers=1", "output.wall_distance=true")


def steps(results: pathlib.Path) -> dict:
    found = {}
    with h5py.File(results, "r") as file:
        file["steps"].visititems(lambda name, item: found.update({name: (item[()], item.compression)})
                                 if isinstance(item, h5py.Dataset) else None)
    return found


def distances(out: pathlib.Path) -> None:
    """Walls are both ends beyond 10 mm, of 8 mm apart: the nearest place of each is straight below or its edge."""
    with h5py.File(out / "results.h5", "r") as file:
        r, z = file["mesh/cellCentre"][:, 0], file["mesh/cellCentre"][:, 1]
        field = file["steps/000000/wall_distance"]
        assert field.attrs["unit"] in ("m", b"m")
        expected = np.hypot(np.maximum(0.01 - r, 0), np.minimum(z, 0.008 - z))
        assert np.abs(field[()] - expected).max() < 1e-15, np.abs(field[()] - expected).max()


def main(executable: str, *mpiexec: str) -> None:
    program = running.Program(executable, list(mpiexec), 2)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        deck = running.small_case(folder)

        def run(out, *settings, more=()):
            result = program("run", deck, "--out", folder / out, *more, *running.settings(*settings))
            assert result.code == 0, result.err
            return folder / out

        plain = run("plain", *SHORT)
        packed = run("packed", *SHORT, *COMPRESSED)
        distances(packed)
        before, after = steps(plain / "results.h5"), steps(packed / "results.h5")
        assert after.keys() - before.keys() == {name for name in after if name.endswith("/wall_distance")}
        for key, (values, compression) in before.items():
            assert compression is None and after[key][1] == "gzip", key
            assert values.tobytes() == after[key][0].tobytes(), key
        sizes = [(out / "results.h5").stat().st_size for out in (plain, packed)]
        assert sizes[1] < 0.8 * sizes[0], sizes

        # A run in two parts; the first steps come from files that are compressed too.
        run("parts", *SHORT, *COMPRESSED, "time.end=1 us", "checkpoint.at_end=true")
        parts = run("parts", *SHORT, *COMPRESSED, more=("--restart",))
        there = steps(parts / "results.h5")
        for key, (values, compression) in steps(packed / "results.h5").items():
            if key.endswith("_us"):
                continue
            assert there[key][1] == "gzip" and there[key][0].tobytes() == values.tobytes(), key

        run("from_packed", *SHORT, "initial={layer: none, flow: {results: ../packed}}", "time.end=1 us")
        drawn = running.script(running.SOURCE / "scripts/plot", packed, "--fields", "temperature", "wall_distance")
        assert drawn.code == 0, drawn.err

        for setting, expected in (("output.compression=10", "output.compression: expected"),
                                  ("output.compression=-1", "output.compression: expected"),
                                  ("output.writers=0", "output.writers: expected"),
                                  ("output.writers=3", "output.writers: expected 2 at most, the number of ranks, found 3")):
            result = program("check", deck, *running.settings(setting))
            assert result.code == 2 and expected in result.err, (setting, result.err)


main(*sys.argv[1:])
