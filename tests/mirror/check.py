"""Whether each source has its test: python3 check.py ROOT, the folder with engine/, app/ and tests/.

engine/heml/FLOOR/x.cpp is tested by tests/engine/FLOOR/x_test.cpp, engine/studies/x.cpp by tests/engine/studies/x_test.cpp and
app/PART/x.cpp by tests/app/PART/x_test.cpp; or a row of a table in tests/README.md, under the heading of its folder, names it and
the tests that cover it:

    ## engine/heml/FLOOR
    | `x`, `y_*` | `z_test.cpp`, `e2e/cli_test.py` | why |

Names have no ending, * stands for any letters. Tests without a folder lie where the mirrored ones would. A header without a .cpp
counts where it holds statements. Rows that name no source or no test, and such as are not needed, fail as well.
"""
import fnmatch
import pathlib
import re
import sys

COMMENTS_AND_TEXTS = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.DOTALL)
STATEMENTS = re.compile(r"\breturn\b|\b(?:if|for|while|switch) ?(?:constexpr )?\(")


def holds_statements(header):
    return bool(STATEMENTS.search(COMMENTS_AND_TEXTS.sub("", header.read_text())))


def sources(root):
    """Of each folder, relative to the root, the names of what is to be tested."""
    found = {}
    for top in ("engine", "app"):
        for path in sorted((root / top).rglob("*.[ch]pp")):
            if path.suffix == ".hpp" and (path.with_suffix(".cpp").exists() or not holds_statements(path)):
                continue
            found.setdefault(path.parent.relative_to(root).as_posix(), []).append(path.stem)
    return found


def tests_of(folder):
    """Where the tests of a folder lie, from tests/."""
    return re.sub(r"^engine/heml\b", "engine", folder)


def rows(readme):
    """Line number, folder, names and tests of each row of a table."""
    folder = None
    for number, line in enumerate(readme.read_text().splitlines(), 1):
        if line.startswith("#"):
            heading = re.fullmatch(r"#+ ((?:engine|app)(?:/\S+)?)", line)
            folder = heading and heading[1]
        cells = line.strip("|").split("|")
        if not folder or not line.startswith("|") or len(cells) < 3 or "`" not in cells[0]:
            continue
        yield number, folder, re.findall(r"`([^`]+)`", cells[0]), re.findall(r"`([^`]+)`", cells[1])


def check(root):
    readme = root / "tests" / "README.md"
    wrong, covered = [], {}
    found = sources(root)

    def has_own_test(folder, name):
        return (root / "tests" / tests_of(folder) / f"{name}_test.cpp").exists()

    for number, folder, patterns, tests in rows(readme):
        place = f"tests/README.md, line {number}"
        for pattern in patterns:
            matching = fnmatch.filter(found.get(folder, []), pattern)
            if not matching:
                wrong.append(f"{place}: {folder} has no source {pattern}")
            elif all(has_own_test(folder, name) for name in matching):
                wrong.append(f"{place}: {folder}/{pattern} has a test of its own")
            covered.setdefault(folder, set()).update(matching)
        if not tests:
            wrong.append(f"{place}: names no test")
        for test in tests:
            path = test if "/" in test else f"{tests_of(folder)}/{test}"
            if not (root / "tests" / path).is_file():
                wrong.append(f"{place}: there is no tests/{path}")
    for folder, names in found.items():
        for name in names:
            if not has_own_test(folder, name) and name not in covered.get(folder, ()):
                wrong.append(f"{folder}/{name}: no tests/{tests_of(folder)}/{name}_test.cpp, nor a row in tests/README.md")
    return wrong, sum(map(len, found.values()))


if __name__ == "__main__":
    errors, count = check(pathlib.Path(sys.argv[1]).resolve())
    for error in errors:
        print(error)
    if errors or not count:
        sys.exit(f"{len(errors)} faults, {count} sources")
    print(f"{count} sources, each with a test")
