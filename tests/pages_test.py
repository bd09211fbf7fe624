"""The pages lead where they say: links and anchors, files, cases, commands with their options, and decks.

Of every page: each link and anchor leads somewhere. Of the guides for users and developers (GUIDES): each file, case, script and
subcommand that is named exists, and each option is one of that command. docs/index.md and the site's menu name every page. The front
page is short, its table has a command and a picture in each row, and the program accepts its decks.

Usage: pages_test.py EXECUTABLE [ROOT]
"""

import concurrent.futures
import functools
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import pages

GUIDES = ["README.md", "CONTRIBUTING.md", "docs/index.md", "docs/comparison.md", "docs/installing.md", "docs/pictures.md", "docs/tutorial.md",
          "docs/python.md", "docs/architecture.md", "docs/decisions.md", "docs/tests.md"]
LONGEST = 105  # lines of the front page
FOLDERS = "app|cases|chemistry|cmake|core|coupling|docs|flow|io|numerics|packaging|particles|python|scripts|tests|\\.ci"
PATH = re.compile(rf"(?:\./)?((?:{FOLDERS})/[\w.+*/-]*)$")
OPTION = re.compile(r"(?<![\w-])--?[A-Za-z][\w-]*")
STANDS_FOR_ANY = re.compile(r"[<>*…]|\.\.\.|(?:^|/)[A-Z]{3,}(?:/|$)")  # results/<case>, DECK, cases/...


