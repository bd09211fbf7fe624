"""What analyses read and compare: units, tables, parameters with their priors, measurements, the objective.

Usage: analysis_data_test.py [EXECUTABLE]
"""

import contextlib
import io
import json
import pathlib
import sys
import tempfile
import types

import running

np = running.package("numpy")
running.needs("scipy", "h5py", "yaml")
sys.path.insert(0, str(running.SOURCE / "python"))

from lampblack import arrays  # noqa: E402
from lampblack.analysis import fit, measurements, objective, problem, runs, tables, work  # noqa: E402
from lampblack.errors import InputError, NumericsError  # noqa: E402
from lampblack.units import parse_unit, si_unit  # noqa: E402


def check_units():
    """As decks read them (io/units.hpp)."""
    for text, factor, si in (("1/cm^3", 1e6, "m^-3"), ("g/cm3", 1e3, "m^-3 kg"), ("kJ/mol", 1e3, "m^2 kg s^-2 mol^-1"), ("ppm", 1e-6, "1"), ("nm", 1e-9, "m"),
                             ("mmol", 1e-3, "mol"), ("m", 1.0, "m"), ("min", 60.0, "s"), ("1/m^3/s", 1.0, "m^-3 s^-1"), ("W/m/K", 1.0, "m kg s^-3 K^-1"),
                             ("", 1.0, "1"), ("dam", 10.0, "m"), ("atm", 101325.0, "m^-1 kg s^-2"), ("kg m", 1.0, "m kg"), ("s^-2", 1.0, "s^-2")):
        found, offset, dimension = parse_unit(text)
        assert abs(found / factor - 1) < 1e-12 and offset == 0 and si_unit(dimension) == si, (text, found, si_unit(dimension))
    assert parse_unit("degC")[1] == 273.15
    for text in ("furlong", "m//s", "m/s K", "/m", "cmin"):
        running.refused(InputError, text, parse_unit, text)


def check_tables():
    """Sorted by columns, and joined by them."""
    runs = arrays.Table({"run": arrays.Array(["b", "a", "c"]), "T": arrays.Array([2.0, np.nan, 1.0], "T", "K"), "n": arrays.Array([1, 1, 0])})
    assert list(runs.sorted_by("T")["run"]) == ["c", "b", "a"] and runs.sorted_by("run")["T"].unit == "K"
    assert list(runs.sorted_by("T", descending=True)["run"]) == ["b", "c", "a"] and list(runs.sorted_by("n", "run")["run"]) == ["c", "a", "b"]
    texts = arrays.Table({"T": arrays.Array(["1100 K", "700 degC", "900 K"]), "x": arrays.Array(["2 m", "10 K", "1 m"]),
                         "y": arrays.Array(["2 m", "30 cm", "1 m"])})
    assert list(texts.sorted_by("y")["y"]) == ["30 cm", "1 m", "2 m"]
    assert list(texts.sorted_by("T")["T"]) == ["900 K", "700 degC", "1100 K"] and list(texts.sorted_by("x")["x"]) == ["1 m", "10 K", "2 m"]
    other = arrays.Table({"run": arrays.Array(["c", "b", "x"]), "T": arrays.Array([7.0, 8.0, 9.0], "T", "K"), "f": arrays.Array([0.1, 0.2, 0.3], "f", "ppm")})
    both = runs.joined(other, "run")
    assert list(both["run"]) == ["b", "c"] and list(both["f"]) == [0.2, 0.1] and list(both["T_2"]) == [8.0, 7.0] and both["f"].unit == "ppm"
    assert runs.joined(other, ["run", "T"]).rows == 0
    running.refused(ValueError, "two rows", runs.joined, runs, "n")


