"""The shipped case, coarse and short, on one and three ranks: the same results, closed budgets, readable files.

Usage: rank_independence_test.py EXECUTABLE MPIEXEC... [--all]. With --all on two ranks, too. Exit code 77 (skipped) where h5py or meshio is not installed.

Ranks differ in the order of sums in the pressure solver, whose error (1e-9 of the face flows) the chemistry then sees,
and in how its steps fall. Solved to 1e-9, the chemistry adds nothing visible: fields were seen to agree to 2e-8 of their
largest value. The bound, 1e-7, leaves room for other machines.
"""

import json
import pathlib
import sys
import tempfile

import running

meshio = running.package("meshio")
np = running.package("numpy")

DECK = running.SOURCE / "cases/flow/counterflow_ethylene/deck.yaml"
ABSOLUTE = 1e-15  # of the chemistry, in mass fraction
SETTINGS = ("mesh.refinement=0.25", "time.end=0.06 ms", "output.interval=0.03 ms", "output.species=[all]",
            "boundaries.fuel.swirl_velocity=10 cm/s",
            "chemistry.relative_tolerance=1e-9", f"chemistry.absolute_tolerance={ABSOLUTE}",
            "trajectories.duration=2 ms", "trajectories.particles=64")
BOUND = 1e-7
# Depends on the ranks by its nature (who owns what, who waited, how a solver got there) or is round-off.
OWN = ("owner", "imbalance_before", "imbalance_after", "pressure_iterations", "species_iterations",
       "stiff_solver_steps", "stiff_solver_retries", "reacting_cells", "skipped_cells", "continuity_error",
       "mass_fraction_sum_error", "minimum_mass_fraction", "undershoot")


def run(executable: str, mpiexec: list, ranks: int, folder: pathlib.Path) -> dict:
    program = running.Program(executable, mpiexec, ranks)
    result = program("run", DECK, *running.settings(*SETTINGS), "--out", folder, timeout=300)
    assert result.code == 0, f"{ranks} ranks: exit code {result.code}\n{result.err}"
    assert not result.err, f"{ranks} ranks: a good run complains:\n{result.err}"
    record = json.loads((folder / "run.json").read_text(encoding="utf-8"))
    assert record["status"] == "done" and record["message"] == "" and record["ranks"] == ranks, record
    assert not (folder / "results.h5.part").exists()
    return running.datasets(folder / "results.h5")


def check_history(data: dict, ranks: int) -> None:
    history = {name.split("/")[1]: values for name, values in data.items() if name.startswith("history/")}
    errors = {name: np.abs(values).max() for name, values in history.items() if name.endswith("_budget_error")}
    assert len(errors) >= 5, f"budgets of mass, H, C, N and O are expected, not {sorted(errors)}"
    assert max(errors.values()) < 1e-6, f"{ranks} ranks: budgets are open: {errors}"
    total = history["mass_fraction_sum_error"].max()
    assert total < 1e-10, f"{ranks} ranks: sum of mass fractions is wrong by {total}"
    print(f"{ranks} ranks: budgets closed to {max(errors.values()):.1e}, sum of mass fractions to {total:.1e}")


def check_pictures(folder: pathlib.Path) -> None:
    with meshio.xdmf.TimeSeriesReader(folder / "results.xdmf") as reader:
        points, cells = reader.read_points_cells()
        assert cells[0].type == "quad" and cells[0].data.max() == len(points) - 1
        assert reader.num_steps == 3, f"{reader.num_steps} steps, expected those at 0, 0.03 and 0.06 ms"
        for k, expected in enumerate((0.0, 0.03e-3, 0.06e-3)):
            time, _, fields = reader.read_data(k)
            assert abs(time - expected) < 1e-12, f"step {k} is at {time} s"
            assert "temperature" in fields and all(np.all(np.isfinite(values[0])) for values in fields.values())


def difference(name: str, one: dict, other: dict) -> float:
    """The largest difference of a dataset over its largest value."""
    a, b = one[name], other[name]
    assert a.shape == b.shape, f"{name}: shapes {a.shape} and {b.shape}"
    if a.dtype.kind not in "fc":
        assert np.array_equal(a, b), f"{name}: integers or texts differ"
        return 0.0
    assert np.all(np.isfinite(a)) and np.all(np.isfinite(b)), f"{name} is not finite"
    away = np.abs(a - b)
    floor = 0.0
    leaf = name.rsplit("/", 1)[1]
    if leaf.startswith("X_"):
        floor = 100 * ABSOLUTE
    if leaf.startswith("soot_") and leaf.endswith("_diameter"):  # of nothing it is noise
        present = one[name.replace(leaf, "soot_volume_fraction")]
        away = np.where(present > 1e-6 * present.max(), away, 0.0)
    largest = np.abs(a).max()
    excess = np.maximum(away - floor, 0.0).max()
    return excess / largest if excess > 0 else 0.0


def main(executable: str, *mpiexec: str) -> None:
    numbers = (1, 2, 3) if mpiexec[-1] == "--all" else (1, 3)
    launcher = [word for word in mpiexec if word != "--all"]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        runs = {ranks: run(executable, launcher, ranks, folder / str(ranks)) for ranks in numbers}
        for ranks, data in runs.items():
            check_history(data, ranks)
            check_pictures(folder / str(ranks))
    for ranks in numbers[1:]:
        assert set(runs[ranks]) == set(runs[1]), f"other datasets on {ranks} ranks: {set(runs[ranks]) ^ set(runs[1])}"
        assert len(set(runs[ranks]["mesh/owner"])) == ranks, "a rank owns nothing"
        compared = [path for path in runs[1] if not path.endswith(OWN) and not path.endswith("_budget_error")]
        away = {path: difference(path, runs[1], runs[ranks]) for path in compared}
        worst = sorted(away, key=away.get, reverse=True)[:3]
        print(f"{ranks} ranks against 1, {len(compared)} datasets: " + ", ".join(f"{p} {away[p]:.1e}" for p in worst))
        assert away[worst[0]] <= BOUND, f"{worst[0]} depends on the ranks: {away[worst[0]]:.1e}, bound {BOUND}"


main(*sys.argv[1:])
