"""What the project cites by author and year stands in docs/references.md, and that page is in order.

A citation is "Author (year" or "Author, Author and Author year" or "Author et al. year": the surname of the first author and
the year make its key, and every author that is named has to be in the entry. What only looks like one (a name of a month, a
headline with a year) is in NOT_AUTHORS.

Usage: references_test.py [ROOT]
"""
import re
import sys
import tempfile
import unicodedata
from pathlib import Path

MODULES = "app chemistry core coupling flow io numerics particles tests"
# Not the mechanisms: their heads are full references, which go where the file goes.
PLACES = ["docs/theory/**/*.md", "docs/verification.md", "README.md", "cases/**/*.md", "cases/[!m]*/**/*.yaml",
          "scripts/**/*", *(f"{module}/**/*.[ch]pp" for module in MODULES.split())]
ENTRY = re.compile(r"^- \[([A-Za-z]+?)(\d{4})([a-z]?)\] (.+)$", re.M)
NAME = r"(?:(?:von|van|Van|Le|de) )?[A-Z][a-zé-íóöøüß]+(?:[A-Z][a-z]+)?(?:-[A-Z][a-z]+)?"
CITATION = re.compile(rf"({NAME}(?:(?:, and |, | and |,? & ){NAME})*)(?: et al\.| with others)?(?:'s?|,)? "
                      r"\(?(1[89]\d\d|20\d\d)\b(?!-\d\d|[.:]\d|\w)")
NOT_AUTHORS = {"November", "Tmax", "Temperature", "Density"}


def plain(text):
    """Without accents: Norsett is Nørsett."""
    text = text.replace("ø", "o").replace("Ø", "O").replace("ß", "ss")
    return "".join(c for c in unicodedata.normalize("NFD", text) if not unicodedata.combining(c))


def key_name(surname):
    return re.sub(r"[^A-Za-z]", "", plain(surname.removeprefix("von ")).replace("van ", "Van "))


def text_of(file):
    """The text with comment marks and line breaks gone, so that a citation over two lines is one."""
    text = re.sub(r"\n\s*(?://+|#+|\*|>)?\s*", " ", file.read_text(errors="replace"))
    text = text.replace('" "', "")  # a string in two pieces
    return re.sub(r"['\"`*]+ ", " ", text)


def citations(text):
    """(authors, year) of all that look like a citation."""
    for names, year in CITATION.findall(unicodedata.normalize("NFC", text)):
        authors = [name for name in re.split(r", and |, | and |,? & ", names) if name]
        if authors[0] not in NOT_AUTHORS:
            yield authors, year


def entries(page):
    """(surname, year) -> texts of the entries of docs/references.md."""
    found = {}
    for surname, year, _, text in ENTRY.findall(page):
        found.setdefault((surname, year), []).append(plain(text).lower())
    return found


def faults_of_page(page):
    keys = [a + b + c for a, b, c, _ in ENTRY.findall(page)]
    lines = [line for line in page.splitlines() if line.startswith("- ")]
    wrong = [f"docs/references.md: not an entry: {line}" for line in lines if not ENTRY.match(line)]
    wrong += [f"docs/references.md: {key} stands twice" for key in sorted(set(keys)) if keys.count(key) > 1]
    if keys != sorted(keys, key=str.lower):
        first = next(a for a, b in zip(keys, sorted(keys, key=str.lower)) if a != b)
        wrong.append(f"docs/references.md: the keys are not in alphabetical order, from {first} on")
    return wrong


def files(root):
    """What is read, without tables and what Python compiled."""
    found = {f for place in PLACES for f in root.glob(place) if f.is_file()}
    return sorted(f for f in found if f.suffix not in (".csv", ".pyc"))


def unknown(root):
    page = (root / "docs/references.md").read_text()
    known = entries(page)
    wrong = faults_of_page(page)
    for file in files(root):
        seen = set()
        for authors, year in citations(text_of(file)):
            texts = known.get((key_name(authors[0]), year), [])
            if not any(all(plain(a).lower() in text for a in authors) for text in texts):
                seen.add(f"{file.relative_to(root)}: {', '.join(authors)} ({year}) is not in docs/references.md")
        wrong += sorted(seen)
        if re.search(r"\bthesis\b", file.read_text(errors="replace"), re.I):
            wrong.append(f'{file.relative_to(root)}: "thesis"; cite it by author and year')
    return wrong


def check_the_checker():
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        (root / "docs/theory").mkdir(parents=True)
        (root / "core").mkdir()
        page = root / "docs/references.md"
        page.write_text("- [Hairer1993] E. Hairer, S. P. Nørsett, Equations (1993)\n- [VanLeer1974] B. van Leer, A (1974)\n")
        (root / "docs/theory/a.md").write_text(
            "As Hairer, Norsett (1993) and van\nLeer (1974) say (Hairer and Nørsett 1993, II.9); Hairer et al. 1993.\n")
        assert unknown(root) == [], unknown(root)
        (root / "docs/theory/b.md").write_text("Someone (1993); Hairer and\nWanner 1993.\n")
        (root / "core/c.hpp").write_text("// By Hairer\n// (1994), and the thesis.\n")
        wrong = unknown(root)
        for part in ("b.md: Someone (1993)", "b.md: Hairer, Wanner (1993)", "c.hpp: Hairer (1994)", 'c.hpp: "thesis"'):
            assert any(part in line for line in wrong), (part, wrong)
        assert len(wrong) == 4, wrong
        page.write_text("- [B2000] x\n- [A2000] y\n- [A2000] y\n- no key\n")
        assert len(faults_of_page(page.read_text())) == 3


def main():
    check_the_checker()
    root = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parents[1]
    assert len(entries((root / "docs/references.md").read_text())) > 100, "docs/references.md is not what this test reads"
    wrong = unknown(root)
    for line in wrong:
        print(line)
    if wrong:
        sys.exit(f"{len(wrong)} citations and entries to mend")
    print("Everything cited by author and year stands in docs/references.md.")


if __name__ == "__main__":
    main()
