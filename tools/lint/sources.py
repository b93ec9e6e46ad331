"""Which files of the tree the checks look at."""

import pathlib

ROOMS = ("tf", "scenegraph", "nodes", "viewer", "tools")
CODE_SUFFIXES = (".h", ".cpp")
TEXT_SUFFIXES = CODE_SUFFIXES + (".glsl", ".vert", ".frag", ".geom", ".comp", ".py", ".cmake", ".in", ".md", ".txt", ".json", "")


def walk(root):
    """Every file below root that is neither built, generated nor git's own, sorted."""
    for path in sorted(root.iterdir()):
        if path.is_dir():
            if path.name in (".git", ".cache", "__pycache__") or path.name.startswith("build"):
                continue
            yield from walk(path)
        elif path.is_file() and path.name != ".git":
            yield path


def code_files(root):
    """C++ headers and sources of the rooms and of the tests."""
    root = pathlib.Path(root)
    for room in ROOMS + ("tests",):
        if (root / room).is_dir():
            yield from (path for path in walk(root / room) if path.suffix in CODE_SUFFIXES)


def text_files(root):
    """Everything written by hand as text; data and pictures are left out by their suffix."""
    return (path for path in walk(pathlib.Path(root)) if path.suffix in TEXT_SUFFIXES)
