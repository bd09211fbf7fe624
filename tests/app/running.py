"""What the tests of the executable share: a case to spoil, and runs on any number of ranks."""

import concurrent.futures
import dataclasses
import functools
import hashlib
import importlib
import os
import pathlib
import re
import shutil
import subprocess
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[2]
MECHANISM = "ethylene_bisetti2012_47.yaml"


def package(name: str):
    """A package of Python; without it the test is skipped (exit code 77)."""
    try:
        return importlib.import_module(name)
    except ImportError as error:
        print(f"SKIPPED: {error}; scripts/setup installs it")
        sys.exit(77)


@dataclasses.dataclass
class Result:
    code: int | None
    out: str
    err: str


def environment() -> dict:
    """Open MPI refuses to run as root unless told twice; each rank is one thread.

    Tests start the program some hundred times, on one machine: there is no need to look for a cluster's network, which
    takes 0.2 s of a start, nor to wait 2 s, after a rank ended with an exit code, for ranks that have ended already.
    """
    env = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
    env.update(OMPI_MCA_pml="ob1", OMPI_MCA_odls_base_sigkill_timeout="0")
    if shutil.which("mpirun") and not quietly("mpirun"):
        env.update(OMPI_MCA_btl="^tcp")  # Open MPI 5 says where it finds no network
    if os.geteuid() == 0:
        env.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    return env


@functools.lru_cache
def quietly(mpirun: str) -> tuple:
    """The option that keeps mpirun from remarks about a rank's exit code, which are no message of ours. Open MPI 5 has none."""
    version = subprocess.run([mpirun, "--version"], capture_output=True, text=True, check=False).stdout
    return ("-q",) if re.search(r"\((Open MPI|OpenRTE)\) [1-4]\.", version) else ()  # as mpirun and as mpiexec


def without_launcher(err: str) -> str:
    """Standard error without what the launcher of Open MPI 5 says of a rank's exit code, for which it knows no silence."""
    kept = re.sub(r"^-{60,}\n(?:(?!-{60,}).*\n)*?.*prterun(?:.*\n)*?-{60,}\n", "", err, flags=re.MULTILINE)
    return re.sub(r"^(\[[^\]]*\] PMIX ERROR: |\[warn\] Epoll ).*\n", "", kept, flags=re.MULTILINE)


class Program:
    """The executable on a number of ranks; `mpiexec` is ready for that number to follow ("mpirun -n")."""

    def __init__(self, executable: str, mpiexec: list, ranks: int):
        # One rank does without mpirun.
        launcher = [mpiexec[0], *quietly(mpiexec[0]), *mpiexec[1:], str(ranks), "--oversubscribe"] if ranks > 1 else []
        self.command = [*launcher, executable]
        self.ranks = ranks

    def __call__(self, *arguments, timeout: float = 60) -> Result:
        """Runs it. A run that hangs ends after `timeout` seconds, without an exit code."""
        try:
            done = subprocess.run([*self.command, *map(str, arguments)], env=environment(), stdin=subprocess.DEVNULL,
                                  capture_output=True, text=True, errors="replace", timeout=timeout, check=False)
        except subprocess.TimeoutExpired:
            return Result(None, "", f"still running after {timeout} s")
        return Result(done.returncode, done.stdout, without_launcher(done.stderr))


def differs_from_check(program: Program, result: Result, deck, *arguments) -> list:
    """Problems where `check` does not refuse a deck as a run did: the same exit code and message, nothing else."""
    checked = program("check", deck, *arguments)

    def steady(text: str) -> str:
        """Without the memory that a machine has at the moment."""
        return re.sub(r"of memory; there are \S+ \S+", "of memory", text)

    same = (checked.code, checked.out, steady(checked.err)) == (result.code, "", steady(result.err))
    return [] if same else [f"check says otherwise, with exit code {checked.code}: {checked.out}{checked.err}"]


def thinned(mistakes: list) -> list:
    """Each mistake, and whether `check` is asked too: of every third. It refuses by the very call that a run does, and each of
    the some hundred starts is a quarter of a second of a processor."""
    return [(mistake, i % 3 == 0) for i, mistake in enumerate(mistakes)]


def at_once(work, tasks) -> list:
    """The results of work on each task, four at a time: starting a program is mostly waiting."""
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        return list(pool.map(work, tasks))


def settings(*pairs: str) -> list:
    """Arguments of the command line for "key=value" pairs."""
    return [word for pair in pairs for word in ("--set", pair)]


def small_case(folder: pathlib.Path) -> pathlib.Path:
    """Puts the tests' own case and its mechanism below a folder; returns the deck."""
    deck = folder / "flame/deck.yaml"
    mechanism = folder / "mechanisms" / MECHANISM
    for source, target in ((SOURCE / "tests/app/flame.yaml", deck), (SOURCE / "cases/mechanisms" / MECHANISM, mechanism)):
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, target)
    return deck


def snapshot(folder: pathlib.Path) -> dict:
    """Every file below a folder: contents and time of the last change. Empty where there is no folder."""
    return {
        str(path.relative_to(folder)): (path.stat().st_mtime_ns,
                                        hashlib.sha256(path.read_bytes()).hexdigest() if path.is_file() else "folder")
        for path in sorted(folder.rglob("*"))
    }