def check_parameters():
    """Scales, priors and their quantiles."""
    def one(**more):
        return problem.Parameter({"name": "a", "from": 2.0, "to": 200.0, "scale": "log", "set": ["k={a}"], "shift": [], **more}, "parameters[0]")

    a = one()
    assert abs(a.value(0.5) - 20) < 1e-12 and abs(a.place(20) - 0.5) < 1e-15 and abs(a.start - 20) < 1e-12
    assert abs(a.slope(0.3) - (a.value(0.3 + 1e-6) - a.value(0.3 - 1e-6)) / 2e-6) < 1e-5 and a.score(0.2) is None and a.drawn(0.25) == 0.25
    for kind, mean, deviation in (("normal", 30.0, 10.0), ("lognormal", 20.0, 0.5)):
        b = one(prior={"type": kind, "mean": mean, "deviation": deviation})
        values = b.value(b.drawn((np.arange(20000) + 0.5) / 20000))
        values = np.log(values) if kind == "lognormal" else values
        centre = np.log(mean) if kind == "lognormal" else mean
        assert abs(np.median(values) - centre) < 0.03 * deviation and abs(values.std() / deviation - 1) < 0.03, (kind, values.mean(), values.std())
        # The density over the scale, from counts of what is drawn.
        x = b.drawn((np.arange(20000) + 0.5) / 20000)
        counts = np.histogram(x, bins=20, range=(0, 1))[0]
        density = np.exp(b.log_prior((np.arange(200) + 0.5) / 200)).reshape(20, 10).mean(axis=1)
        assert np.abs(counts / 20000 - density / density.sum()).max() < 0.01, kind
    for words, more in (("above from", {"to": 1.5}), ("above 0", {"from": -1.0}), ("from 2 to 200", {"start": 300.0}),
                        ("between the bounds", {"prior": {"type": "normal", "mean": 900.0, "deviation": 10.0}})):
        running.refused(InputError, words, lambda more=more: one(**more))


def options_of(folder):
    """As the program resolves them."""
    (folder / "a.yaml").write_text("problem: reactor\n", encoding="utf-8")
    parameter = {"from": 1.0, "to": 100.0, "scale": "log", "shift": []}
    deck = {"deck": "a.yaml", "set": ["x=1"], "weight": 1.0, "use": "fit"}
    quantity = {"table": "t.csv", "column": "c", "along": "z", "take": "last", "transform": "none"}
    return {"analysis": "a", "decks": [{**deck, "name": "one"}, {**deck, "name": "two", "weight": 4.0, "abscissa_from": 1e-3, "abscissa_to": 2e-3}],
            "parameters": [{**parameter, "name": "k", "set": ["rate=[{k}, {k*0.5}]"], "prior": {"type": "lognormal", "mean": 10.0, "deviation": 0.5}},
                           {**parameter, "name": "z", "from": -1e-3, "to": 1e-3, "scale": "linear", "set": [], "shift": ["two"]}],
            "quantities": {"f": {**quantity, "transform": "log10"}, "T": quantity}, "measurements": {"files": ["m.csv"], "model_error": 0.0}}  # fmt: skip


DATA = """deck,quantity,abscissa [mm],value [ppm],error [%],source
# a remark
one,f,2,10,20,here
two,T,1.5,4,5,
two,T,0.5,4,5,
two,T,2.5,4,5,
"""


def check_problem(folder):
    """Settings of a run, a shift of the abscissae, and rows of measurements in SI units within their limits."""
    known = problem.Problem(options_of(folder), folder / "analysis.yaml")
    x = np.array([0.5, 0.75])
    assert known.settings(known.experiments[0], x) == ["x=1", f"rate=[{known.values(x)['k']!r}, {0.5 * known.values(x)['k']!r}]"]
    assert abs(known.values(x)["k"] - 10) < 1e-12 and abs(known.shift(known.experiments[1], x) - 5e-4) < 1e-15 and known.shift(known.experiments[0], x) == 0
    (folder / "m.csv").write_text(DATA, encoding="utf-8")
    rows = measurements.read_measurements(known)
    assert [(o.name, o.source) for o in rows] == [("one.f@0.002", "here"), ("two.T@0.0015", "")], rows
    assert np.allclose([rows[0].value, rows[0].error, rows[1].value, rows[1].error], [1e-5, 2e-6, 4e-6, 2e-7], rtol=1e-12)
    (folder / "m.csv").write_text("deck,quantity,value [degC],error [K]\none,T,20,2\none,T,20,5 %\n", encoding="utf-8")
    rows = measurements.read_measurements(known)
    assert np.allclose([rows[0].value, rows[0].error, rows[1].error], [293.15, 2, 0.05 * 293.15]) and rows[0].place is None
    measurements.refuse_other_dimension(rows[0], "K", "value")
    (folder / "m.csv").write_text("deck,quantity,value [ppm],error [ppb]\none,T,20,2\n", encoding="utf-8")
    assert abs(measurements.read_measurements(known)[0].error / 2e-9 - 1) < 1e-12
    running.refused(InputError, "in K, and the run has it in m", measurements.refuse_other_dimension, rows[0], "m", "value")
    for words, row in (("finite", "one,T,nan,2"), ("finite", "one,T,20,inf"), ("share of the value 0", "one,T,0,5 %")):
        (folder / "m.csv").write_text(f"deck,quantity,value,error\n{row}\n", encoding="utf-8")
        running.refused(InputError, words, measurements.read_measurements, known)
    for words, change in (("'{k*-1}' is not understood", ("parameters", 0, "set", ["rate={k*-1}"])), ("'{ k }'", ("parameters", 0, "set", ["rate={ k }"])),
                          ("f.along: this is for a table", ("quantities", "f", "table", None))):
        options = options_of(folder)
        section, which, key, value = change
        options[section][which][key] = value
        if section == "quantities":
            options[section][which].update(result="a", column=None)
        running.refused(InputError, words, problem.Problem, options, folder / "analysis.yaml")
    options = options_of(folder)
    options["parameters"][0]["set"] = ["rate={low: {k}, none: {}}"]
    assert problem.Problem(options, folder / "analysis.yaml").settings(known.experiments[0], x)[1] == f"rate={{low: {known.values(x)['k']!r}, none: {{}}}}"


