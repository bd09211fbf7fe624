"""How runs end when something outside ends them: a full disk, a signal, another run in the same folder.

Usage: run_end_test.py EXECUTABLE RANKS MPIEXEC... [--all]. With --all twenty sizes of disk for every problem, on real small
disks (tmpfs) too where the user may mount them, and both signals; otherwise one of each. Exit code 77 (skipped) where a
Python package is missing.
"""

import json
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import running
import small_decks

h5py = running.package("h5py")

METHODS = "sections: {type: sectional, sections: 20, smallest: 1 m^3, spacing: 2}, dsmc: {type: dsmc, particles: 50}"
# The first repeats take milliseconds, each of the others a minute.
LONG_REPEAT = """problem: population_balance
initial: {distribution: monodisperse, number: 1e6 1/cm^3, volume: 1 m^3}
processes: {coagulation: {kernel: constant, rate: 1e-6 cm^3/s}, breakage: {rate: 20 1/s}}
methods: {short: {type: dsmc, particles: 10}, long: {type: dsmc, particles: 5000, rates: exact}}
time: {end: 10 s, outputs: 200}
repeats: 4
"""
PREFIX = "lampblack: disk full: "


def environment():
    """Open MPI keeps what ranks share in memory in files of some MB: not here, where the size of files is limited."""
    return dict(running.environment(), PMIX_MCA_gds="hash", OMPI_MCA_btl="self,tcp", OMPI_MCA_btl_tcp_if_include="lo")


class Cases:
    """Decks of every problem: arguments that end soon, and what to add so that the run goes on until it is stopped."""

    def __init__(self, folder):
        self.folder = folder
        flow = running.small_case(folder)
        reactor = running.SOURCE / "cases/reactor/ignition_hydrogen/deck.yaml"
        population = self.put("population.yaml", small_decks.population(METHODS, repeats=4, outputs=200, bins=200,
                                                                        times=[2, 4, 6, 8, 10]))
        flame = self.put("flame.yaml", small_decks.free_flame("hydrogen_h2o2_10.yaml", "H2", slope=0.4, curve=0.6))
        large = self.put("large.yaml", small_decks.free_flame(running.MECHANISM, "C2H4", slope=0.0005, curve=0.001))
        sweep = self.put("sweep.yaml", f"study: populations\ndeck: {population}\nvary:\n  - {{key: seed, values: [1, 2, 3]}}\n")
        many = self.put("many.yaml", f"study: populations\ndeck: {population}\nvary:\n"
                                     f"  - {{key: seed, values: {list(range(1, 100))}}}\n")
        long_repeat = self.put("long_repeat.yaml", LONG_REPEAT)
        soon = running.settings("time.end=6 us", "output.interval=1 us")
        self.short = {"flow": ["run", flow, *soon], "reactor": ["run", reactor, *running.settings("time.end=0.4 ms")],
                      "population": ["run", population], "flame": ["run", flame], "sweep": ["sweep", sweep]}
        self.long = {"flow": ["run", flow, *running.settings("time.end=1 s", "output.interval=0.5 s")],
                     "reactor": ["run", reactor, *running.settings("output.interval=1 ns")],
                     "population": ["run", population, *running.settings("repeats=1000000")],
                     "long repeat": ["run", long_repeat],
                     "flame": ["run", large, *running.settings("grid.maximum_points=50000")], "sweep": ["sweep", many]}

    def put(self, name, text):
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        return path


def read_all(path):
    """Every number of a results file: h5py raises where one cannot be read."""
    with h5py.File(path, "r") as file:
        found = []
        file.visititems(lambda name, item: found.append((name, item[()])) if isinstance(item, h5py.Dataset) else None)
    return dict(found)


def leftovers(folder):
    """Files that no run should leave."""
    return [path.name for path in folder.rglob("*")
            if path.name.startswith(".") or path.suffix in (".tmp", ".lock", ".data") or path.name.endswith(".h5.part") and
            (path.parent / "results.h5").exists()]


