#!/usr/bin/env python3
"""truth_test.py PROGRAM DATA CASE: what `stillframe` says of a recording, held against answers computed by other code.

CASE is the name of a file in DATA/truth (without .json), or "containers" for the same recording in different MCAP
layouts, or "listing" for every recording there is.
"""

import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

NO_TRANSFORM = 3


class Program:
    """The program under test."""

    path = pathlib.Path()
    data = pathlib.Path()

    @classmethod
    def run(cls, *arguments):
        """(exit code, parsed standard output or None, standard error)."""
        command = [str(cls.path), *map(str, arguments)]
        done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=120, check=False)
        try:
            answer = json.loads(done.stdout)
        except json.JSONDecodeError:
            answer = None
        return done.returncode, answer, done.stderr

    @classmethod
    def info(cls, recording, *options):
        code, answer, errors = cls.run("info", recording, "--json", *options)
        if code != 0 or answer is None:
            raise AssertionError(f"info {recording}: exit code {code}: {errors}")
        return answer


def by_name(rows):
    return {row["name"]: row for row in rows}


def schema_of(topic):
    return topic["schema"].replace("/msg/", "/")


class TruthCase(unittest.TestCase):
    """One recording and its reference answers."""

    case = ""

    @classmethod
    def setUpClass(cls):
        cls.truth = json.loads((Program.data / "truth" / f"{cls.case}.json").read_text(encoding="utf-8"))
        cls.recording = Program.data / "mcap_made" / cls.truth["file"]
        cls.answer = Program.info(cls.recording, "--tf-time", "header")

    def tf(self):
        """Reference answers about TF; empty where there are none."""
        return self.truth.get("tf", {})

    def test_topics(self):
        said = by_name(self.answer["topics"])
        self.assertEqual(sorted(said), sorted(self.truth["topics"]))
        for name, topic in self.truth["topics"].items():
            with self.subTest(name):
                self.assertEqual(schema_of(said[name]), topic["type"].replace("/msg/", "/"))
                self.assertEqual(said[name]["encoding"], topic["encoding"])
                self.assertEqual(said[name]["count"], topic["count"])
                self.assertEqual(said[name]["first_ns"], int(topic["first_log_ns"]))
                self.assertEqual(said[name]["last_ns"], int(topic["last_log_ns"]))

    def test_time_range(self):
        topics = self.truth["topics"].values()
        self.assertEqual(self.answer["start_ns"], min(int(topic["first_log_ns"]) for topic in topics))
        self.assertEqual(self.answer["end_ns"], max(int(topic["last_log_ns"]) for topic in topics))

    def test_frames(self):
        tf = self.tf()
        if not tf:
            # No answers about Foxglove's transforms: that there are frames is all that is known.
            types = [topic["type"] for topic in self.truth["topics"].values()]
            has_transforms = any(name.startswith("foxglove.FrameTransform") for name in types)
            self.assertEqual(bool(self.answer["frames"]), has_transforms)
            return
        said = by_name(self.answer["frames"])
        self.assertEqual(sorted(said), sorted(tf["frames"]))
        for name in tf["frames"]:
            with self.subTest(name):
                self.assertEqual(said[name]["parent"], tf["parents"].get(name))
                self.assertEqual(said[name]["samples"], tf["samples_per_edge"].get(name, 0))
                if name in tf["parents"]:
                    first, last = tf["stamp_range_per_edge_ns"][name]
                    self.assertEqual([said[name]["first_ns"], said[name]["last_ns"]], [int(first), int(last)])

    def test_refused_transforms_are_problems(self):
        tf = self.tf()
        refused = sum(len(tf.get(kind, [])) for kind in ("rejected", "non_finite_or_zero_quaternion", "cycle_closing"))
        codes = ("ReparentConflict", "SelfLoop", "Cycle", "NotFinite", "ZeroQuaternion", "EmptyFrameName")
        said = sum(problem["count"] for problem in self.answer["problems"] if any(c in problem["code"] for c in codes))
        self.assertEqual(said > 0, refused > 0, self.answer["problems"])

    def test_lookups(self):
        for lookup in self.tf().get("zoh_lookups", []):
            target, source, time = lookup["target"], lookup["source"], lookup["t_ns"]
            with self.subTest(target=target, source=source, time=time):
                code, said, errors = Program.run(
                    "tf", self.recording, "--target", target, "--source", source, "--time", time, "--tf-time", "header", "--json"
                )
                self.assertEqual(code, 0, errors)
                self.assert_near(said["translation"], lookup["translation"])
                sign = math.copysign(1.0, sum(a * b for a, b in zip(said["rotation"], lookup["rotation_xyzw"])))
                self.assert_near([sign * part for part in said["rotation"]], lookup["rotation_xyzw"])

    def assert_near(self, said, expected):
        """The answers carry nine digits: a millionth of the largest part, or a billionth absolute."""
        allowed = max(1e-9, 1e-6 * max(map(abs, expected)))
        self.assertEqual(len(said), len(expected))
        for a, b in zip(said, expected):
            self.assertLessEqual(abs(a - b), allowed, f"{said} is not {expected}")

    def test_lookups_that_must_fail_say_why(self):
        tf = self.tf()
        if not tf:
            return
        child, parent = next(iter(tf["parents"].items()))
        first = int(tf["stamp_range_per_edge_ns"][child][0])
        for source, time, expected in ((child, first - 1, "NoSampleAtTime"), ("no such frame", first, "UnknownSource")):
            code, said, _ = Program.run(
                "tf", self.recording, "--target", parent, "--source", source, "--time", time, "--tf-time", "header", "--json"
            )
            self.assertEqual(code, NO_TRANSFORM)
            self.assertEqual(said["error"]["code"], expected)
            self.assertTrue(said["error"]["message"])

    def test_clouds(self):
        for name, topic in self.truth["topics"].items():
            if topic["type"] != "sensor_msgs/PointCloud2" or topic["encoding"] != "cdr":
                continue
            for sample in topic["samples"]:
                with self.subTest(topic=name, time=sample["log_ns"]), tempfile.TemporaryDirectory() as folder:
                    picture = pathlib.Path(folder) / "cloud.png"
                    options = ("--time", sample["log_ns"], "--fixed-frame", sample["frame_id"], "--size", "160x120")
                    code, said, errors = Program.run(
                        "render", self.recording, "--out", picture, "--only", "--layer", name, *options, "--json"
                    )
                    self.assertEqual(code, 0, errors)
                    self.assertTrue(picture.is_file())
                    self.assertEqual([layer["topic"] for layer in said["layers"]], [name])
                    layer = said["layers"][0]
                    self.assertIn(layer["status"]["level"], ("ok", "info"), layer)
                    self.assertEqual(layer["frame"], sample["frame_id"])
                    self.assertEqual(layer["counts"]["points"], sample["finite_points"])


