#!/usr/bin/env python3
"""compile_commands.py BUILD OUT: writes BUILD's compile commands to OUT/compile_commands.json with an entry for each
source by itself, where the build compiles several in one batch (CMake's unity builds)."""

import json
import pathlib
import re
import sys


def alone(entry):
    """The entry, or one for each source that a batch includes."""
    batch = pathlib.Path(entry["file"])
    if not re.fullmatch(r"unity_\d+_cxx\.cxx", batch.name):
        yield entry
        return
    for source in re.findall(r'^#include "(.*)"$', batch.read_text(), re.MULTILINE):
        yield entry | {"file": source, "command": entry["command"].replace(str(batch), source)}


def main(build, out):
    entries = json.loads((pathlib.Path(build) / "compile_commands.json").read_text())
    pathlib.Path(out).mkdir(parents=True, exist_ok=True)
    text = json.dumps([each for entry in entries for each in alone(entry)], indent=0)
    (pathlib.Path(out) / "compile_commands.json").write_text(text)


if __name__ == "__main__":
    main(*sys.argv[1:])