def disk_full(program, arguments, out, preparation):
    """One run on too small a disk; what is wrong about its end, or nothing, and its exit code."""
    try:
        done = subprocess.run([*program.command, *map(str, arguments), "--out", str(out)], env=environment(),
                              stdin=subprocess.DEVNULL, capture_output=True, text=True, preexec_fn=preparation, timeout=100,
                              check=False)
    except subprocess.TimeoutExpired:
        return "hangs", None
    told = running.without_launcher(done.stderr)
    lines = told.splitlines()
    if done.returncode == 0:
        return ("says something and ends well: " + told if lines else ""), 0
    if done.returncode != 3 or len(lines) != 1 or not lines[0].startswith(PREFIX):
        return f"ends with {done.returncode}: {told}", done.returncode
    for file in [*out.rglob("results.h5"), *out.rglob("results.h5.part")]:
        try:
            read_all(file)
        except (OSError, RuntimeError) as error:
            return f"leaves {file}, which cannot be read: {error}", 3
    for file in out.rglob("history.csv"):
        head, *rows = file.read_text(encoding="utf-8").splitlines() or [""]
        if any(row.count(",") != head.count(",") for row in rows):
            return "leaves half a row of history.csv", 3
    for record in out.rglob("run.json"):
        status = json.loads(record.read_text(encoding="utf-8"))["status"]
        if status == "running":
            return "leaves run.json as of a run that goes on", 3
    return (f"leaves {leftovers(out)}" if leftovers(out) else ""), 3


def check_full_disks(program, cases, folder, sizes):
    """A limit on the size of files, which needs no rights: what the system says is EFBIG, and treated as ENOSPC is."""
    ended = {}
    for k, (problem, arguments) in enumerate(cases.short.items()):
        for size in sizes if len(sizes) > 2 else [sizes[k % 2]]:
            out = folder / f"full_{problem}_{size}"
            limit = lambda size=size: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))  # noqa: E731
            wrong, code = disk_full(program, arguments, out, limit)
            assert not wrong, f"{problem} with files of {size} bytes at most {wrong}"
            ended.setdefault(code, []).append((problem, size))
            shutil.rmtree(out, ignore_errors=True)
    assert 3 in ended, "no disk was too small"
    return {code: len(runs) for code, runs in ended.items()}


def check_small_disks(program, cases, folder, sizes):
    """The same on real disks, each in a name space of its own."""
    mount = ["unshare", "-m", "sh", "-c", 'mount -t tmpfs -o size=$0 none "$1" && shift && "$@"; code=$?; '
             'cp -r "$OUT" "$KEPT"; exit $code']
    disk = folder / "disk"
    disk.mkdir()
    if subprocess.run([*mount[:3], "-c", f"mount -t tmpfs none {disk}"], capture_output=True, check=False).returncode:
        return "skipped: mounting is not allowed here"
    ended = {}
    for problem, arguments in cases.short.items():
        for size in sizes:
            kept = folder / f"disk_{problem}_{size}"
            small = running.Process("", [], 1)
            small.command = ["env", f"OUT={disk}/out", f"KEPT={kept}", *mount, f"{size}", str(disk), *program.command]
            wrong, code = disk_full_on(small, arguments, disk / "out", kept)
            assert not wrong, f"{problem} on a disk of {size} bytes {wrong}"
            ended[code] = ended.get(code, 0) + 1
            shutil.rmtree(kept, ignore_errors=True)
    assert 3 in ended, "no disk was too small"
    return ended


def disk_full_on(program, arguments, out, kept):
    """As disk_full(), where the results are copied to `kept` before the disk goes."""
    kept.mkdir(exist_ok=True)
    wrong, code = disk_full(program, arguments, out, None)
    if wrong or code == 0:
        return wrong, code
    for file in [*kept.rglob("results.h5"), *kept.rglob("results.h5.part")]:
        try:
            read_all(file)
        except (OSError, RuntimeError) as error:
            return f"leaves {file}, which cannot be read: {error}", 3
    for record in kept.rglob("run.json"):
        if json.loads(record.read_text(encoding="utf-8"))["status"] == "running":
            return "leaves run.json as of a run that goes on", 3
    return "", 3