SHEETS = {  # the same rows as several programs write them
    "comma, point, remark": "# mine\ndeck,quantity,abscissa [mm],value [1/cm³],error [%],source\none,f,2.5,1.5e3,10.5,\"Doe, 2020\"\n",
    "Excel, German": "Deck;Quantity;Abscissa [mm];Value [1/cm³];Error [%];Source\r\none;f;2,5;1,5E+03;10,5;Doe, 2020\r\n;;;;;\r\n",
    "the same, marked as UTF-8": "\ufeffdeck;quantity;abscissa [mm];value [1/cm3];error;source\r\none;f;2,5;1500;10,5 %;Doe, 2020\r\n",
    "Excel's own line": "sep=;\r\ndeck;quantity;abscissa [mm];value [1/cm³];error [%];source\r\none;f;2.5;1500;10,5;Doe, 2020\r\n",
    "tabs": "deck\tquantity\tabscissa [mm]\tvalue [cm⁻³]\terror [%]\tsource\none\tf\t2,5\t1500\t10,5 %\tDoe, 2020\n",
    "empty columns": "deck,quantity,abscissa [mm],value [1/cm3],error [%],source,,\n,,,,,,,\none,f,2.5,1500,10.5,\"Doe, 2020\",,\n"}


def check_spreadsheets(folder):
    known = problem.Problem(options_of(folder), folder / "analysis.yaml")
    for name, text in SHEETS.items():
        for encoding in ("utf-8", *([] if text[0] == "\ufeff" else ["utf-16"]), *([] if text[0] == "\ufeff" or "⁻" in text else ["cp1252"])):
            (folder / "m.csv").write_bytes(text.encode(encoding))
            (row,) = measurements.read_measurements(known)
            assert np.allclose([row.place, row.value, row.error], [2.5e-3, 1.5e9, 1.575e8], rtol=1e-12, atol=0), (name, encoding, row)
            assert row.source == "Doe, 2020", (name, encoding, row)
    for words, text in (("m.csv:3: a number is expected, found '1.234,5'; write it without marks", "deck;quantity;value;error\n\none;f;1.234,5;1\n"),
                        ("found '1,5'", "deck,quantity,value,error\none,f,\"1,5\",1\n"), ("4 fields are expected, found 5", "deck;quantity;value;error\none;f;1;1;x\n"),
                        ("the file is empty", ";;;\n")):
        (folder / "m.csv").write_text(text, encoding="utf-8")
        running.refused(InputError, words, measurements.read_measurements, known)
    made = work.Work(problem.Problem({**options_of(folder), "ranks_per_run": 1, "design": {"type": "file", "file": "d.csv", "seed": 1}}, folder / "a.yaml"), folder)
    (folder / "d.csv").write_bytes("k;z\r\n10;0,0005\r\n1;-0,001\r\n".encode("utf-16"))
    assert np.allclose(made.design(), [[0.5, 0.75], [0, 0]], rtol=0, atol=1e-12)
    for words, text in (("has no column z", "k\n1\n"), ("d.csv:2: a number", "k;z\n1;x\n"), ("2 fields", "k;z\n1\n")):
        (folder / "d.csv").write_text(text, encoding="utf-8")
        running.refused(InputError, words, made.design)


class Ran(runs.Runs):
    """Two runs, each a table of three rows; the experiment two has failed."""

    def __init__(self, known, folder):
        super().__init__(known, folder / "runs")
        (folder / "t.csv").write_text("z [m],c\n0.001,1\n0.002,3\n0.003,-5\n", encoding="utf-8")
        self.where, self.asked = folder, []

    def run(self, points, experiments):
        self.asked += [experiment.name for experiment in experiments]

    def place(self, experiment, x):
        return self.where


