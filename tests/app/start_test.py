"""How the program starts: what starts MPI and what does not, no daemon beside a run of one rank, and runs that start their
own ranks.

Usage: start_test.py EXECUTABLE MPIEXEC...
"""

import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

import running

ANALYSIS = str(running.SOURCE / "cases/reactor/silica_batch/analysis.yaml")
METHANE = str(running.SOURCE / "cases/mechanisms/methane_gri30_53.yaml")
IGNITION = str(running.SOURCE / "cases/reactor/ignition_hydrogen/deck.yaml")
FLAME = str(running.SOURCE / "cases/flame1d/free_methane/deck.yaml")
SHORT = running.settings("time.end=0.1 ms")


def plain_environment(**more) -> dict:
    """As a user has it: nothing of Open MPI is set."""
    env = {name: value for name, value in os.environ.items() if not name.startswith(("OMPI_", "PMIX_", "PRTE_", "HWLOC_"))}
    return dict(env, **more)


# Of runs under mpirun: no search for a cluster's network, no waiting for ranks that have ended already.
HASTE = {"OMPI_MCA_pml": "ob1", "OMPI_MCA_odls_base_sigkill_timeout": "0"}


def run(*command, **more):
    return subprocess.run(list(map(str, command)), env=plain_environment(**more), stdin=subprocess.DEVNULL, capture_output=True,
                          text=True, timeout=60, check=False)


def components(*command, **more) -> str:
    """What Open MPI loads while the command runs, as the dynamic linker says it."""
    with tempfile.TemporaryDirectory() as folder:
        run(*command, LD_DEBUG="files", LD_DEBUG_OUTPUT=f"{folder}/log", **more)
        return "\n".join(path.read_text(errors="replace") for path in pathlib.Path(folder).iterdir())


def check_what_starts_mpi(executable):
    for arguments in (["--version"], ["--help"], ["run", "--help"], ["--nonsense"], ["deck-reference"],
                      ["gas", METHANE, "--T", "1500", "--X", "CH4:1"], ["mechanism", METHANE]):
        # Where it started, it would end for want of a component of this name.
        started = run(executable, *arguments, OMPI_MCA_pml="none_such")
        assert "none_such" not in started.stderr and "mca_" not in components(executable, *arguments), f"{arguments} starts MPI"
    assert run(executable, "check", IGNITION, OMPI_MCA_pml="none_such").returncode != 0, "MPI does not start, or is not seen"
    assert "mca_btl_tcp" not in components(executable, "check", IGNITION), "a single rank looks for a network"
    chosen = run(executable, "check", IGNITION, OMPI_MCA_btl="none_such")
    assert chosen.returncode != 0, "the user's choice is lost"


def processes_beside(process: int) -> list:
    """Names of the processes of its session, and of its children elsewhere: Open MPI's daemon makes a session of its own."""
    found = []
    for path in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            name, _, rest = path.read_text().rpartition(")")
        except OSError:
            continue
        parent, session = int(rest.split()[1]), int(rest.split()[3])
        if process in (parent, session):
            found.append(name.partition("(")[2])
    return found


def is_of_open_mpi_5(folder) -> bool:
    """Where its processes without a launcher have a folder each, which it leaves behind, empty."""
    return folder.name.startswith("ompi.")


def check_no_daemon(executable, folder):
    """While one rank runs there is no other process, and two of them at once have folders of their own, which go with them."""
    temporary = folder / "tmp"
    temporary.mkdir()
    runs = [subprocess.Popen([executable, "run", IGNITION, "--out", str(folder / name), *running.settings("output.interval=1 ns")],
                             env=plain_environment(TMPDIR=str(temporary)), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                             stderr=subprocess.PIPE, start_new_session=True, text=True) for name in ("one", "two")]
    try:
        for process, name in zip(runs, ("one", "two")):
            until = time.monotonic() + 30
            while not (folder / name / "run.json").exists() and time.monotonic() < until:
                time.sleep(0.01)
            found = processes_beside(process.pid)
            assert found == ["lampblack"], f"processes of a run of one rank: {found}"
        folders = {path.name for path in temporary.iterdir() if not is_of_open_mpi_5(path)}
        assert folders <= {f"lampblack.{os.geteuid()}.{process.pid}" for process in runs}, folders
    finally:
        for process in runs:
            process.send_signal(signal.SIGTERM)
    for process in runs:
        said = process.communicate(timeout=30)[1]
        assert process.returncode == 128 + signal.SIGTERM and said.startswith("lampblack: stopped by SIGTERM"), said
    left = [path for path in temporary.iterdir() if not is_of_open_mpi_5(path)]
    assert not left, f"a run left {left}"


