"""`lampblack sweep`: runs of any problem, failures that do not stop the others, the same table on any number of ranks.

Usage: sweep_command_test.py EXECUTABLE RANKS MPIEXEC...
"""

import csv
import json
import pathlib
import subprocess
import sys
import tempfile

import running

h5py = running.package("h5py")

REACTOR = running.SOURCE / "cases/reactor/ignition_hydrogen/deck.yaml"
POPULATION = running.SOURCE / "cases/population_balance/chapter5_03_coagulation_exponential.yaml"
STUDY = f"""study: delays
deck: {REACTOR}
set: [time.end=0.4 ms, 'sensitivity.reactions=[1]']
vary:
  - {{key: initial.temperature, values: [1100 K, 1200 K]}}
"""


def rows(path: pathlib.Path) -> list:
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def study(folder: pathlib.Path, text: str) -> pathlib.Path:
    path = folder / "study.yaml"
    path.write_text(text, encoding="utf-8")
    return path


def check_good(program: running.Program, folder: pathlib.Path) -> None:
    """Every combination runs in its folder; study.csv has its results; a second sweep does not overwrite it."""
    deck = study(folder, STUDY)
    out = folder / "good"
    result = program("sweep", deck, "--out", out)
    assert result.code == 0 and not result.err, f"exit code {result.code}\n{result.err}"
    table = rows(out / "study.csv")
    assert [row["initial.temperature"] for row in table] == ["1100 K", "1200 K"], table
    delays = [float(row["ignition_delays_s.max_dTdt"]) for row in table]
    assert delays[0] > delays[1] > 0, f"hotter gas ignites later: {delays}"
    for row, delay in zip(table, delays):
        record = json.loads((out / row["run"] / "run.json").read_text(encoding="utf-8"))
        assert record["status"] == "done" and record["results"]["ignition_delays_s"]["max_dTdt"] == delay, record
    before = running.snapshot(out)
    again = program("sweep", deck, "--out", out)
    assert again.code == 2 and "--force" in again.err, again.err
    assert running.snapshot(out) == before, "a refused sweep left a trace"
    forced = program("sweep", deck, "--out", out, "--force", "--set", "initial.temperature=1300 K")
    assert forced.code == 0, forced.err
    assert all(float(row["ignition_delays_s.max_dTdt"]) < delays[1] for row in rows(out / "study.csv"))


def check_side_by_side(program: running.Program, folder: pathlib.Path) -> None:
    """Runs on one rank each, with how long the study will take."""
    deck, out = study(folder, STUDY.replace("1200 K]", "1200 K, 1300 K]")), folder / "side_by_side"
    result = program("sweep", deck, "--out", out, "--side-by-side", *(["--ranks", program.ranks] if program.ranks > 1 else []))
    assert result.code == 0 and "of 3 runs behind, to go " in result.out, f"exit code {result.code}\n{result.err}{result.out}"
    assert [json.loads((out / row["run"] / "run.json").read_text(encoding="utf-8"))["ranks"] for row in rows(out / "study.csv")] == [1, 1, 1]


