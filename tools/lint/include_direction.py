#!/usr/bin/env python3
"""include_direction.py [ROOT]: fails on an include against the direction of the rooms.

Rooms may include themselves and those before them: tf < scenegraph < nodes < viewer < tools; tests may include
everything. A room uses only the third-party libraries listed for it. Some folders must stay free of OpenSceneGraph
also through what they include, because they run where it is not installed. Qt is the viewer's alone; the program
reaches it through one header.
"""

import pathlib
import re
import sys

import sources

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)
OSG = re.compile(r"osg[A-Za-z]*/")
LIBRARIES = {
    "GLM": re.compile(r"glm/"),
    "OpenSceneGraph": OSG,
    "OpenGL": re.compile(r"(GL|EGL|KHR)/"),
    "OpenEXR": re.compile(r"(OpenEXR/|Imath/|Imf|Iex|Imath|half\.h)"),
    "Qt": re.compile(r"Q[A-Z]|Qt"),
    "LZ4": re.compile(r"lz4"),
    "Zstandard": re.compile(r"zstd"),
    "PNG": re.compile(r"png\.h"),
    "Expat": re.compile(r"expat\.h"),
    "libjpeg-turbo": re.compile(r"turbojpeg\.h"),
    "JSON": re.compile(r"nlohmann/"),
    "CLI11": re.compile(r"CLI/"),
    "Draco": re.compile(r"draco/"),
    "assimp": re.compile(r"assimp/"),
    "urdfdom": re.compile(r"urdf_"),
    "protobuf": re.compile(r"google/protobuf/"),
    "Google Benchmark": re.compile(r"benchmark/"),
    "GoogleTest": re.compile(r"(gtest|gmock)/"),
}
ALLOWED = {
    "tf": {"GLM"},
    "scenegraph": {"GLM", "OpenSceneGraph", "OpenGL", "OpenEXR", "PNG", "Expat"},
    "nodes": {"GLM", "OpenSceneGraph", "OpenGL", "Draco", "assimp", "urdfdom", "Zstandard", "LZ4",
              "PNG", "libjpeg-turbo"},
    "viewer": {"GLM", "OpenSceneGraph", "OpenGL", "Qt"},
    "tools": set(LIBRARIES) - {"Qt", "GoogleTest"},
}
WITHOUT_OSG = ("tf", "scenegraph/camera", "scenegraph/layout", "scenegraph/objects", "scenegraph/store", "nodes/images", "nodes/meshes",
               "nodes/points", "nodes/robots", "tools/ingest")
HOST = "tools/host_example/"  # a program of its own, on the installed package and Qt
DOOR_TO_VIEWER = ("tools/cli", "viewer/window/inspector.h")


def includes(path):
    """(quoted, name, line) of every include of a file."""
    text = path.read_text(encoding="utf-8")
    for match in INCLUDE.finditer(text):
        yield match[1] == '"', match[2], text.count("\n", 0, match.start(2)) + 1


def room_of(name):
    room = name.split("/", 1)[0]
    return room if room in sources.ROOMS else None


def osg_behind(root, path, seen):
    """The chain of headers that leads from a file to OpenSceneGraph, or None."""
    for quoted, name, _ in includes(path):
        if not quoted:
            if OSG.match(name):
                return [name]
            continue
        header = root / name
        if header in seen or not header.is_file():
            continue
        seen.add(header)
        chain = osg_behind(root, header, seen)
        if chain:
            return [name] + chain
    return None


def faults_of(root, path):
    relative = path.relative_to(root).as_posix()
    room = room_of(relative)
    if room is None or relative.startswith(HOST):
        return
    for quoted, name, line in includes(path):
        where = f"{relative}:{line}"
        if quoted:
            target = room_of(name)
            if target is None:
                continue
            if sources.ROOMS.index(target) > sources.ROOMS.index(room):
                yield f"{where}: {room}/ must not include {target}/ ({name})"
            if target == "viewer" and room == "tools":
                if not (relative.startswith(DOOR_TO_VIEWER[0] + "/") and name == DOOR_TO_VIEWER[1]):
                    yield f"{where}: tools/ reaches the viewer through {DOOR_TO_VIEWER[1]} in {DOOR_TO_VIEWER[0]}/ only ({name})"
            continue
        for library, pattern in LIBRARIES.items():
            if pattern.match(name) and library not in ALLOWED[room]:
                yield f"{where}: {room}/ must not use {library} (<{name}>)"
    if any(relative.startswith(folder + "/") for folder in WITHOUT_OSG):
        chain = osg_behind(root, path, set())
        if chain:
            yield f"{relative}: reaches OpenSceneGraph through {' -> '.join(chain)}"


def check(root):
    root = pathlib.Path(root).resolve()
    return [fault for path in sources.code_files(root) for fault in faults_of(root, path)]


if __name__ == "__main__":
    found = check(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parents[2])
    print("\n".join(found) or "includes point one way")
    sys.exit(1 if found else 0)