def check_ranks(executable, folder):
    """Runs start their own ranks; what cannot be is said once."""
    done = run(executable, "run", IGNITION, *SHORT, "--out", folder / "ranks", "--ranks", "2", **HASTE)
    assert done.returncode == 0, done
    assert json.loads((folder / "ranks/run.json").read_text())["ranks"] == 2
    done = run(executable, "run", IGNITION, *SHORT, "--out", folder / "alone", "--ranks=1")
    assert done.returncode == 0 and json.loads((folder / "alone/run.json").read_text())["ranks"] == 1, done
    # The exit code and message of the ranks are those of the command.
    done = run(executable, "run", IGNITION, "--set", "pressure=0", "--ranks", "2", "--out", folder / "wrong", **HASTE)
    assert done.returncode == 2 and "pressure" in done.stderr and done.stderr.count("lampblack: ") == 1, done
    many = len(os.sched_getaffinity(0)) + 1
    done = run(executable, "run", IGNITION, *SHORT, "--out", folder / "many", "--ranks", many, **HASTE)
    assert done.returncode == 0 and "they will take turns" in done.stdout, done
    done = run(executable, "run", IGNITION, "--ranks", "0")
    assert done.returncode == 2 and "--ranks" in done.stderr, done


def check_stops(executable, folder):
    """A signal to a run that has started its own ranks reaches them: exit code, last line and record are those of a stop."""
    for number in (signal.SIGTERM, signal.SIGINT):
        out = folder / f"stopped_{number}"
        # Of seconds on any machine.
        settings = running.settings("mechanism=ethylene_abf2000_101.yaml", "grid.slope=0.01", "grid.curve=0.01")
        process = subprocess.Popen([executable, "run", FLAME, "--ranks", "2", "--out", str(out), *settings],
                                   env=plain_environment(**HASTE), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, start_new_session=True, text=True)
        until = time.monotonic() + 30
        while not (out / "run.json").exists() and time.monotonic() < until:
            time.sleep(0.05)
        time.sleep(1.0)
        process.send_signal(number)
        said = process.communicate(timeout=30)[1]
        name = signal.Signals(number).name
        assert process.returncode == 128 + number and len(said.splitlines()) == 1, (process.returncode, said)
        assert said.startswith(f"lampblack: stopped by {name} before the end of the flame's solution"), said
        record = json.loads((out / "run.json").read_text())
        assert record["status"] == "stopped" and sum(stage["maximum_s"] for stage in record["stages"]) > 0, record
        assert record["steps"] > 0, record


def check_launchers(executable, mpiexec, folder):
    env = dict(HASTE, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    done = run(*mpiexec, "2", "--oversubscribe", executable, "run", IGNITION, "--ranks", "3", "--out", folder / "three", **env)
    assert done.returncode == 2 and done.stderr.count("the launcher made a run of 2 rank(s)") == 1, done
    done = run(executable, "run", IGNITION, "--ranks", "2", LAMPBLACK_MPIRUN="nowhere")
    assert done.returncode == 2 and "LAMPBLACK_MPIRUN: there is no program 'nowhere'" in done.stderr, done
    # The launcher of another MPI: each process believes that it is alone.
    other = folder / "other_mpirun"
    other.write_text('#!/bin/sh\nwhile [ "$1" != run ]; do last="$1"; command="$command $1"; shift; done\nexec "$last" "$@"\n')
    other.chmod(0o755)
    done = run(executable, "run", IGNITION, "--ranks", "2", "--out", folder / "other", LAMPBLACK_MPIRUN=other)
    assert done.returncode == 2 and "of another MPI" in done.stderr and not (folder / "other").exists(), done
    # One rank under a launcher is a rank of the launcher.
    done = run(*mpiexec, "1", executable, "run", IGNITION, *SHORT, "--out", folder / "launched", **env)
    assert done.returncode == 0, done


def check_first_rank(executable, mpiexec):
    """What the first of two ranks does alone ends with its exit code, said once; no rank is aborted while the other ends MPI."""
    env = dict(HASTE, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    for arguments, code, words in ((["where", "cases"], 0, "cases\n"), (["plot", "--help"], 0, "usage: lampblack plot"),
                                   (["cases", "copy", "nothing"], 2, "there is no case 'nothing'"),
                                   (["check", ANALYSIS], 2, "an analysis is checked by one process alone")):
        done = run(*mpiexec, "2", "--oversubscribe", executable, *arguments, **env)
        assert done.returncode == code and (done.stdout + done.stderr).count(words) == 1, (arguments, done)
        assert "MPI_ABORT" not in done.stderr, (arguments, done)


def main(executable, *mpiexec):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        check_what_starts_mpi(executable)
        check_no_daemon(executable, folder)
        check_ranks(executable, folder)
        check_stops(executable, folder)
        check_launchers(executable, mpiexec, folder)
        check_first_rank(executable, mpiexec)
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