class Program:
    """What the commands say of themselves."""

    def __init__(self, executable):
        self.executable = str(Path(executable).resolve())
        # Pictures need no program, and each start is one rank.
        self.env = dict(os.environ, OMP_NUM_THREADS="1", OMPI_MCA_pml="ob1", OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")

    def __call__(self, *words, cwd=None):
        return subprocess.run([self.executable, *map(str, words)], cwd=cwd, env=self.env, stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, check=False)

    @functools.lru_cache
    def help(self, *words):
        return self(*words, "--help").stdout

    @functools.lru_cache
    def subcommands(self, *words):
        listed = re.search(r"^(?:Subcommands|SUBCOMMANDS):\n((?:  .*\n?|\n)+)", self.help(*words), re.M)
        return set(re.findall(r"^  ([a-z][\w-]*)", listed[1], re.M)) if listed else set()


def faults_of_links(root, page):
    text = page.read_text(encoding="utf-8")
    for link in pages.links(text):
        if re.match(r"[a-z]+:", link):
            continue
        name, _, anchor = link.partition("#")
        target = (page.parent / name).resolve() if name else page
        if not target.exists():
            yield f"{page.relative_to(root)}: there is no {link}"
        elif anchor:
            known = pages.anchors(target.read_text(encoding="utf-8"))
            if anchor not in known:
                yield f"{page.relative_to(root)}: {link}: no header has this anchor"
            elif known[anchor] != anchor:
                yield f"{page.relative_to(root)}: {link}: the site makes another anchor of this header, {known[anchor]}"


@functools.lru_cache
def names_in(module):
    """Words of all headers of a module."""
    return {word for header in module.rglob("*.hpp") for word in re.findall(r"\w+", header.read_text(encoding="utf-8"))}


def is_there(root, path):
    """A file or folder; a header without its ending, core/mesh; a case by its name; or a class of a module, flow/StepControl."""
    module, _, name = path.rpartition("/")
    return any(place.exists() for place in (root / path, root / f"{path}.hpp", root / "cases" / path)) or (name[:1].isupper() and name in names_in(root / module))


def faults_of_paths(root, name, text):
    code = [*pages.spans(text), *pages.indented(text), *pages.fenced(text, "sh"), *pages.fenced(text, "python")]
    for word in " ".join(code).split():
        found = PATH.match(word.strip("\"'(),;:"))
        if found and not STANDS_FOR_ANY.search(word) and not is_there(root, found[1]):
            yield f"{name}: there is no {found[1]}"


def options_of(root, program, command):
    """The text that has every option of a command, or what is wrong with its name."""
    if command[0] == "lampblack":
        words, rest = [], command[1:]
        while rest and rest[0] in program.subcommands(*words):
            words.append(rest.pop(0))
        if rest and not words and not rest[0].startswith("-") and not STANDS_FOR_ANY.search(rest[0]) and rest[0] != "command":
            return None, f"lampblack has no subcommand {rest[0]}"
        return program.help(*words), None
    script = root / command[0]
    if not script.is_file():
        return None, f"there is no {command[0]}"
    text = script.read_text(encoding="utf-8")
    if script.name == "plot":
        text += (root / "python/lampblack/plots/__main__.py").read_text(encoding="utf-8")
    return text, None


def faults_of_commands(root, program, name, text):
    for command in pages.commands(text):
        known, wrong = options_of(root, program, command)
        if wrong:
            yield f"{name}: {' '.join(command)}: {wrong}"
            continue
        for word in command[1:]:
            option = word.split("=")[0]
            if OPTION.fullmatch(option) and option not in OPTION.findall(known):
                yield f"{name}: {' '.join(command)}: there is no option {option}"
        if command[:3] == ["lampblack", "cases", "copy"] and len(command) > 3 and not STANDS_FOR_ANY.search(command[3]):
            if not any(path.is_dir() for path in root.glob(f"cases/**/{command[3]}")):
                yield f"{name}: {' '.join(command)}: there is no such case"


def faults_of_lists(root):
    """Pages that docs/index.md or the menu of the site leave out. The menu has those of theory and cases by itself."""
    index, menu = (root / "docs/index.md").read_text(encoding="utf-8"), (root / "packaging/mkdocs.yml.in").read_text(encoding="utf-8")
    linked = {(root / "docs" / link.partition("#")[0]).resolve() for link in pages.links(index)}
    listed = {(root / path).resolve() for path in re.findall(r": (\S+\.md)$", menu, re.M)}
    for path in sorted([*root.glob("docs/**/*.md"), *root.glob("cases/*/README.md"), *root.glob("cases/*/*/README.md")]):
        if path.resolve() not in linked and path != root / "docs/index.md":
            yield f"docs/index.md does not list {path.relative_to(root)}"
    for path in sorted(root.glob("docs/*.md")):
        if path.resolve() not in listed:
            yield f"packaging/mkdocs.yml.in does not list {path.relative_to(root)}"
    for path in sorted(listed):
        if not path.exists():
            yield f"packaging/mkdocs.yml.in: there is no {path.relative_to(root)}"


def rows_of_problems(text):
    """(command, picture) of each row of the front page's table."""
    for row in re.findall(r"^\| (?!problem|---)(.*) \|$", text, re.M):
        commands = [span for span in pages.SPAN.findall(row) if any(map(pages.is_ours, pages.words_of(span)))]
        yield commands, pages.IMAGE.findall(row)


def faults_of_front_page(text):
    if len(text.splitlines()) > LONGEST:
        yield f"README.md has {len(text.splitlines())} lines, more than {LONGEST}: move what is not for the first five minutes to docs/"
    rows = list(rows_of_problems(text))
    if len(rows) < 8:
        yield "README.md: the table of problems has lost rows"
    for commands, pictures in rows:
        if len(commands) != 1 or len(pictures) != 1:
            yield f"README.md: a row of the table has the commands {commands} and the pictures {pictures} in place of one each"
    for always in ("./scripts/run cases/flow/counterflow_ensembles", "./scripts/test"):
        if not any(line.split("  ")[0] == always for block in pages.indented(text) for line in block.splitlines()):
            yield f"README.md: the command {always} is gone"


def faults_of_decks(root, program, text):
    """What `check` says of the deck that the front page explains, and of those that its commands run."""
    with tempfile.TemporaryDirectory() as folder:
        tasks = []
        for number, block in enumerate(pages.fenced(text, "yaml")):
            deck = Path(folder) / f"deck{number}.yaml"
            deck.write_text(block, encoding="utf-8")
            tasks.append((f"the deck number {number + 1}", "check", deck))
        if not tasks:
            yield "README.md explains no deck"
        for command in pages.commands(text):
            if command[0] == "scripts/run" and len(command) > 1:
                deck = root / command[1]
                deck = deck / "deck.yaml" if deck.is_dir() else deck
                study = deck.is_file() and re.search(r"^study:", deck.read_text(encoding="utf-8"), re.M)
                tasks.append((command[1], *(("sweep", "--check") if study else ("check",)), deck))
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            for (what, *_), done in zip(tasks, pool.map(lambda task: program(*task[1:], cwd=folder), tasks), strict=True):
                if done.returncode != 0:
                    yield f"README.md: {what}: {done.stderr.strip()}"


def faults(root, program):
    for page in pages.pages(root):
        yield from faults_of_links(root, page)
    for name in GUIDES:
        if (root / name).is_file():
            text = (root / name).read_text(encoding="utf-8")
            yield from faults_of_paths(root, name, text)
            yield from faults_of_commands(root, program, name, text)
    yield from faults_of_lists(root)


TOY = """# A page

[here](#a-page), [there](other.md#one-two), ![picture](a.png), [gone](gone.md), [no header](other.md#three), [dashes](other.md#a---b)

    ./scripts/tool --yes x            # a comment
    lampblack run DECK --out results/<case> && lampblack runn
    build/release/app/lampblack run cases/none/deck.yaml --ouch
    scripts/none

`lampblack cases copy nothing`, `scripts/tool --no`, `docs/none.md`, `cases/...`, `core/Mesh`, `core/Mush`, `core/mesh`,
`lampblack --version`, `scripts/tool | lampblack check`
"""


class ToyProgram:
    def help(self, *words):
        return {(): "--version", ("run",): "  --out TEXT"}.get(words, "")

    def subcommands(self, *words):
        return {(): {"run", "cases", "check"}, ("cases",): {"copy"}}.get(words, set())


def check_the_checker():
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        files = {"README.md": TOY, "other.md": "# One, two\n\n## A - b\n", "a.png": "", "scripts/tool": "#  --yes\n", "core/mesh.hpp": "class Mesh {};\n",
                 "docs/index.md": "[a](../README.md)\n", "docs/left_out.md": "x\n", "packaging/mkdocs.yml.in": "  - a: docs/index.md\n  - b: docs/b.md\n"}
        for name, text in files.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text)
        found = list(faults(root, ToyProgram()))
        for part in ("there is no gone.md", "#three: no header", "another anchor of this header, a-b", "no subcommand runn", "no option --ouch",
                     "there is no scripts/none", "copy nothing: there is no such case", "no option --no", "there is no docs/none.md",
                     "there is no cases/none/deck.yaml", "there is no core/Mush", "index.md does not list docs/left_out.md", "yml.in does not list docs/left_out.md",
                     "yml.in: there is no docs/b.md"):
            assert any(part in line for line in found), (part, found)
        assert len(found) == 15, found  # scripts/none is no file and no command
        row = '| a | `scripts/tool x` | <img src="a.png"> |\n'
        page = "x\n\n    ./scripts/run cases/flow/counterflow_ensembles   # first\n    ./scripts/test\n\n| problem | c | p |\n|---|---|---|\n" + 8 * row
        assert list(faults_of_front_page(page)) == [], list(faults_of_front_page(page))
        assert len(list(faults_of_front_page(page.replace("scripts/test", "scripts/tset")))) == 1
        assert len(list(faults_of_front_page(page + row.replace("`", "")))) == 1
        assert len(list(faults_of_front_page(page + LONGEST * "x\n"))) == 1


