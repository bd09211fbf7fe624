"""Every description of the deck reference stands alone: it can be read without the key before it.

Not so: one that goes on from another ("And above this one.", "Instead: ..."), one that leaves out what it is of ("Of the
duct."), and a bare symbol ("Ta.", "E.").

Usage: deck_words_test.py EXECUTABLE
"""
import re
import subprocess
import sys

GOES_ON = re.compile(r"(And|Or|Instead|Of|On|By|In|At|Whose|With(?!in| type)|Absolute,|Between|Not|See|There|Its|His|Also)(?=\W)")


def rows(page):
    """(key, description) of every row of the reference."""
    for line in page.splitlines():
        if line.startswith("| `"):
            cells = re.split(r"(?<!\\) \| ", line.strip("| "))
            yield cells[0].strip("`"), cells[-1]


def faults(page):
    for key, text in rows(page):
        words = re.sub(r" Only with `.*", "", text).rstrip(".").split()
        if len(words) < 3:
            yield f"{key}: too short to say what it is: {text}"
        elif GOES_ON.match(text):
            yield f"{key}: does not stand alone: {text}"


def check_the_checker():
    head = "| key | what | default | meaning |\n|---|---|---|---|\n"
    good = "| `a.b` | number | `1` | Factor A of the rate. |\n| `c` | `x`, `y` | - | x: one way; y: another. |\n"
    assert list(faults(head + good)) == [], list(faults(head + good))
    for text in ("Ta.", "E.", "Longest ride.", "And above this one.", "Of the duct, in metres.", "Instead: a file of two columns."):
        assert len(list(faults(head + good + f"| `d` | number | - | {text} |\n"))) == 1, text
    assert len(list(faults("| `d` | number | - | Ta. Only with `e`: `f`, `g`. |"))) == 1


def main():
    check_the_checker()
    page = subprocess.run([sys.argv[1], "deck-reference"], check=True, capture_output=True, text=True).stdout
    assert len(list(rows(page))) > 200, "the deck reference is not what this test reads"
    wrong = list(dict.fromkeys(faults(page)))
    for line in wrong:
        print(line)
    if wrong:
        sys.exit(f"{len(wrong)} descriptions to mend")


if __name__ == "__main__":
    main()
