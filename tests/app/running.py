"""What the tests of the executable share: a case to spoil, and runs on any number of ranks."""

import atexit
import concurrent.futures
import contextlib
import dataclasses
import functools
import hashlib
import importlib
import importlib.util
import os
import pathlib
import re
import resource
import runpy
import select
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import traceback

SOURCE = pathlib.Path(__file__).resolve().parents[2]
MECHANISM = "ethylene_bisetti2012_47.yaml"


def package(name: str):
    """A package of Python; without it the test is skipped (exit code 77)."""
    try:
        return importlib.import_module(name)
    except ImportError as error:
        print(f"SKIPPED: {error}; scripts/setup installs it")
        sys.exit(77)


def needs(*names: str) -> None:
    """Skips the test where a package is not installed, which scripts that the test starts import."""
    for name in names:
        if importlib.util.find_spec(name) is None:
            print(f"SKIPPED: there is no package {name} of Python; scripts/setup installs it")
            sys.exit(77)


@dataclasses.dataclass
class Result:
    code: int | None
    out: str
    err: str


def environment() -> dict:
    """Open MPI refuses to run as root unless told twice; each rank is one thread.

    Tests start the program often, on one machine: there is no need to look for a cluster's network, which takes 0.2 s of a
    start, nor to wait 2 s, after a rank ended with an exit code, for ranks that have ended already. Ranks that wait leave their
    processor to others, and none is bound to a core: more than one test may run.
    """
    env = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
    env.update(OMPI_MCA_pml="ob1", OMPI_MCA_odls_base_sigkill_timeout="0", OMPI_MCA_mpi_yield_when_idle="1",
               OMPI_MCA_hwloc_base_binding_policy="none")
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


@functools.lru_cache
def load_plots() -> None:
    sys.path.insert(0, str(SOURCE / "python"))
    importlib.import_module("h5py")
    style = importlib.import_module("lampblack.plots.style")
    style.plt.rcParams.update({"figure.constrained_layout.use": False, "savefig.dpi": 40})
    importlib.import_module("matplotlib.axis").Axis._update_ticks = lambda axis: []
    save = style.Pictures.save

    def save_what_shows_something(pictures, figure, name):
        assert any(axes.has_data() for axes in figure.axes), f"the picture {name} is empty"
        save(pictures, figure, name)

    style.Pictures.save = save_what_shows_something


def script(path, *arguments, seconds: int = 60) -> Result:
    """Runs a script of python, which may take so many seconds of the processor, in a copy of this process: the packages that most
    scripts import are loaded once. Pictures are smaller, without ticks and the search for a layout, which are most of the time."""
    load_plots()
    with tempfile.TemporaryFile("w+", errors="replace") as out, tempfile.TemporaryFile("w+", errors="replace") as err:
        sys.stdout.flush()
        child = os.fork()
        if child == 0:
            os.dup2(out.fileno(), 1)
            os.dup2(err.fileno(), 2)
            resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))
            code = 99
            try:
                sys.argv = [str(path), *map(str, arguments)]
                runpy.run_path(sys.argv[0], run_name="__main__")
                code = 0
            except SystemExit as end:
                code = end.code if isinstance(end.code, int) else 0 if end.code is None else 1
                if isinstance(end.code, str):
                    print(end.code, file=sys.stderr)
            except BaseException:  # noqa: BLE001
                traceback.print_exc()
            sys.stdout.flush()
            sys.stderr.flush()
            os._exit(code)
        code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        return Result(code, *(file.seek(0) or file.read() for file in (out, err)))


class Process:
    """The executable on a number of ranks, a process of its own for each call; `mpiexec` is ready for that number to follow
    ("mpirun -n"). For what Program cannot have: signals, limits, an environment, `--ranks`, `plot`, `time.wall_limit` (which
    counts from the start of the process), and whether a process as users start it ends as it should."""

    def __init__(self, executable: str, mpiexec: list, ranks: int):
        # One rank does without mpirun.
        self.launcher = [mpiexec[0], *quietly(mpiexec[0]), *mpiexec[1:], str(ranks), "--oversubscribe"] if ranks > 1 else []
        self.command = [*self.launcher, executable]
        self.ranks = ranks

    def __call__(self, *arguments, timeout: float = 240) -> Result:
        """Runs it. A run that hangs ends after `timeout` seconds, without an exit code."""
        try:
            done = subprocess.run([*self.command, *map(str, arguments)], env=environment(), stdin=subprocess.DEVNULL,
                                  capture_output=True, text=True, errors="replace", timeout=timeout, check=False)
        except subprocess.TimeoutExpired:
            return Result(None, "", f"still running after {timeout} s")
        return Result(done.returncode, done.stdout, without_launcher(done.stderr))


