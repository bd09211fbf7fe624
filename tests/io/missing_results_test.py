"""What scripts say of results that are missing or damaged: one line with what was expected, and an exit code of 2; and of repeats that
are no pairs."""

import json
import pathlib
import subprocess
import sys
import tempfile

try:
    import h5py
    import matplotlib  # noqa: F401
except ImportError:
    sys.exit(77)

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS.parent / "tests/app"))
import running  # noqa: E402

PYTHON = SCRIPTS.parent / "python"
# Each with what follows the folder of results, and what it is to say where there is no such folder.
MEASURED = SCRIPTS.parent / "cases/reactor/psr_pfr_ethylene/reference/psd_exit.csv"
COMMANDS = [
    ("compare_sizes", ("--measured", MEASURED, "--where", "equivalence_ratio=2"), "expected the folder of a run or its results.h5"),
    ("compare_sections", (), "expected the folder of a run or its results.h5"),
    ("compare_flame", ("none.csv",), "expected the folder of a run or its results.h5"),
    ("compare_santoro", (), "expected the folder of a run"),
    ("compare_premixed_soot", (), "expected that of a study or of a run"),
    ("compare_centreline", ("none.csv",), "expected the folder of a run"),
    ("check_soot_trends", (), "expected the folder of a study"),
    ("plot", (), "expected the folder of a run or study"),
]


def check_pairs(folder):
    """Repeats of other random numbers are refused, the same are compared."""
    for name, seed in (("first", 1), ("same", 1), ("other", 2)):
        (folder / name).mkdir()
        (folder / name / "run.json").write_text(json.dumps({"seed": seed, "deck": {"problem": "engine"}}), encoding="utf-8")
        with h5py.File(folder / name / "results.h5", "w") as file:
            for quantity in ("cycle", "ca50"):
                file.create_dataset(f"repeats/{quantity}", data=[1.0, 2.0, 3.0 * seed]).attrs.update(unit="1", description="of a test")
    same, other = (running.script(SCRIPTS / "compare_repeats", folder / "first", folder / name, "--of", "ca50") for name in ("same", "other"))
    assert same.code == 0 and "0.0 errors" in same.out, same
    assert other.code != 0 and "sample.seed is 2, 1 in" in other.err and other.out == "", other


def main():
    with tempfile.TemporaryDirectory() as name:
        missing, damaged = pathlib.Path(name) / "missing", pathlib.Path(name) / "damaged"
        damaged.mkdir()
        (damaged / "results.h5").write_text("no HDF5 file", encoding="utf-8")
        (damaged / "study.csv").write_text("run,status\nnone,done\n", encoding="utf-8")

        def as_users_start_it(script, folder, *more):
            done = subprocess.run([SCRIPTS / script, folder, *more], capture_output=True, text=True, check=False, cwd=name)
            return running.Result(done.returncode, done.stdout, done.stderr)

        def in_a_copy_of_this_process(script, folder, *more):
            return running.script(SCRIPTS / script, folder, *more)

        def problem(script, more, expected, folder, start):
            done = start(script, folder, *more)
            told = done.err.splitlines()
            good = (done.code == 2 and done.out == "" and len(told) == 1 and str(folder) in told[0]
                    and (folder == damaged or expected in told[0]))
            print(f"{'ok' if good else 'FAILED':8}{script}, {folder.name}: {done.code} {done.err.strip()}")
            return not good

        def crash():
            """A library that crashes on a file takes its own process along, not what the script says."""
            script = "import os, sys; from lampblack.damage import guarded; sys.exit(guarded(os.abort))"
            done = subprocess.run([sys.executable, "-c", script, damaged], capture_output=True, text=True, check=False, cwd=PYTHON)
            assert (done.returncode, done.stderr) == (
                2, f"{damaged}: damaged: the library that reads it crashed (SIGABRT)\n"), done

        crash()
        check_pairs(pathlib.Path(name))
        script = "import os, sys; from lampblack.damage import guarded; sys.exit(guarded(lambda: os.kill(os.getpid(), 9)))"
        done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False, cwd=PYTHON)
        assert (done.returncode, done.stderr) == (-9, ""), done  # not the file's fault
        failed = [problem(*COMMANDS[-1], folder, as_users_start_it) for folder in (missing, damaged)]
        failed += [problem(*command, folder, in_a_copy_of_this_process) for command in COMMANDS for folder in (missing, damaged)]
        return 1 if any(failed) else 0


sys.exit(main())
