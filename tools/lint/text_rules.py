#!/usr/bin/env python3
"""text_rules.py [ROOT]: sizes of files, owners of TODOs, paths of somebody's machine, tests that do not run.

Lists the notes of things to do; fails on one without a name and on every other rule broken.
"""

import pathlib
import re
import sys

import sources

MOST_LINES = {".h": 200, ".cpp": 400}
NOTE = re.compile(r"\b(TO" r"DO|FIX" r"ME)\b(\([a-z][\w.-]*\):)?")
MACHINE_PATH = re.compile(r"""(?<![\w.$}~*/-])/(home|root|work|Users|mnt|tmp)/[\w.]""")
IDLE_TEST = re.compile(r"GTEST_" r"SKIP|DIS" r"ABLED_")


def check(root):
    """(faults, notes) of the tree."""
    root = pathlib.Path(root).resolve()
    faults, notes = [], []
    for path in sources.text_files(root):
        relative = path.relative_to(root).as_posix()
        lines = path.read_text(encoding="utf-8").split("\n")
        most = MOST_LINES.get(path.suffix)
        if most and len(lines) - 1 > most:
            faults.append(f"{relative}: {len(lines) - 1} lines, at most {most}")
        if path.suffix == ".h" and lines[0] != "#pragma once":
            faults.append(f"{relative}:1: a header starts with #pragma once")
        for number, line in enumerate(lines, 1):
            where = f"{relative}:{number}: {line.strip()}"
            note = NOTE.search(line)
            if note and note[2] and note[1].startswith("TO"):
                notes.append(where)
            elif note and path.suffix != ".md":
                faults.append(f"{where}\n  a note to do names who will: TO" "DO(name): ...")
            if MACHINE_PATH.search(line):
                faults.append(f"{where}\n  a path of one machine")
            if path.suffix == ".cpp" and IDLE_TEST.search(line):
                faults.append(f"{where}\n  a test that does not run")
    return faults, notes


if __name__ == "__main__":
    found, owned = check(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parents[2])
    print("\n".join(owned + found) or "texts keep the rules")
    sys.exit(1 if found else 0)