def wait_for(ready, process, what):
    for _ in range(1200):
        assert process.poll() is None, f"the run ended before {what}: {process.communicate()}"
        if ready():
            return
        time.sleep(0.05)
    process.kill()
    raise AssertionError(f"no {what} in a minute")


def start(program, arguments, out):
    return subprocess.Popen([*program.command, *map(str, arguments), "--out", str(out)], env=running.environment(),
                            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def ranks_of(program, process):
    """The processes of the program itself."""
    if program.ranks == 1:
        return [process.pid]
    children = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text(encoding="utf-8").split()
    return [int(child) for child in children]


def is_going(problem, out):
    """Whether the run has something to keep, or at least computes."""
    if problem in ("flow", "reactor"):
        history = out / "history.csv"
        return history.is_file() and history.read_bytes().count(b"\n") > 3
    if problem == "sweep":
        return sum('"status": "done"' in path.read_text(encoding="utf-8") for path in out.glob("*/run.json")) > 1
    return (out / "run.json").is_file()


def check_signal(program, arguments, problem, out, number):
    process = start(program, arguments, out)
    wait_for(lambda: is_going(problem, out), process, "start of the run")
    if problem in ("population", "long repeat", "flame"):
        time.sleep(0.5)
    # One rank is enough where ranks work together; a reactor is computed by the first alone, and each rank has repeats of
    # its own. mpirun tells all.
    ranks = ranks_of(program, process)
    for rank in ranks if problem in ("reactor", "long repeat") else ranks[-1:]:
        os.kill(rank, number)
    said, told = process.communicate(timeout=100)
    assert process.returncode == 128 + number, f"{problem} ends with {process.returncode}: {told}{said[-2000:]}"
    lines = running.without_launcher(told).splitlines()
    name = signal.Signals(number).name
    assert len(lines) == 1 and lines[0].startswith(f"lampblack: stopped by {name}"), f"{problem}: {told}"
    assert not leftovers(out), f"{problem} leaves {leftovers(out)}"
    if problem == "sweep":
        statuses = [json.loads(path.read_text(encoding="utf-8"))["status"] for path in out.glob("*/run.json")]
        assert statuses.count("done") > 1 and "running" not in statuses, statuses
        assert (out / "study.csv").read_text(encoding="utf-8").count(",done,") >= 2
        return
    record = json.loads((out / "run.json").read_text(encoding="utf-8"))
    assert record["status"] == "stopped" and record["message"] in told, record["message"]
    assert sum(stage["maximum_s"] for stage in record["stages"]) > 0, f"{problem}: {record['stages']}"
    kept = read_all(out / "results.h5.part")
    if problem == "flow":
        assert sum(name.endswith("/temperature") for name in kept) == 2, "first and last state"
        assert kept["history/time"][-1] == record["simulated_time_s"] or record["simulated_time_s"] == 0
    elif problem == "reactor":
        rows = (out / "history.csv").read_text(encoding="utf-8").count("\n") - 1
        assert len(kept["history/time"]) == rows > 2
        assert abs(kept["history/time"][-1] - record["simulated_time_s"]) < 2e-6
    elif problem in ("population", "long repeat"):
        # What is kept is whole: all 201 rows of each method, of repeats that came to their end.
        rows = {name: len(values) for name, values in kept.items() if name.endswith("/history/M0")}
        methods = {"dsmc": 201, "sections": 201} if problem == "population" else {"short": 201, "long": 0}
        assert rows == {"exact/history/M0": 201, **{f"methods/{name}/history/M0": n for name, n in methods.items()}}, rows
        if problem == "population":
            assert 1 < len(kept["methods/dsmc/repeats/M0"]) < 1000000 and (kept["methods/dsmc/repeats/M0"] > 0).all()
    else:
        assert len(kept["flame/z"]) > 5 and "flame/restart/unknowns" in kept
        assert len(kept["stages/points"]) > 0 and kept["stages/residuals"][-1] > 0, "the stage that was stopped is told"


def check_memory(program, arguments, out):
    """A flame whose grid grows beyond what the machine has."""
    enough_to_begin = 600 << 20
    done = subprocess.run([*program.command, *map(str, arguments), "--out", str(out)], env=running.environment(),
                          stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=100, check=False,
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (enough_to_begin, enough_to_begin)))
    assert done.returncode == 3 and done.stderr.startswith("lampblack: out of memory: "), done
    assert len(done.stderr.splitlines()) == 1, done.stderr
    record = json.loads((out / "run.json").read_text(encoding="utf-8"))
    assert record["status"] == "failed" and f"lampblack: {record['message']}\n" == done.stderr, record["message"]
    assert not leftovers(out), leftovers(out)


