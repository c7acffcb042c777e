#!/usr/bin/env python3
"""Checks renderers/gl/records.py: what it makes of a record, and what it refuses. Usage: check_records.py ROOT"""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(sys.argv.pop(1)) / "renderers" / "gl" / "records.py"


class Records(unittest.TestCase):
    def run_on(self, glsl):
        """(exit status, messages, header) of a tree with one shader."""
        with tempfile.TemporaryDirectory() as folder:
            root, out = Path(folder), Path(folder) / "out"
            (root / "shaders").mkdir()
            (root / "shaders" / "a.glsl").write_text(glsl, encoding="utf-8")
            run = subprocess.run([sys.executable, SCRIPT, root, out], capture_output=True, text=True, check=False)
            header = out / "shaders" / "a.glsl.h"
            return run.returncode, run.stderr, header.read_text(encoding="utf-8") if header.exists() else None

    def test_fields_keep_order_type_and_comment(self):
        status, messages, header = self.run_on(
            "/// Seen by both.\n// C++: ir::here::Thing\nstruct T {\n    vec3 place_ws;  // m\n"
            "    uint sample_, words[4];  // last\n};\n")
        self.assertEqual((status, messages), (0, ""))
        self.assertIn("namespace ir::here {", header)
        self.assertIn("/// Seen by both.\nstruct Thing {", header)
        self.assertIn("    glm::vec3 place_ws{};  ///< m\n    std::uint32_t sample{};\n"
                      "    std::array<std::uint32_t, 4> words{};  ///< last\n"
                      "    IR_FIELDS(place_ws, sample, words)\n", header)

    def test_gaps_of_std430_are_refused(self):
        for members in ["float x;\n    vec3 place;\n    float y", "vec3 place", "vec3 places[2]"]:
            status, messages, _ = self.run_on(f"// C++: ir::A\nstruct T {{\n    {members};\n}};\n")
            self.assertEqual(status, 1, members)
            self.assertIn("std430 leaves", messages)

    def test_blocks_are_records_too(self):
        header = self.run_on("// C++: ir::A\nlayout(std430) readonly buffer Things {\n    uint x;\n} things;\n")[2]
        self.assertIn("struct A {\n    std::uint32_t x{};\n", header)

    def test_records_hold_records(self):
        header = self.run_on("// C++: ir::A\nstruct InA {\n    float x;\n};\n\n"
                             "// C++: ir::B\nstruct InB {\n    InA first, second;\n};\n")[2]
        self.assertIn("    A first{};\n    A second{};\n", header)

    def test_structs_without_a_mark_stay_in_glsl(self):
        self.assertEqual(self.run_on("struct T {\n    float x;\n};\n"), (0, "", None))

    def test_constants_are_those_of_the_shader(self):
        status, messages, header = self.run_on(
            "/// Lifted by as much.\n// C++: ir::here::lift\nconst float LIFT = 4e-6;\n"
            "// C++: ir::here::bit\nconst uint BIT = 0x80000000u;  // the highest\nconst int OTHER = 1;\n")
        self.assertEqual((status, messages), (0, ""))
        self.assertIn("/// Lifted by as much.\ninline constexpr float lift = 4e-6f;\n", header)
        self.assertIn("inline constexpr std::uint32_t bit = 0x80000000u;\n", header)
        self.assertNotIn("OTHER", header)
        status, messages, _ = self.run_on("// C++: ir::here::a\nconst float A = 2.0 * PI;\n")
        self.assertEqual(status, 1)
        self.assertIn("the constant 'A' is for C++, too, so its value is a number, not '2.0 * PI'", messages)

    def test_all_constants_of_a_declaration_keep_their_names(self):
        status, messages, header = self.run_on(
            "// Bits.\n// C++: ir::here::*\nconst uint LEG_MAP = 0xffffu, LEG_ALONG = 1u << 16,  // with it\n"
            "           LEG_SHIFT = 18u;  // of the rest\n")
        self.assertEqual((status, messages), (0, ""))
        self.assertIn("/// Bits.\ninline constexpr std::uint32_t leg_map = 0xffffu;\n"
                      "inline constexpr std::uint32_t leg_along = 1u << 16;  ///< with it\n"
                      "inline constexpr std::uint32_t leg_shift = 18u;  ///< of the rest\n", header)
        status, messages, _ = self.run_on("// C++: ir::here::*\nconst int A_B = 1, A_C = A_B + 1;\n")
        self.assertEqual(status, 1)
        self.assertIn("the constant 'A_C' is for C++, too", messages)

    def test_a_semicolon_in_a_comment_cuts_no_list(self):
        status, messages, _ = self.run_on("// C++: ir::here::*\nconst int A_B = 1,  // this; that\n    A_C = 2;\n")
        self.assertEqual(status, 1)
        self.assertIn("shaders/a.glsl: the comment '// this;' has a semicolon", messages)

    def test_arrays_of_floats_are_constants_too(self):
        header = self.run_on("// C++: ir::here::*\nconst float FEW[2] = float[2](0.5, 0.25);\n")[2]
        self.assertIn("inline constexpr std::array<float, 2> few{0.5f, 0.25f};\n", header)
        status, messages, _ = self.run_on("// C++: ir::here::*\nconst float FEW[1] = float[1](1.0 / 3.0);\n")
        self.assertEqual(status, 1)
        self.assertIn("so it holds numbers, not '1.0 / 3.0'", messages)

    def test_constants_become_an_enum(self):
        status, messages, header = self.run_on(
            "// C++: enum ir::here::Cause\nconst int CAUSE_LEFT = 0, CAUSE_NOT_SEEN = 3;\n")
        self.assertEqual((status, messages), (0, ""))
        self.assertIn("enum class Cause : std::int32_t {\n    left = 0,\n    not_seen = 3,\n};", header)

    def test_what_cannot_be_read_is_named(self):
        status, messages, _ = self.run_on("// C++: ir::A\nstruct T {\n    double x;\n};\n")
        self.assertEqual(status, 1)
        self.assertIn("shaders/a.glsl: the line 'double x;'", messages)

    def test_a_mark_without_a_struct_is_refused(self):
        status, messages, _ = self.run_on("// C++: ir::A\n\nstruct T {\n    float x;\n};\n")
        self.assertEqual(status, 1)
        self.assertIn("shaders/a.glsl: '// C++: ' stands in the comment right above a struct", messages)


unittest.main()