def check_jobs(program: running.Program, folder: pathlib.Path) -> None:
    """The script of an array of jobs runs as it is, a row a job; their table is that of a study in one go, and says what is missing."""
    text = STUDY.replace("temperature, values: [1100 K, 1200 K]", "composition, values: ['H2: 2, O2: 1, N2: 4', 'H2: 1, O2: 1, N2: 4', 'NONE: 1']")
    deck, out = study(folder, text), folder / "jobs"
    result = program("sweep", deck, "--out", out, "--jobs", "8", "--check")
    assert result.code == 2 and "one of them at a time" in result.err, result.err
    result = program("sweep", deck, "--out", out, "--jobs", "8", *(["--ranks", program.ranks] if program.ranks > 1 else []))
    script = out / "jobs.slurm"
    assert result.code == 0 and f"sbatch {script}" in result.out and not list(out.glob("*/run.json")), f"{result.code}\n{result.err}{result.out}"
    text = script.read_text(encoding="utf-8")
    assert "#SBATCH --array=1-3\n" in text and f"#SBATCH --ntasks={program.ranks}\n" in text, text

    def job(place) -> int:
        return subprocess.run(["bash", script], env={**running.environment(), "SLURM_ARRAY_TASK_ID": str(place)}, capture_output=True, check=False).returncode

    def collected() -> tuple:
        done = program("sweep", deck, "--out", out, "--collect")
        return done, [(row["status"], row["message"], row["ignition_delays_s.max_dTdt"]) for row in rows(out / "study.csv")]

    assert job(2) == 0 and not (out / "study.csv").exists()
    result, table = collected()
    assert result.code == 3 and "2 of 3 runs are not finished or failed" in result.err, f"{result.code}\n{result.err}"
    assert [row[0] for row in table] == ["stopped", "done", "wrong input"] and table[0][1] == "not begun" and "NONE" in table[2][1], table
    assert (job(1), job(3)) == (0, 2)
    before = running.snapshot(out)
    result, table = collected()
    assert result.code == 2 and "1 of 3 runs failed" in result.err and [row[0] for row in table] == ["done", "done", "wrong input"], table
    assert all(running.snapshot(out)[path] == content for path, content in before.items() if "run.json" in str(path)), "something was run"
    whole = folder / "in_one_go"
    assert program("sweep", deck, "--out", whole).code == 2
    assert [row[0::2] for row in table] == [(row["status"], row["ignition_delays_s.max_dTdt"]) for row in rows(whole / "study.csv")]


def check_unfinished(program: running.Program, folder: pathlib.Path) -> None:
    """A study that was stopped or killed goes on: finished runs are taken as they are, others run; of another deck they are refused."""
    deck, out = study(folder, STUDY), folder / "unfinished"
    assert program("sweep", deck, "--out", out).code == 0
    table, record = rows(out / "study.csv"), out / "study.json"
    one, two = (out / row["run"] for row in table)

    def stop(run):
        text = (run / "run.json").read_text(encoding="utf-8")
        (run / "run.json").write_text(text.replace('"status": "done"', '"status": "stopped"'), encoding="utf-8")
        (run / "results.h5").rename(run / "results.h5.part")

    def again(*more) -> tuple:
        before = running.snapshot(one)
        result = program("sweep", deck, "--out", out, *more)
        return result, running.snapshot(one) == before

    stop(two)
    record.write_text(record.read_text(encoding="utf-8").replace('"status": "done"', '"status": "stopped"'), encoding="utf-8")
    result, is_kept = again()
    assert result.code == 0 and is_kept and f"{one.name} is there already" in result.out, f"{result.code}: {result.err}{result.out}"
    assert f"{two.name} is there already" not in result.out and (two / "results.h5").is_file()

    def same(row):
        return {key: value for key, value in row.items() if key != "wall_time_s"}

    assert [same(row) for row in rows(out / "study.csv")] == [same(row) for row in table]
    assert program("sweep", deck, "--out", out).code == 2, "a finished study was begun again"

    record.unlink()
    result, is_kept = again()
    assert result.code == 0 and is_kept, f"{result.code}: {result.err}"
    record.unlink()
    result, is_kept = again("--set", "time.end=0.5 ms")
    assert result.code == 2 and is_kept and "2 of 2 runs failed" in result.err, result.err
    assert "holds a finished run already" in rows(out / "study.csv")[0]["message"]
    result, is_kept = again("--force")
    assert result.code == 0 and not is_kept, result.err