def check_second_signal(program, arguments, out):
    """Who asks twice does not want to wait."""
    process = start(program, arguments, out)
    wait_for(lambda: is_going("flow", out), process, "start of the run")
    os.kill(process.pid, signal.SIGSTOP)
    os.kill(process.pid, signal.SIGTERM)
    os.kill(process.pid, signal.SIGINT)
    os.kill(process.pid, signal.SIGCONT)
    process.communicate(timeout=60)
    assert process.returncode in (-signal.SIGTERM, -signal.SIGINT), process.returncode


def check_lock(program, arguments, out):
    """A run that is going on keeps its folder, also from --force; one that was killed does not."""
    first = start(program, arguments, out)
    wait_for(lambda: is_going("flow", out), first, "start of the run")
    before = (out / "run.json").read_bytes()
    for more in ([], ["--force"]):
        second = program(*arguments, "--out", out, *more)
        assert second.code == 2 and len(second.err.splitlines()) == 1, second
        assert f"process {ranks_of(program, first)[0]} on " in second.err and ", since 20" in second.err, second.err
    assert (out / "run.json").read_bytes() == before, "the loser wrote into the winner's folder"
    for rank in ranks_of(program, first):
        os.kill(rank, signal.SIGKILL)
    first.communicate(timeout=60)
    assert not leftovers(out), leftovers(out)
    again = program(*arguments, "--out", out)
    assert again.code == 2 and "cut off" in again.err, again.err


def main():
    arguments = [a for a in sys.argv[1:] if a != "--all"]
    everything = "--all" in sys.argv
    program = running.Program(arguments[0], arguments[2:], int(arguments[1]))
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        cases = Cases(folder)
        # Below 100 kB nothing can begin; the largest file is some 600 kB.
        sizes = [int(8000 * 1.3**k) for k in range(20)] if everything else [150_000, 300_000]
        print("files of limited size, by exit code:", check_full_disks(program, cases, folder, sizes))
        if everything:
            disks = [100_000 + 60_000 * k for k in range(20)]
            print("small disks, by exit code:", check_small_disks(program, cases, folder, disks))
        for k, (problem, long) in enumerate(cases.long.items()):
            for number in (signal.SIGTERM, signal.SIGINT) if everything else [(signal.SIGTERM, signal.SIGINT)[k % 2]]:
                check_signal(program, long, problem, folder / f"{problem}_{number}", number)
        if program.ranks == 1:
            check_second_signal(program, cases.long["flow"], folder / "twice")
            if "ASAN_OPTIONS" not in os.environ:  # the sanitizer wants terabytes of addresses
                check_memory(program, cases.long["flame"], folder / "memory")
        check_lock(program, cases.long["flow"], folder / "locked")
    print("ends of runs: all in order")


if __name__ == "__main__":
    main()
