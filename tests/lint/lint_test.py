#!/usr/bin/env python3
"""The checks of tools/lint find what they are there to find, and nothing in a tree that keeps the rules."""

import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "tools" / "lint"))
import include_direction  # noqa: E402
import text_rules  # noqa: E402


class Tree(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


class IncludeDirection(Tree):
    def faults(self, name, include):
        self.write(name, f"#pragma once\n#include {include}\n")
        return include_direction.check(self.root)

    def test_lets_rooms_include_those_before_them(self):
        self.write("tf/time.h", "#pragma once\n#include <glm/vec3.hpp>\n#include <vector>\n")
        self.write("scenegraph/layer.h", '#pragma once\n#include <osg/Group>\n#include "tf/time.h"\n')
        self.write("viewer/view.cpp", '#include <QWidget>\n#include "nodes/registry.h"\n')
        self.write("tools/cli/view.cpp", '#include "viewer/window/inspector.h"\n')
        self.write("tests/viewer/view_test.cpp", '#include <QTest>\n#include "tools/ingest/recording.h"\n')
        self.assertEqual(include_direction.check(self.root), [])

    def test_finds_an_include_against_the_direction(self):
        self.assertEqual(
            self.faults("tf/bad.h", '"scenegraph/layer.h"'),
            ["tf/bad.h:2: tf/ must not include scenegraph/ (scenegraph/layer.h)"],
        )

    def test_finds_an_indented_include_against_the_direction(self):
        self.assertEqual(len(self.faults("nodes/grid/bad.cpp", '"viewer/view.h"\n  # include "tools/ingest/a.h"')), 2)

    def test_finds_qt_outside_the_viewer(self):
        for room in ("tf", "scenegraph", "nodes", "tools"):
            with self.subTest(room):
                self.assertIn(f"{room}/ must not use Qt", " ".join(self.faults(f"{room}/bad.cpp", "<QString>")))

    def test_finds_a_second_door_to_the_viewer(self):
        self.assertEqual(len(self.faults("tools/osgplugin/bad.cpp", '"viewer/window/inspector.h"')), 1)
        self.assertEqual(len(self.faults("tools/cli/bad.cpp", '"viewer/view.h"')), 2)

    def test_finds_a_library_that_a_room_does_not_use(self):
        self.assertEqual(len(self.faults("scenegraph/bad.cpp", "<nlohmann/json.hpp>")), 1)

    def test_finds_osg_behind_a_header(self):
        self.write("scenegraph/layer.h", "#pragma once\n#include <osg/Group>\n")
        self.write("scenegraph/scene.h", '#pragma once\n#include "scenegraph/layer.h"\n')
        self.assertEqual(
            self.faults("tools/ingest/bad.h", '"scenegraph/scene.h"'),
            ["tools/ingest/bad.h: reaches OpenSceneGraph through scenegraph/scene.h -> scenegraph/layer.h -> osg/Group"],
        )


class TextRules(Tree):
    def faults(self, name, text):
        self.write(name, text)
        return text_rules.check(self.root)[0]

    def test_lets_a_good_tree_be(self):
        self.write("tf/time.h", "#pragma once\n" + "\n" * 199)
        self.write("tf/time.cpp", "// " + "TO" + "DO(ada): finer clock\n" + "\n" * 399)
        self.write("README.md", "~/home/x, https://example.org/work/x, build/tmp/x\n")
        faults, notes = text_rules.check(self.root)
        self.assertEqual(faults, [])
        self.assertEqual(len(notes), 1)

    def test_finds_files_grown_too_long(self):
        self.assertEqual(len(self.faults("tf/time.h", "#pragma once\n" + "\n" * 200)), 1)
        self.assertEqual(len(self.faults("tf/time.cpp", "\n" * 401)), 2)

    def test_finds_a_header_without_its_guard(self):
        self.assertEqual(len(self.faults("tf/time.h", "#include <vector>\n")), 1)

    def test_finds_a_note_nobody_owns(self):
        self.assertEqual(len(self.faults("tf/time.cpp", "// " + "TO" + "DO: later\n")), 1)

    def test_finds_paths_of_one_machine(self):
        for path in ("/home" + "/ada/x.mcap", "(/tmp" + "/x)", '"/work' + '/y"'):
            with self.subTest(path):
                self.assertEqual(len(self.faults("tools/run", path + "\n")), 1)

    def test_finds_tests_that_do_not_run(self):
        self.assertEqual(len(self.faults("tests/tf/a_test.cpp", "TEST(A, DIS" + "ABLED_B) {}\n")), 1)


if __name__ == "__main__":
    unittest.main()
