"""A flow with ensembles in its cells, as a user runs it: budgets close, fields and counts are there, a restart from the middle goes on
to the same bits, other ranks carry it on, a partition that changes on the way loses nothing; and decks that are refused.

Usage: ensemble_run_test.py EXECUTABLE MPIEXEC...
"""

import pathlib
import sys
import tempfile

import restart_test
import running

h5py = running.package("h5py")

STEPS = ("time.end=40 us", "time.maximum_step=2 us", "output.interval=20 us", "output.history_steps=1", "output.species=[A2]")
STOCHASTIC = "particles={{description: ensemble, method: {method}, number: 40, minimum_number_density: 1e9 1/m^3, averaging_time: {average}}}"
FIELDS = ("soot_volume_fraction", "soot_number_density", "soot_primary_diameter", "numerical_particles", "soot_owed_carbon")

# What is set, and what the message has to name.
REFUSED = (
    (("particles={description: ensemble, number: 4}",), "particles.number"),
    (("stochastic={}", "soot.model=hmom"), "takes the place of the model"),
    (("particles={description: ensemble, exchange: one_way, averaging_time: 1 ms}",), "averaging_time"),
    (("particles={description: ensemble, smallest: 100 nm, largest: 10 nm}",), "particles.largest"),
    (("particles={description: ensemble, repeats: 4}",), "repeats"),
)


def last_row(out):
    """The last row of the history, by the names of its columns without their units."""
    return {column.split(" ")[0]: float(value) for column, value in restart_test.rows(out)[-1].items()}


def settings(method="sammc", average="10 us"):
    return running.settings(*STEPS, STOCHASTIC.format(method=method, average=average))


def check_run(program, deck, out, *options):
    restart_test.run(program, deck, *options, "--out", out)
    last = last_row(out)
    for element in ("mass", "C", "H", "O", "N"):
        assert last[f"{element}_budget_error"] < 1e-12, (element, last)
    assert last["numerical_particles"] > 100, last
    with h5py.File(out / "results.h5", "r") as file:
        fields = file["steps"][max(file["steps"])]
        for name in FIELDS:
            assert name in fields, name
        assert fields["soot_volume_fraction"][()].max() > 0
        assert fields["numerical_particles"][()].max() <= 40
    return last


def main(executable, *mpiexec):
    one, two = (running.Program(executable, list(mpiexec), ranks) for ranks in (1, 2))
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        deck = running.small_case(folder)
        for options, expected in REFUSED:
            result = one("check", deck, *running.settings(*options))
            assert result.code == 2 and expected in result.err, (options, result.err)
        for method in ("dsmc", "swa"):
            # Equal weights come and go with whole particles: mass in the mean, the rest is counted.
            out = folder / method
            restart_test.run(one, deck, *settings(method), "--out", out)
            last = last_row(out)
            assert last["numerical_particles"] > 100, last
            assert abs(last["soot_resampled"]) <= 0.5 * last["C_content"], last
        whole = folder / "whole"
        options = settings()
        check_run(one, deck, whole, *options, "--set", "checkpoint.steps=12")
        restart_test.run(one, deck, *options, "--out", folder / "rest", "--restart", whole / "checkpoint/step_000012.h5")
        restart_test.assert_equal(folder / "rest", whole)
        restart_test.run(two, deck, *options, "--out", folder / "other", "--restart", whole / "checkpoint/step_000012.h5")
        held = (*options, "--set", "particles.frozen_gas=20 us")
        check_run(one, deck, folder / "held", *held, "--set", "checkpoint.steps=16")
        restart_test.run(one, deck, *held, "--out", folder / "held_rest", "--restart", folder / "held/checkpoint/step_000016.h5")
        restart_test.assert_equal(folder / "held_rest", folder / "held")
        check_run(one, deck, folder / "at_once", *settings(average="0 s"))
        check_run(two, deck, folder / "moving", *options, *running.settings("mesh.repartition=1.0001", "chemistry.share_work=false"))
    print("passed")


if __name__ == "__main__":
    main(*sys.argv[1:])
