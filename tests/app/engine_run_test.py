"""An engine, from the deck to the pictures: the same numbers on any number of ranks and after a restart, balances with injection and
residual gas, repeats with intervals.

Usage: engine_run_test.py EXECUTABLE MPIEXEC...
"""

import json
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

import running

h5py = running.package("h5py")
np = running.package("numpy")

DECK = """problem: engine
mechanism: hydrogen_h2o2_10.yaml
engine: {bore: 80 mm, stroke: 90 mm, rod: 150 mm, compression_ratio: 14, speed: 1500 rpm, start: -120 deg, end: 120 deg}
charge: {temperature: 520 K, pressure: 1 bar, fuel: "H2: 1", oxidizer: "O2: 1, N2: 3.76", equivalence_ratio: 0.2, temperature_deviation: 10 K, exhaust: 0.1}
cycles: {residual: 0.05, most: 8, angle_tolerance: 6 deg, temperature_tolerance: 10 K}
mixing: {time: [10 ms]}
walls: {temperature: 420 K}
injection: {fuel: "H2: 1", angles: [-100 deg, -95 deg, -70 deg, -65 deg], rates: [0 g/s, 0.5 g/s, 0.5 g/s, 0 g/s], most_particles: 10}
sample: {particles: 8}
step: {angle: 2 deg}
output: {every: 4 deg, particles_at: [-60 deg, 0 deg, 120 deg], species: [H2, OH]}
"""


def check_restart(executable: str, deck: pathlib.Path, whole: pathlib.Path, *settings: str) -> None:
    """Stopped where a checkpoint is there, gone on: the numbers of a run that was left alone. Checkpoints at every row, or repeat."""
    out = whole.with_name(whole.name + "_stopped")
    command = [executable, "run", str(deck), "--out", str(out), *running.settings("checkpoint.wall_time=1 us", *settings)]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=running.environment())
    while process.poll() is None and not list((out / "checkpoint").glob("step_*.h5")):
        time.sleep(0.005)
    process.send_signal(signal.SIGTERM)
    assert process.wait() in (0, 128 + signal.SIGTERM), process.returncode
    went_on = subprocess.run([*command, "--restart"], capture_output=True, text=True, env=running.environment(), check=False)
    assert went_on.returncode == 0, went_on.stderr
    first, second = running.datasets(whole / "results.h5"), running.datasets(out / "results.h5")
    different = [name for name in first if first[name].tobytes() != second[name].tobytes()]
    assert not different and first.keys() == second.keys(), f"after a restart other numbers in {different}"
    other = subprocess.run([*command, *running.settings("sample.particles=9"), "--restart", "--force"], capture_output=True, text=True,
                           env=running.environment(), check=False)
    assert other.returncode != 0 and "deck but for repeats" in other.stderr, other
    # A run of one repeat keeps its cycle, one of several what repeats have left: neither goes on as the other.
    repeats = "sample.repeats=1" if settings else "sample.repeats=2"
    one = subprocess.run([*command, *running.settings(repeats), "--restart", "--force"], capture_output=True, text=True, env=running.environment(),
                         check=False)
    assert one.returncode != 0 and "another number of repeats" in one.stderr, one


def main(executable: str, *mpiexec: str) -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        deck = folder / "deck.yaml"
        deck.write_text(DECK, encoding="utf-8")
        for settings in ((), ("sample.repeats=2", "cycles.most=2")):
            runs = {}
            for ranks in (1, 2):
                out = folder / f"{len(settings)}_{ranks}"
                running.run_deck(running.Program(executable, list(mpiexec), ranks), deck, out, *running.settings(*settings))
                runs[ranks] = running.datasets(out / "results.h5")
            different = [name for name in runs[1] if runs[1][name].tobytes() != runs[2][name].tobytes()]
            assert not different, f"2 ranks: other numbers than on one in {different}"
            check_restart(executable, deck, folder / f"{len(settings)}_1", *settings)
        data = running.datasets(folder / "0_1/results.h5")
        h = {name.removeprefix("history/"): values for name, values in data.items() if name.startswith("history/")}
        results = json.loads((folder / "0_1/run.json").read_text(encoding="utf-8"))["results"]
        assert results["energy_error"] < 1e-12 and results["element_error"] < 1e-12, results
        assert np.allclose(h["angle"], np.linspace(-120, 120, 61))
        assert h["particles"][-1] == 10 and np.isclose(h["mass"][-1] - h["mass"][0], 0.5e-3 * 30 / (360 * 25), rtol=1e-9)
        fill = h["pressure"] * h["volume"] / (h["mass"] * h["temperature"])
        assert np.all((fill > 280) & (fill < 345)), fill
        work = np.sum(0.5 * (h["pressure"][1:] + h["pressure"][:-1]) * np.diff(h["volume"]))
        assert np.isclose(work, h["work"][-1], rtol=0.1), (work, h["work"][-1])
        assert -30 < results["ca50"] < 30 and results["ca10"] < results["ca50"] < results["ca90"]
        assert np.isclose(results["chemical_heat"], h["chemical_heat"][-1]) and h["X_H2"][-1] < 0.2 * h["X_H2"].max(), h["X_H2"][-1] / h["X_H2"].max()
        assert len(data["cycles/ca50"]) > 1 and data["cycles/start_temperature"][1] > data["cycles/start_temperature"][0] + 5
        assert results["cycles_converged"] and np.allclose(np.unique(data["particles/angle"]), [-60, 0, 120])
        several = running.datasets(folder / "2_1/results.h5")
        assert len(several["repeats/ca50"]) == 2 and several["repeats/ca50"][0] != several["repeats/ca50"][1]
        assert several["history/pressure"].max() <= several["repeats/largest_pressure"].mean() * (1 + 1e-9) and np.any(several["history/pressure_ci95"] > 0)
        drawn = running.script(running.SOURCE / "scripts/plot", folder / "0_1")
        assert drawn.code == 0, drawn
        for picture in ("cycle", "emissions", "scatter"):
            assert (folder / "0_1" / "pictures" / f"{picture}.png").exists(), picture
    print("ranks, restarts, balances, cycles, repeats and pictures agree")


main(*sys.argv[1:])