def flow_deck(folder: pathlib.Path) -> pathlib.Path:
    deck = folder / "deck.yaml"
    gas = 'temperature: 300 K, composition: "GAS: 1"'
    deck.write_text(f"""problem: flow
mechanism: {running.SOURCE}/cases/mechanisms/perfect_gas_1.yaml
transport: {{model: unity_lewis}}
mesh: {{geometry: planar, x: [{{to: 4 mm, cells: 4}}], y: [{{to: 3 mm, cells: 3}}]}}
boundaries:
  in: {{type: inlet, side: x-min, velocity: 1 m/s, {gas}}}
  out: {{type: outlet, side: x-max, {gas}}}
  low: {{type: wall, side: y-min}}
  high: {{type: wall, side: y-max}}
initial: {{layer: none, {gas}}}
time: {{end: 0.2 ms, first_step: 50 us}}
checkpoint: {{at_end: true}}
""", encoding="utf-8")
    return deck


def check_chain(program: running.Program, folder: pathlib.Path) -> None:
    """A flow of a chain starts from the end of the one before it; the first, and one after a failure, from its own start."""
    text = f"study: chain\ndeck: {flow_deck(folder)}\nset: ['output.species=[all]']\nchain: 3\nvary: [{{key: boundaries.in.VALUES}}]\n"
    hot, out = study(folder, text.replace("VALUES", "temperature, values: [600 K, 301 K, 302 K]")), folder / "chain"
    result = program("sweep", hot, "--out", out)
    assert result.code == 0, result.err
    hottest = [[max(list(h5py.File(out / row["run"] / "results.h5")["steps"].values())[step]["temperature"][()]) for step in (0, -1)]
               for row in rows(out / "study.csv")]
    assert hottest[0][0] == 300 and hottest[0][1] > 310 and hottest[1][1] > 305, hottest
    for before, after in zip(hottest, hottest[1:]):
        assert abs(after[0] - before[1]) < 1e-9 * before[1], hottest

    failing = study(folder, text.replace("VALUES", "composition, values: ['GAS: 1', 'NONE: 1', 'GAS: 2']"))
    assert program("sweep", failing, "--out", folder / "broken").code == 2
    starts = [json.loads((folder / "broken" / row["run"] / "run.json").read_text(encoding="utf-8"))["deck"]["initial"]
              for row in rows(folder / "broken/study.csv") if row["status"] == "done"]
    assert len(starts) == 2 and all("flow" not in start for start in starts), starts

    result = program("sweep", study(folder, text.replace("=[all]", "=[]").replace("VALUES", "velocity, values: [1, 2]")), "--check")
    assert result.code == 2 and "need all species" in result.err, result.err
    result = program("sweep", study(folder, STUDY + "chain: 2\n"), "--check")
    assert result.code == 2 and "only runs of problems flame1d and flow" in result.err, result.err


def check_checkpoint(program: running.Program, folder: pathlib.Path) -> None:
    """A flow that was stopped goes on from its checkpoint."""
    deck = flow_deck(folder)
    text, out = study(folder, f"study: flows\ndeck: {deck}\n"), folder / "flows"
    assert program("sweep", text, "--out", out).code == 0
    run = out / rows(out / "study.csv")[0]["run"]
    record = (run / "run.json").read_text(encoding="utf-8")
    (run / "run.json").write_text(record.replace('"status": "done"', '"status": "running"'), encoding="utf-8")
    (out / "study.json").unlink()
    result = program("sweep", text, "--out", out)
    assert result.code == 0, result.err
    assert "checkpoint" in json.loads((run / "run.json").read_text(encoding="utf-8"))["restarted_from"]