class Program(Process):
    """The same command line and the same answers, one call after the other in one process (program_server.cpp beside the
    executable), which starts with the first call. Calls of several threads wait for each other. A call that ends the server
    has the exit code of its end, and the next call another server; so has a call after one that left something in the process."""

    def __init__(self, executable: str, mpiexec: list, ranks: int):
        super().__init__(executable, mpiexec, ranks)
        server = pathlib.Path(executable).with_name("program_server")
        self.process_of_its_own = Process(executable, mpiexec, ranks)
        self._server = Server([*self.launcher, str(server)]) if server.exists() else None

    def __call__(self, *arguments, timeout: float = 240) -> Result:
        if self._server is None:
            return super().__call__(*arguments, timeout=timeout)
        return self._server.request(list(map(str, arguments)), timeout)


class Server:
    """A process of program_server.cpp, started again where one has ended."""

    def __init__(self, command: list):
        self.command = command
        self.lock = threading.Lock()
        self.process = self.folder = None
        atexit.register(self.close)

    def request(self, arguments: list, timeout: float) -> Result:
        with self.lock:
            if self.process is not None and self.process.poll() is not None:  # between two requests
                raise RuntimeError(f"the server ended by itself with exit code {self.process.returncode}: {self._read('server')}")
            if self.process is None:
                self._start()
            for name in ("out", "err"):
                (self.folder / name).write_bytes(b"")
            words = [os.getcwd(), str(self.folder / "out"), str(self.folder / "err"), *arguments]
            text = b"".join(os.fsencode(word) + b"\0" for word in words)
            self.process.stdin.write(b"%d\n" % len(text) + text)
            self.process.stdin.flush()
            if not select.select([self.process.stdout], [], [], timeout)[0]:
                self._kill()
                return Result(None, "", f"still running after {timeout} s")
            answer = self.process.stdout.readline().split()
            if len(answer) == 2:
                code, is_changed = map(int, answer)
                result = Result(code, self._read("out"), self._read("err"))
                if is_changed:
                    self._stop()
                return result
            code = self.process.wait(timeout)
            self.process = None
            return Result(code, self._read("out"), without_launcher(self._read("err") + self._read("server")))

    def _read(self, name: str) -> str:
        return (self.folder / name).read_text(encoding="utf-8", errors="replace")

    def _start(self) -> None:
        self.folder = self.folder or pathlib.Path(tempfile.mkdtemp())
        with open(self.folder / "server", "wb") as errors:
            self.process = subprocess.Popen(self.command, env=environment(), stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=errors)

    def _kill(self) -> None:
        process, self.process = self.process, None
        children = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text(encoding="utf-8").split()
        for pid in [*map(int, children), process.pid]:
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        process.wait()

    def _stop(self) -> None:
        """Its end is that of a process of the program: a crash there fails the test."""
        if self.process is None:
            return
        self.process.stdin.close()
        try:
            code = self.process.wait(30)
        except subprocess.TimeoutExpired:
            self._kill()
            code = None
        self.process = None
        if code != 0:
            print(f"FAILED  the program {'hangs' if code is None else f'ends with exit code {code}'} when all is done: {self._read('server')}", flush=True)
            os._exit(1)

    def close(self) -> None:
        with self.lock:
            self._stop()
            if self.folder is not None:
                shutil.rmtree(self.folder, ignore_errors=True)
                self.folder = None


def datasets(path) -> dict:
    """All of a file of results, by name."""
    h5py = package("h5py")
    found = {}
    with h5py.File(path, "r") as file:
        file.visititems(lambda name, item: found.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
    return found


def run_deck(program, deck, out, *more, code=0):
    result = program("run", deck, "--out", out, *more)
    assert result.code == code, f"{program.ranks} ranks: {result}"
    return result


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


def refused(error: type, words: str, work, *arguments) -> None:
    """The call raises that error, and its text has the words."""
    try:
        work(*arguments)
    except error as told:
        assert words in str(told), f"'{words}' is not in: {told}"
        return
    raise AssertionError(f"not refused: {words}")