def check_runs(folder):
    """Only the decks of what is asked for run; a shift beyond the run fails the point, a place beyond it the analysis; no logarithm warns."""
    options = options_of(folder)
    options.update(ranks_per_run=1, design={"seed": 1})
    known = problem.Problem(options, folder / "analysis.yaml")
    two, output = known.experiments[1], measurements.Output
    made = work.Work(known, folder)
    made.runs = Ran(known, folder)
    one = output(two, known.quantities["T"], place=2.8e-3)
    values, _ = made.runs.values(np.array([[0.5, 0.5], [0.5, 0.9]]), [one])
    assert abs(values[0, 0] + 3.4) < 1e-12 and np.isnan(values[1, 0]) and made.runs.asked == ["two"], (values, made.runs.asked)
    tables.write_points(folder / "points.csv", known, made.runs, np.array([[0.5, 0.5], [0.5, 0.9]]), [one], values, values)
    assert [row.split(",")[2] for row in (folder / "points.csv").read_text(encoding="utf-8").splitlines()] == ["status", "done", "failed"]
    running.refused(InputError, "abscissa_from", made.runs.values, np.array([[0.5, 0.5]]), [output(known.experiments[0], known.quantities["T"], place=4e-3)])
    made.asked(np.array([[0.5, 0.5]]), [output(known.experiments[0], known.quantities["f"], place=2.9e-3)], "design")
    assert len(made.warnings) == 1 and "1 of 1 values of one.f@0.0029 are not above 0" in made.warnings[0], made.warnings


def check_follow():
    """What a study says is kept; how far it is, passed on now and then."""
    lines = ["--- run 1 of 9: a\n", "study: about 1 of 9 runs behind, to go 8 s\n", "study: about 2 of 9 runs behind, to go 7 s\n", "study in here\n"]
    for seconds, told in ((0.0, 2), (60.0, 0)):
        kept, said = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(said):
            runs._follow(lines, kept, seconds)
        assert kept.getvalue() == "".join(lines) and said.getvalue() == "".join(lines[1:1 + told]), (said.getvalue(), told)


def check_kept_failures(folder):
    """Of an earlier session a failure of numerics is kept, a wrong input is tried again."""
    options = {**options_of(folder), "ranks_per_run": 1}
    known, batch = problem.Problem(options, folder / "analysis.yaml"), folder / "kept/batch_1"
    batch.mkdir(parents=True)
    (batch / "study.yaml").write_text("{}", encoding="utf-8")
    (batch / "study.json").write_text(json.dumps({"runs": [{"run": f"k_{i}", "status": status, "message": ""} for i, status in enumerate(
        ("wrong input", "numerics failed"))]}), encoding="utf-8")
    assert set(runs.Runs(known, folder / "kept")._failed) == {"1"} and set(runs.Runs(known, folder / "kept", jobs=2)._failed) == {"0", "1"}


def check_bases(folder):
    """A run is of its deck's base, too; the deck with the constants is laid over it and stands alone."""
    (folder / "base.yaml").write_text("problem: reactor\ntime: {end: 1 ms, steps: [1, 2]}\nmechanism: h2.yaml\npaths: [{x: NO}, {x: b}]\n", encoding="utf-8")
    deck = folder / "own.yaml"
    alone, keys = folder / "alone.yaml", set()
    alone.write_text("problem: reactor\n", encoding="utf-8")
    one, other = (types.SimpleNamespace(deck=path, name=path.stem) for path in (deck, alone))
    for text in ("base: base.yaml\ntime: {end: 2 ms}\n", "base: 'base.yaml' # as there\n", '{"base": "base.yaml", "time": {"end": "2 ms"}}\n'):
        deck.write_text(text, encoding="utf-8")
        first, without = runs.run_key(one, []), runs.run_key(other, [])
        (folder / "base.yaml").write_text((folder / "base.yaml").read_text(encoding="utf-8") + "# edited\n", encoding="utf-8")
        keys |= {first, runs.run_key(one, [])}
        assert runs.run_key(other, []) == without and runs.run_key(one, []) == runs.run_key(one, [])
    assert len(keys) == 6, keys

    yaml, warned = running.package("yaml"), []
    known = types.SimpleNamespace(name="a", experiments=[one], settings=lambda experiment, x: ["paths[1].x=7", "time.start=1 s"])
    tables.write_best(folder / "best", types.SimpleNamespace(problem=known, runs=types.SimpleNamespace(place=lambda *at: folder), warn=warned.append), None, [])
    best = yaml.load((folder / "best/own.yaml").read_text(encoding="utf-8"), Loader=yaml.BaseLoader)
    assert not warned and best == {"problem": "reactor", "time": {"end": "2 ms", "steps": ["1", "2"], "start": "1 s"}, "mechanism": "h2.yaml",
                                   "paths": [{"x": "NO"}, {"x": "7"}]}, best