def check_failures(program: running.Program, folder: pathlib.Path) -> None:
    """A run that fails is a row of the table, the others are run, and the exit code tells."""
    text = STUDY.replace("1100 K", "1200 K").replace("deck:", "collect: {results: [final_temperature_K]}\ndeck:")
    text = text.replace("{key: initial.temperature, values: [1200 K, 1200 K]}",
                        "{key: integrator.maximum_steps, values: [1, 100000]}")
    result = program("sweep", study(folder, text), "--out", folder / "failing")
    assert result.code == 3 and "1 of 2 runs failed" in result.err, f"{result.code}: {result.err}"
    table = rows(folder / "failing/study.csv")
    assert [row["status"] for row in table] == ["numerics failed", "done"], table
    assert table[0]["message"] and not table[0]["final_temperature_K"], table[0]
    assert float(table[1]["final_temperature_K"]) > 2000, table[1]
    assert set(table[1]) == {"run", "integrator.maximum_steps", "status", "message", "wall_time_s", "final_temperature_K"}

    wrong = STUDY.replace("[1100 K, 1200 K]", "[1100 K, -5 K]")
    result = program("sweep", study(folder, wrong), "--out", folder / "wrong")
    assert result.code == 2 and "initial.temperature" in result.err and "-5 K" in result.err, result.err
    assert not (folder / "wrong").exists(), "a study with a wrong deck was begun"

    # What only the problem itself can see is found in its run, and the sweep goes on.
    species = STUDY.replace("{key: initial.temperature, values: [1100 K, 1200 K]}",
                            "{key: initial.composition, values: ['H2X: 1', 'H2: 2, O2: 1, N2: 3.76']}")
    result = program("sweep", study(folder, species), "--out", folder / "species")
    assert result.code == 2 and "1 of 2 runs failed" in result.err, f"{result.code}: {result.err}"
    table = rows(folder / "species/study.csv")
    assert [row["status"] for row in table] == ["wrong input", "done"] and "H2X" in table[0]["message"], table


def check_refused(program: running.Program, folder: pathlib.Path) -> None:
    """What a study can never carry out is told by --check already, with the line."""
    many = STUDY + "".join(f"  - {{key: a{i}, values: [{', '.join(map(str, range(100)))}]}}\n" for i in range(6))
    convergence = f"study: errors\nconvergence:\n  deck: {POPULATION}\n  methods: [METHOD]\n  particles: [4, 8]\n"
    last = convergence + "  reference: {type: run, method: nobody, particles: 8, repeats: 2}\n"
    mistakes = (
        ("value", STUDY.replace("1200 K", "1100 K"), ":5:", "vary[0].values: '1100 K' is given twice"),
        ("deck", STUDY.replace("deck:", "decks:").replace(str(REACTOR), f"[{REACTOR}, {REACTOR}]"), ":2:", "is given twice"),
        ("variant", STUDY + "variants: [{name: a, set: []}, {name: a, set: []}]\n", ":6:", "variants: 'a' is given twice"),
        ("ranks", STUDY + "ranks_per_run: 4294967297\n", ":6:", "ranks_per_run: expected an integer of at most 2147483647"),
        ("many", many, ":4:", "vary: the study has 2e+12 runs"),
        ("method", convergence.replace("METHOD", "nobody"), ":4:", "convergence.methods: the deck has no method 'nobody'"),
        ("twice", convergence.replace("METHOD", "mmc, mmc"), ":4:", "convergence.methods: 'mmc' is named twice"),
        ("reference", last.replace("METHOD", "mmc"), ":6:", "convergence.reference.method: the deck has no method 'nobody'"),
        ("particles", convergence.replace("METHOD", "mmc").replace("8]", "1e15]\n  product: 2e15"),
         ":5:", "a sample of 1000000000000000 particles needs at least 36380 TiB"))
    # All messages on one rank; that only one of several ranks speaks does not need every one of them.
    for name, text, place, expected in mistakes if program.ranks == 1 else mistakes[::4]:
        deck = study(folder, text)
        for arguments in (("--check",), ("--out", folder / name)):
            result = program("sweep", deck, *arguments)
            assert result.code == 2 and not result.out, f"{name}: {result.code} {result.out}"
            assert f"lampblack: {deck}{place}" in result.err and expected in result.err, f"{name}: {result.err}"
        assert not (folder / name).exists(), f"{name}: a study that cannot be carried out was begun"

    # A deck of which no run can begin.
    none = study(folder, STUDY + "variants: [{name: a, set: ['mechanism=nowhere.yaml']}]\n")
    for arguments in (("--check",), ("--out", folder / "none")):
        result = program("sweep", none, *arguments)
        assert result.code == 2 and "nowhere.yaml: there is no such file" in result.err, result.err
    assert not (folder / "none").exists(), "a study of which no run can begin was begun"


