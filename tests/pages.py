"""What the tests of the pages share: the code of a page, its links and anchors, and the commands in it."""

import itertools
import re
import shlex

SPAN = re.compile(r"(?<!`)`([^`\n]+)`(?!`)")
FENCE = re.compile(r"^```(\w*)\n(.*?)^```", re.S | re.M)
LINK = re.compile(r"!?\[(?:[^\[\]]|\[[^\]]*\])*\]\(([^()\s]+)\)")
IMAGE = re.compile(r'<img src="([^"]+)"')
OPERATORS = set("|&;<>()")


def pages(root):
    """Every page of the sources: the front page, docs/, cases/, and the few beside them."""
    found = [root / "README.md", root / "CONTRIBUTING.md", *root.glob("docs/**/*.md"), *root.glob("cases/**/*.md"), *root.glob("tests/*/README.md")]
    return sorted(page for page in found if page.is_file())


def fenced(text, language):
    return [block for name, block in FENCE.findall(text) if name == language]


def indented(text):
    """Blocks that four spaces make code."""
    return [re.sub(r"^ {4}", "", block, flags=re.M) for block in re.findall(r"(?<=\n\n)((?: {4}.*\n)+)", FENCE.sub("", text))]


def prose(text):
    return re.sub(r"^ {4}.*$", "", FENCE.sub("", text), flags=re.M)


def spans(text):
    """Code within lines."""
    return SPAN.findall(prose(text))


def links(text):
    """Targets of links, whose text may be code, and of pictures."""
    return LINK.findall(prose(text)) + IMAGE.findall(prose(text))


def anchors(text):
    """Anchor of each header as GitHub makes it, and as the site does (scripts/site)."""
    found = {}
    for header in re.findall(r"^#{1,6} +(.+?) *$", FENCE.sub("", text), re.M):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", header).replace("`", "")
        github = re.sub(r"[^\w\- ]", "", plain.lower()).replace(" ", "-")
        site = re.sub(r"[-\s]+", "-", re.sub(r"[^\w\s-]", "", plain.lower()).strip())
        found[github] = site
    return found


def words_of(line):
    """The commands of a line as lists of words; none where it is no line of a shell. Ends at what a shell acts upon."""
    reader = shlex.shlex(line, posix=True, punctuation_chars=True)
    reader.whitespace_split = True
    try:
        tokens = list(reader)
    except ValueError:
        return []
    found, command, redirected = [], [], False
    for token in tokens:
        if set(token) <= OPERATORS:
            redirected = token[0] in "<>"
            if not redirected:
                found.append(command)
                command = []
        elif not redirected:
            command.append(token)
        else:
            redirected = False
    without_variables = [list(itertools.dropwhile(lambda word: re.match(r"[A-Z_]+=", word), words)) for words in [*found, command]]
    return [command for command in without_variables if command]


def is_ours(command):
    first = command[0].removeprefix("./")
    return first == "lampblack" or first.endswith("app/lampblack") or re.match(r"scripts/\w", first)


def commands(text):
    """Every command of ours on a page, in code of any kind, as lists of words without a path before `lampblack`."""
    lines = [line for block in [*indented(text), *fenced(text, "sh")] for line in block.replace("\\\n", " ").splitlines()]
    found = [command for line in [*lines, *spans(text)] for command in words_of(line)]
    ours = [command for command in found if is_ours(command)]
    return [[re.sub(r"^(\./|.*/app/)", "", command[0]), *command[1:]] for command in ours]