def check_record(folder):
    """Numbers that are not finite are null."""
    known = types.SimpleNamespace(name="a", path=folder / "a", options={"design": {"seed": 1}})
    known_runs = types.SimpleNamespace(begun=0, taken=0)
    version, tables.executable = tables.executable, lambda: "true"
    tables.write_record(folder / "record.json", "fit", known, known_runs, {"phi_best": np.inf, "best": {"a": np.float64("nan"), "b": np.array([1.5])}})
    tables.executable = version
    record = json.loads((folder / "record.json").read_text(encoding="utf-8"))
    assert record["phi_best"] is None and record["best"] == {"a": None, "b": [1.5]}, record


def check_objective(folder):
    """Residuals by hand: errors after the logarithm, noise of the run, the model's own error, weights, priors."""
    options = options_of(folder)
    options["measurements"]["model_error"] = 0.03
    known = problem.Problem(options, folder / "analysis.yaml")
    (folder / "m.csv").write_text(DATA, encoding="utf-8")
    target = objective.Objective(known, measurements.read_measurements(known))
    values, errors = np.array([[2e-5, 5e-6], [np.nan, 5e-6], [-1.0, 5e-6]]), np.array([[2e-6, 3e-7]] * 3)
    rest = target.residuals(target.transformed(values), target.transformed_errors(values, errors), np.array([[0.25, 0.5]] * 3))
    s = np.sqrt((0.2 / np.log(10)) ** 2 + (0.1 / np.log(10)) ** 2 + 0.03**2)
    expected = [(np.log10(1e-5) - np.log10(2e-5)) / s, 2 * (4e-6 - 5e-6) / np.sqrt(2e-7**2 + 3e-7**2 + 0.03**2), np.log(100**0.25 / 10) / 0.5]
    assert np.allclose(rest[0], expected, rtol=1e-12), (rest[0], expected)
    assert np.isnan(rest[1][0]) and target.phi_of_data(rest[1]) == np.inf and np.isnan(rest[2][0])
    assert abs(target.phi_of_data(rest[0]) - expected[0] ** 2 - expected[1] ** 2) < 1e-12


def check_noisy_surrogates(folder):
    """Of a number that does not change, runs show their noise alone: no surrogate of it is refused, but where it misses more than they say."""
    options = {**options_of(folder), "ranks_per_run": 1, "design": {"seed": 1}, "surrogate": {"order": 2, "pairs": True, "least_r2": 0.9}}
    known = problem.Problem(options, folder / "analysis.yaml")
    rows = [measurements.Output(known.experiments[0], known.quantities["T"], value=1.0, error=1e-3)]
    draw = np.random.default_rng(3)
    points = draw.random((64, 2))
    for slope, noise, error, good in ((0.0, 0.01, 0.01, True), (0.0, 0.01, 0.005, False), (0.0, 2e-4, 0.0, True), (0.0, 6e-4, 0.0, False), (1.0, 0.01, 0.0, True)):
        model = fit.Model(work.Work(known, folder), objective.Objective(known, rows))
        values = 1 + slope * points[:, :1] + noise * draw.standard_normal((64, 1))
        model.work.say = lambda text: None
        if good:
            model.make_surrogates(points, values, np.full((64, 1), error))
            assert 0.7 * max(noise, error) < model.noise[0] < 1.5 * max(noise, error), (slope, noise, error, model.noise)
        else:
            running.refused(NumericsError, "below surrogate.least_r2", model.make_surrogates, points, values, np.full((64, 1), error))


def main():
    checks = [one for name, one in globals().items() if name.startswith("check_") and isinstance(one, types.FunctionType)]
    with tempfile.TemporaryDirectory() as name:
        for check in checks:
            check(*([pathlib.Path(name)] if check.__code__.co_argcount else []))
    print(f"{len(checks)} groups")


if __name__ == "__main__":
    main()
