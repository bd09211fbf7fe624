"""Runs a command with limits of wall time, memory and size of files, and says how it ended.

A run is a session of its own, so that whatever it starts can be found and ended with it. Its output goes to files: a
command that writes without end fills no pipe, and how long it has been silent is seen from their times.
"""

import ctypes
import dataclasses
import os
import pathlib
import resource
import signal
import subprocess
import sys
import time

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "app"))

import running  # noqa: E402

GIGABYTE = 1 << 30
LIBC = ctypes.CDLL(None)
PR_SET_PDEATHSIG = 1
STOP_WITHIN = 10.0  # s, from SIGTERM to the end
SIGKILL_TIMEOUT = 5  # s, that mpirun gives its ranks between SIGTERM and SIGKILL


@dataclasses.dataclass
class Limits:
    """Time is that of the busiest process, so that a busy machine makes nothing hang. Over is the time of a run that still
    has something to say; one that is silent may have three times as long, one that only waits as long as `waiting`."""
    time: float = 60.0  # s
    silence: float = 20.0  # s
    waiting: float = 40.0  # s
    memory: int = 6 * GIGABYTE  # 0: as much as there is
    file: int = 2 * GIGABYTE


@dataclasses.dataclass
class Ended:
    code: int | None = None  # negative: by that signal, of which the shell makes 128 + number
    out: str = ""
    err: str = ""
    seconds: float = 0.0
    over_time: bool = False
    silent: float = 0.0  # s since the last output, where the time was over
    hung: bool = False  # and that was too long ago
    stopped_in: float | None = None  # s, from SIGTERM to the end, where one was sent
    left: list = dataclasses.field(default_factory=list)  # processes that outlived it

    @property
    def signal(self) -> int:
        """The signal that ended it, or 0; mpirun and shells report one as 128 + its number."""
        if self.code is None:
            return 0
        return -self.code if self.code < 0 else self.code - 128 if self.code > 128 else 0


def processes_of(session: int) -> dict:
    """The processes of a session that are still there, dead ones that nobody has asked for aside: processor time in s."""
    found = {}
    for entry in pathlib.Path("/proc").iterdir():
        if not entry.name.isdigit():
            continue
        try:
            fields = (entry / "stat").read_text().rpartition(")")[2].split()
        except OSError:
            continue
        if int(fields[3]) == session and fields[0] not in "ZX":
            found[int(entry.name)] = (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
    return found


def send(number: int, processes: list) -> None:
    for process in processes:
        try:
            os.kill(process, number)
        except ProcessLookupError:
            pass


def environment(patient: bool = False) -> dict:
    """For many starts on one machine. `patient`: mpirun gives its ranks some seconds to end on a signal, where its default
    leaves them a quarter of one (measured with Open MPI 4.1)."""
    env = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
    env.update(OMPI_MCA_pml="ob1", OMPI_MCA_rmaps_base_oversubscribe="1")
    env.update(OMPI_MCA_odls_base_sigkill_timeout=str(SIGKILL_TIMEOUT if patient else 0))
    env.update(PYTHONDONTWRITEBYTECODE="1", MPLBACKEND="Agg")
    if os.geteuid() == 0:
        env.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    return env


class Run:
    """A command that goes on; `wait` gives how it ended."""

    def __init__(self, command: list, folder: pathlib.Path, limits: Limits, name: str = "run",
                 patient: bool = False):
        def restrict() -> None:
            # No run outlives the attack.
            LIBC.prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
            if limits.memory:
                resource.setrlimit(resource.RLIMIT_AS, (limits.memory, limits.memory))
            resource.setrlimit(resource.RLIMIT_FSIZE, (limits.file, limits.file))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

        folder.mkdir(parents=True, exist_ok=True)
        self.limits = limits
        self.outputs = [folder / f"{name}.out", folder / f"{name}.err"]
        self.begin = time.monotonic()
        with open(self.outputs[0], "wb") as out, open(self.outputs[1], "wb") as err:
            self.process = subprocess.Popen([str(word) for word in command], cwd=folder, env=environment(patient), stdout=out,
                                            stderr=err, stdin=subprocess.DEVNULL, start_new_session=True,
                                            preexec_fn=restrict)

    def wait(self) -> Ended:
        """Waits until the end or the limit; then SIGTERM, then SIGKILL to all that is left of the session."""
        ended = Ended()
        spoke, size, pause, worked = 0.0, 0, 0.01, (0.0, self.begin)
        while self.process.poll() is None:
            time.sleep(pause)
            pause = min(2 * pause, 0.25)
            used = max([0.0, *processes_of(self.process.pid).values()])
            if used > worked[0]:
                worked = (used, time.monotonic())
            if size != (size := sum(path.stat().st_size for path in self.outputs)):
                spoke = used
            waits = time.monotonic() - worked[1] > self.limits.waiting
            ended.silent = time.monotonic() - worked[1] if waits else used - spoke
            ended.hung = waits or ended.silent > self.limits.silence
            if waits or used > self.limits.time * (3 if ended.hung else 1):
                ended.over_time = True
                ended.stopped_in = self.stop(signal.SIGTERM)
                break
        return self.finish(ended)

    def stop(self, number: int) -> float | None:
        """Sends a signal as a user does, to the process that was started; seconds to its end, None if it does not end."""
        self.process.send_signal(number)
        return self.ends_within()

    def ends_within(self, seconds: float = STOP_WITHIN) -> float | None:
        sent = time.monotonic()
        try:
            self.process.wait(seconds)
            return time.monotonic() - sent
        except subprocess.TimeoutExpired:
            return None

    def finish(self, ended: Ended | None = None) -> Ended:
        """How it ended, with all that is left of it gone."""
        ended = ended or Ended()
        ended.seconds = time.monotonic() - self.begin
        # Ranks need a moment to see that their launcher is gone.
        patience = time.monotonic() + 3.0
        while processes_of(self.process.pid) and time.monotonic() < patience and self.process.poll() is not None:
            time.sleep(0.05)
        ended.left = list(processes_of(self.process.pid))
        send(signal.SIGKILL, ended.left)
        ended.code = self.process.wait()
        ended.out, ended.err = (self.text(path) for path in self.outputs)
        return ended

    @staticmethod
    def text(path: pathlib.Path) -> str:
        """The output, or its two ends where it is long."""
        data = path.read_bytes()
        if len(data) > 200_000:
            data = data[:100_000] + b"\n[...]\n" + data[-100_000:]
        return data.decode("utf-8", "replace")


def run(command: list, folder: pathlib.Path, limits: Limits, name: str = "run") -> Ended:
    return Run(command, folder, limits, name).wait()


class Program:
    """The executable on one rank or more."""

    def __init__(self, executable: pathlib.Path, mpirun: str = "mpirun"):
        self.executable = executable
        self.mpirun = mpirun

    def command(self, ranks: int, *arguments) -> list:
        launcher = [self.mpirun, *running.quietly(self.mpirun), "-n", str(ranks), "--oversubscribe"] if ranks > 1 else []
        return [*launcher, str(self.executable), *map(str, arguments)]