def faults_of_entries(root, build):
    """Tests that a page names: each choice of `ctest -R`, and each executable of a test, is one of this build."""
    listed = subprocess.run(["ctest", "--test-dir", build, "-N"], capture_output=True, text=True, check=True).stdout
    entries = re.findall(r"^ *Test +#\d+: (\S+)", listed, re.MULTILINE)
    assert len(entries) > 50, "ctest lists no entries"
    for page in pages.pages(root):
        text = (root / page).read_text(encoding="utf-8")
        for quote, pattern in re.findall(r"(?:ctest|scripts/test)[^`\n]*-R\s+(['\"]?)([^'\"`\s]+)\1", text):
            for choice in pattern.split("|"):
                if not any(re.search(choice, entry) for entry in entries):
                    yield f"{page}: no test has '{choice}' in its name (ctest -R {quote}{pattern}{quote})"
        for path in re.findall(r"build/release/(tests/[\w/]+/(?:test|verification)_\w+)", text):
            if not (build / path).is_file():
                yield f"{page}: {path} is not built"


def main():
    check_the_checker()
    program = Program(sys.argv[1])
    root = Path(sys.argv[2]) if len(sys.argv) > 2 else Path(__file__).resolve().parents[1]
    front = (root / "README.md").read_text(encoding="utf-8")
    assert len(pages.pages(root)) > 50 and len(pages.commands(front)) > 10, "the pages are not where this test looks for them"
    assert {"run", "check", "gas"} <= program.subcommands(), "the program's help is not what this test reads"
    wrong = [*faults(root, program), *faults_of_front_page(front), *faults_of_decks(root, program, front),
             *faults_of_entries(root, Path(sys.argv[1]).resolve().parents[1])]
    wrong = list(dict.fromkeys(wrong))
    for line in wrong:
        print(line)
    if wrong:
        sys.exit(f"{len(wrong)} places of the pages to mend")
    print("Links, files, commands and decks of the pages are there.")


if __name__ == "__main__":
    main()
