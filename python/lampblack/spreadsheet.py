"""CSV tables as people's spreadsheets write them: separated by commas, semicolons or tabs, with points or commas in numbers, in UTF-8,
UTF-16 or Windows' Western encoding, with rows and columns that are empty."""

import csv
import math

from .damage import reading
from .errors import InputError

_SUPERSCRIPTS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")


def _text(path):
    content = reading(path).read_bytes()
    if content[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return content.decode("utf-16", "replace")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return content.decode("cp1252", "replace")


class Sheet:
    """`rows`: the number of the line and its fields, of lines that are neither empty nor a remark (#). The first has the titles."""

    def __init__(self, path):
        lines = _text(path).splitlines()
        separator = None
        if lines and lines[0].lower().startswith("sep=") and len(lines[0]) == 5:  # Excel's own line
            separator, lines[0] = lines[0][4], ""
        first = next((line for line in lines if line.strip() and not line.lstrip("\" ").startswith("#")), "")
        self.separator = separator or max(",;\t", key=first.count)
        read = csv.reader(lines, delimiter=self.separator)
        self.rows = []
        for row in read:
            fields = [field.strip() for field in row]
            if any(fields) and not fields[0].startswith("#"):
                self.rows.append((read.line_num, fields))
        width = max((place for place, title in enumerate(self.rows[0][1], 1) if title), default=0) if self.rows else 0
        for _, fields in self.rows:
            while len(fields) > width and not fields[-1]:
                fields.pop()

    def number(self, text, where):
        """Of a field; InputError with its place."""
        plain = text.replace(",", ".") if self.separator != "," else text
        try:
            number = float(plain)
        except ValueError as error:
            hint = "; write it without marks between thousands" if text.count(",") + text.count(".") > 0 else ""
            raise InputError(f"{where}: a number is expected, found '{text}'{hint}") from error
        if not math.isfinite(number):
            raise InputError(f"{where}: a number that is finite is expected, found '{text}'; leave the row out")
        return number


def plain_unit(text):
    """A unit with raised digits (1/cm³, m⁻³) as decks write it."""
    return text.translate(_SUPERSCRIPTS)