def check_groups(program: running.Program, folder: pathlib.Path) -> None:
    """Runs side by side have the results of runs one after another."""
    deck = study(folder, STUDY)
    result = program("sweep", deck, "--out", folder / "groups", "--study-set", "ranks_per_run=1")
    assert result.code == 0, result.err
    assert program("sweep", deck, "--out", folder / "together").code == 0
    own = ("wall_time_s",)
    one, other = ([{k: v for k, v in row.items() if k not in own} for row in rows(folder / name / "study.csv")]
                  for name in ("groups", "together"))
    assert one == other, f"{one}\n{other}"
    result = program("sweep", deck, "--out", folder / "odd", "--study-set", f"ranks_per_run={program.ranks + 1}")
    assert result.code == 2 and "cannot be shared out" in result.err, result.err
    assert result.err.count("lampblack:") == 1, result.err


def check_population(program: running.Program, folder: pathlib.Path) -> dict:
    """Tables of the runs below each other, and a convergence study; returns what may not depend on the ranks."""
    text = f"""study: balance
decks: [{POPULATION}]
set: [repeats=3, time.outputs=5, time.end=1 s, 'distribution.times=[1 s]']
convergence:
  deck: {POPULATION}
  set: [time.outputs=5, time.end=2 s, 'distribution.times=[1 s]']
  methods: [constant_volume]
  particles: [32, 64, 128]
  product: 2048
"""
    result = program("sweep", study(folder, text), "--out", folder / "balance", timeout=120)
    assert result.code == 0, f"{result.code}: {result.err}"
    stacked = rows(folder / "balance/study_table.csv")
    own = rows(folder / "balance" / POPULATION.stem / "table.csv")
    assert len(stacked) == len(own) > 3 and {row["run"] for row in stacked} == {POPULATION.stem}
    points = rows(folder / "balance/convergence.csv")
    assert [(row["particles"], row["repeats"]) for row in points] == [("32", "64"), ("64", "32"), ("128", "16")]
    assert all(0 < float(row["error_M0"]) < 0.5 for row in points), points
    slopes = {row["moment"]: row for row in rows(folder / "balance/convergence_slopes.csv")}
    # The scatter of a repeat goes with the inverse square root of the particles; its estimate from 16 repeats is good to
    # 18 %, so that the slope over two doublings is uncertain by 0.15.
    assert abs(float(slopes["M0"]["scatter_slope"]) + 0.5) < 0.5, slopes["M0"]
    return {"points": points, "slopes": slopes, "history": rows(folder / "balance/convergence_history.csv")}


def main(executable: str, ranks: str, *mpiexec: str) -> None:
    program = running.Program(executable, list(mpiexec), int(ranks))
    alone = running.Program(executable, list(mpiexec), 1)
    tasks = [(check_good, program), (check_unfinished, program), (check_chain, program), (check_checkpoint, program), (check_failures, program),
             (check_refused, program), (check_jobs, program.process_of_its_own), (check_groups, program), (check_side_by_side, program.process_of_its_own),
             (check_population, program)]
    if program.ranks > 1:
        tasks.append((check_population, alone))

    def check(task: tuple):
        with tempfile.TemporaryDirectory() as name:
            return task[0](task[1], pathlib.Path(name))

    found = running.at_once(check, tasks)
    if program.ranks > 1:
        assert found[-1] == found[-2], "the convergence study depends on the ranks"


main(*sys.argv[1:])
