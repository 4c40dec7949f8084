#!/usr/bin/env python3
"""Prints which tests failed, with the end of their output, and how many passed: last of all in a log.

    python3 tests/summary.py build/release/results.xml ...

Reads JUnit files as ctest and pytest write them. Exits with 1 if a test failed, a file is missing, or there was none.
"""
import re
import sys
import xml.etree.ElementTree as tree

LINES = 25  # of a failed test's output


def read(path):
    with open(path, encoding="utf-8", errors="replace") as file:
        # XML cannot hold the control characters of coloured output.
        return tree.fromstring(re.sub(r"[\x00-\x08\x0b\x0c\x0e-\x1f]", "", file.read()))


def output_of(case):
    return "\n".join(text for part in case for text in (part.get("message"), part.text) if text)


def main(paths):
    passed = skipped = 0
    failed = []
    for path in paths:
        try:
            cases = read(path).iter("testcase")
        except (OSError, tree.ParseError) as error:
            failed.append((path, f"no results: {error}"))
            continue
        for case in cases:
            kinds = {part.tag for part in case}
            if kinds & {"failure", "error"} or case.get("status") == "fail":
                failed.append((f"{path}: {case.get('name')}", output_of(case)))
            elif "skipped" in kinds or case.get("status") in ("notrun", "disabled"):
                skipped += 1
            else:
                passed += 1
    for name, output in failed:
        print(f"\nFAILED {name}", *output.strip().splitlines()[-LINES:], sep="\n  ")
    print(f"{passed} passed, {len(failed)} failed, {skipped} skipped")
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