class Containers(unittest.TestCase):
    """One recording laid out in every way MCAP allows says the same."""

    folder = property(lambda self: Program.data / "mcap_made" / "container_dev")

    def test_layouts_agree(self):
        expected = Program.info(self.folder / "lz4_small_chunks.mcap")
        self.assertEqual({topic["name"]: topic["count"] for topic in expected["topics"]}, {"/tf": 2499, "/tf_static": 1})
        self.assertTrue(expected["frames"])
        for name in ("attachments", "chunked_no_summary", "old_type_names", "unchunked_noindex"):
            with self.subTest(name):
                said = Program.info(self.folder / f"{name}.mcap")
                for key in ("start_ns", "end_ns", "frames"):
                    self.assertEqual(said[key], expected[key])
                facts = [
                    [(t["name"], schema_of(t), t["type"], t["count"], t["first_ns"], t["last_ns"]) for t in answer["topics"]]
                    for answer in (said, expected)
                ]
                self.assertEqual(facts[0], facts[1])

    def test_truncated_file_is_read_as_far_as_it_goes(self):
        said = Program.info(self.folder / "BAD_truncated_60pct.mcap")
        count = by_name(said["topics"])["/tf"]["count"]
        self.assertTrue(1554 <= count < 2499, count)
        self.assertIn("trunc", " ".join(problem["code"] for problem in said["problems"]).lower())

    def test_empty_recording_is_no_error(self):
        said = Program.info(self.folder / "zero_messages.mcap")
        self.assertEqual(sum(topic["count"] for topic in said["topics"]), 0)
        self.assertEqual(said["frames"], [])


class Listing(unittest.TestCase):
    """Every recording is listed with the topics and counts that an independent reader found."""

    def rows(self):
        table = (Program.data.parent / "DATA.md").read_text(encoding="utf-8")
        for line in table.splitlines():
            cells = line.split("|")
            if len(cells) == 5 and cells[1].strip().endswith(".mcap"):
                yield cells[1].strip(), re.findall(r"(\S+) (\S+) \((\w+), (\d+)\)", cells[3])

    def test_every_recording(self):
        rows = list(self.rows())
        self.assertGreater(len(rows), 40)
        for name, topics in rows:
            with self.subTest(name):
                answer = Program.info(Program.data / name)
                said = by_name(answer["topics"])
                for topic, schema, encoding, count in topics:
                    self.assertEqual((schema_of(said[topic]), said[topic]["encoding"]), (schema, encoding))
                    if "BAD_truncated" not in name:
                        self.assertEqual(said[topic]["count"], int(count), topic)
                for problem in answer["problems"]:
                    self.assertTrue(problem["code"] and problem["message"] and problem["count"] > 0, problem)


def main():
    Program.path = pathlib.Path(sys.argv[1])
    Program.data = pathlib.Path(sys.argv[2])
    TruthCase.case = sys.argv[3]
    chosen = {"containers": Containers, "listing": Listing}.get(sys.argv[3], TruthCase)
    tests = unittest.defaultTestLoader.loadTestsFromTestCase(chosen)
    sys.exit(not unittest.TextTestRunner().run(tests).wasSuccessful())


if __name__ == "__main__":
    main()
