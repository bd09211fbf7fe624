"""What was measured, or what is looked at where nothing was: each an `Output`, one number of a run."""

import dataclasses

from ..errors import InputError
from ..spreadsheet import Sheet, plain_unit
from ..units import parse_unit, si_unit

COLUMNS = ("deck", "quantity", "abscissa", "value", "error", "source")


@dataclasses.dataclass
class Output:
    """In SI units. `place` is where it is looked up, none for the one number that its quantity takes; `value` is none where nothing was
    measured; `error` its standard deviation, of which `relative` is a share of the value."""

    experiment: object
    quantity: object
    place: float | None = None
    value: float | None = None
    error: float = 0.0
    relative: float = 0.0
    source: str = ""
    dimension: tuple | None = None  # of the value, where its unit was given
    along: tuple | None = None

    @property
    def name(self):
        """For a column: deck.quantity, and the place behind an @."""
        return f"{self.experiment.name}.{self.quantity.name}" + ("" if self.place is None else f"@{self.place:.6g}")


def _read(path, experiments, quantities):
    try:
        sheet = Sheet(path)
    except OSError as error:
        raise InputError(f"measurements.files: {path}: {error.strerror}") from error
    rows = sheet.rows
    if not rows:
        raise InputError(f"{path}: the file is empty; expected the columns {', '.join(COLUMNS)}")
    line, head = rows[0]
    places, units = {}, {}
    for place, title in enumerate(head):
        name, _, unit = title.partition("[")
        name, unit = name.strip().lower(), plain_unit(unit.rstrip("] ").strip())
        if name not in COLUMNS:
            raise InputError(f"{path}:{line}: there is no column '{name}' of measurements; expected {', '.join(COLUMNS)}")
        places[name] = place
        try:
            units[name] = (parse_unit(unit) if unit else None, unit)
        except InputError as error:
            raise InputError(f"{path}:{line}: {error.message}") from error
    for name in ("deck", "quantity", "value", "error"):
        if name not in places:
            raise InputError(f"{path}:{line}: the column '{name}' is missing")
    outputs = []
    for line, row in rows[1:]:
        where = f"{path}:{line}"
        if len(row) != len(head):
            raise InputError(f"{where}: {len(head)} fields are expected, found {len(row)}")
        text = {name: row[place] for name, place in places.items()}
        if text["deck"] not in experiments:
            raise InputError(f"{where}: there is no deck of the name '{text['deck']}'; expected one of {', '.join(experiments)}")
        if text["quantity"] not in quantities:
            raise InputError(f"{where}: there is no quantity '{text['quantity']}'; expected one of {', '.join(quantities)}")
        output = Output(experiments[text["deck"]], quantities[text["quantity"]], source=text.get("source", ""))

        def si(name):
            unit, _ = units[name]
            factor, offset, dimension = unit or (1.0, 0.0, None)
            return sheet.number(text[name], where) * factor + offset, dimension

        if text["value"]:
            output.value, output.dimension = si("value")
            if output.quantity.is_log and output.value <= 0:
                raise InputError(f"{where}: the logarithm of '{text['value']}' is asked for; leave the row out, or transform: none")
        elif output.experiment.use != "candidate":
            raise InputError(f"{where}: the value is missing; only experiments of use candidate may have none")
        else:
            output.dimension = (units["value"][0] or (1.0, 0.0, None))[2]
        if text.get("abscissa"):
            output.place, output.along = si("abscissa")
            if output.quantity.along is None:
                raise InputError(f"{where}: there is an abscissa, and quantities.{output.quantity.name} has no key along")
        share = units["error"][1] == "%" or text["error"].endswith("%")
        number = sheet.number(text["error"].rstrip("% "), where)
        if number <= 0:
            raise InputError(f"{where}: the error has to be above 0, or nothing is compared with it; found '{text['error']}'")
        if share:
            if output.value == 0:
                raise InputError(f"{where}: a share of the value 0 is no error; write the error in the unit of the value, or leave the row out")
            output.relative = number / 100
            output.error = output.relative * abs(output.value or 0.0)
        else:
            factor, _, dimension = units["error"][0] or units["value"][0] or (1.0, 0.0, None)
            if units["error"][0] and output.dimension is not None and dimension != output.dimension:
                raise InputError(f"{path}: the error is in {units['error'][1]}, which is not of the kind of its value; or write the share in %")
            output.error = number * factor
        experiment = output.experiment
        if output.place is None or experiment.abscissa_from <= output.place <= experiment.abscissa_to:
            outputs.append(output)
    return outputs


def read_measurements(problem):
    """All rows of all files, in order. InputError."""
    experiments = {one.name: one for one in problem.experiments}
    outputs = []
    for name in problem.options["measurements"]["files"]:
        outputs += _read(problem.folder / name, experiments, problem.quantities)
    return outputs


def single_numbers(problem):
    """The one number that each quantity takes, of each deck."""
    return [Output(experiment, quantity) for experiment in problem.experiments for quantity in problem.quantities.values()
            if experiment.use != "candidate"]


def refuse_other_dimension(output, unit, title):
    """InputError where a column of a run has not the kind of unit that was measured."""
    for given, what in ((output.dimension, "value"), (output.along, "abscissa")):
        if title == what and given is not None and unit not in ("", None):
            _, _, expected = parse_unit(unit)
            if given != expected:
                raise InputError(f"measurements: the {what} of {output.name} is in {si_unit(given)}, and the run has it in {unit}")
