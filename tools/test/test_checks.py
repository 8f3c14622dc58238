#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Each structural check rejects a tree with the fault it is meant to find, and passes a sound one."""

import os
import subprocess
import sys
import tempfile
import unittest

TOOLS = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, TOOLS)
import check_sizes  # noqa: E402

FLOORS = "buckens_module(base 0)\nbuckens_module(fem 2)\nbuckens_module(loads 2)\n"
SOUND = {
    "src/CMakeLists.txt": FLOORS,
    "src/buckens/base/errors.h": "#pragma once\n",
    "src/buckens/fem/beam.h": '#pragma once\n#include "buckens/base/errors.h"\n',
    "src/buckens/fem/test/beam_test.cpp": '#include "buckens/loads/force.h"\n',
    "src/buckens/loads/force.h": "#pragma once\n",
}


def run_check(script, files):
    """Exit code and output of a check on a tree made of these files."""
    with tempfile.TemporaryDirectory() as root:
        for name, text in files.items():
            path = os.path.join(root, name)
            os.makedirs(os.path.dirname(path), exist_ok=True)
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
        command = ["bash"] if script.endswith(".sh") else [sys.executable]
        done = subprocess.run(command + [os.path.join(TOOLS, script), root],
                              capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr


class Checks(unittest.TestCase):
    def expect(self, script, changes, *words):
        """The sound tree with these changes is rejected with these words, or passes if there are none."""
        status, output = run_check(script, {**SOUND, **changes})
        self.assertEqual(status, 1 if words else 0, output)
        for word in words:
            self.assertIn(word, output)


class Equations(Checks):
    THEORY = {"docs/theory/01-kinematics.md": "$$\ns = s_0 \\tag*{FM (1), (2)}\n$$\n\n"
                                           "$$\nf = F t \\tag{L1}\n$$\n\nFM (22)–(24), (L3)\n"}

    def test_explained_tags_pass(self):
        self.expect("check_equations.py", {
            **self.THEORY, "src/buckens/fem/beam.h": "#pragma once\n// FM (2), (23) and eq. (L1)\n"})

    def test_equation_that_no_page_explains(self):
        self.expect("check_equations.py",
                    {**self.THEORY, "src/buckens/fem/beam.h": "#pragma once\n// FM (1), (25)\n"},
                    "src/buckens/fem/beam.h:2: FM (25) is explained in no page")

    def test_equation_that_the_paper_does_not_have(self):
        self.expect("check_equations.py",
                    {**self.THEORY, "src/buckens/fem/beam.h": "#pragma once\n// FM (58)\n"},
                    "beam.h:2: FM (58): the paper has equations 1 to 57")

    def test_label_that_does_not_exist(self):
        self.expect("check_equations.py",
                    {**self.THEORY, "src/buckens/fem/beam.h": "#pragma once\n// eq. (L2)\n"},
                    "beam.h:2: eq. (L2) labels no equation")

    def test_a_mention_is_no_label(self):
        self.expect("check_equations.py",
                    {**self.THEORY, "src/buckens/fem/beam.h": "#pragma once\n// eq. (L3)\n"},
                    "beam.h:2: eq. (L3) labels no equation")


class Floors(Checks):
    def test_sound_tree_passes(self):
        self.expect("check_floors.py", {})

    def test_higher_floor(self):
        self.expect("check_floors.py",
                    {"src/buckens/base/errors.h": '#include "buckens/fem/beam.h"\n'},
                    'src/buckens/base/errors.h:1: "base" (floor 0) must not include "fem"')

    def test_sibling(self):
        self.expect("check_floors.py",
                    {"src/buckens/fem/beam.h": '\n#include "buckens/loads/force.h"\n'},
                    'beam.h:2: "fem" (floor 2) must not include "loads" (floor 2)')

    def test_rooms(self):
        rooms = {"src/buckens/fem/line/bar.h": '#pragma once\n#include "buckens/base/errors.h"\n',
                 "src/buckens/fem/line/bar.cpp": '#include "buckens/fem/line/bar.h"\n',
                 "src/buckens/fem/beam.h": '#pragma once\n#include "buckens/fem/line/bar.h"\n'}
        self.expect("check_floors.py", rooms)
        self.expect("check_floors.py",
                    {**rooms, "src/buckens/loads/force.h":
                     '#pragma once\n#include "buckens/fem/line/bar.h"\n'},
                    'force.h:2: "loads" (floor 2) must not include "fem" (floor 2)')
        self.expect("check_floors.py", {"src/buckens/fem/line/test/bar_test.cpp": ""},
                    "bar_test.cpp: at most src/buckens/<module>/<room>/")

    def test_circle_of_files(self):
        self.expect("check_floors.py",
                    {"src/buckens/fem/a.h": '#include "buckens/fem/b.h"\n',
                     "src/buckens/fem/b.h": '#include "buckens/fem/a.h"\n'},
                    "files include each other in a circle", "fem/a.h")

    def test_circle_of_modules(self):
        self.expect("check_floors.py",
                    {"src/buckens/fem/x.h": '#include "buckens/loads/force.h"\n',
                     "src/buckens/loads/y.h": '#include "buckens/fem/beam.h"\n'},
                    "modules include each other in a circle: fem -> loads -> fem")

    def test_unknown_module_missing_file_and_short_path(self):
        self.expect("check_floors.py", {"src/buckens/new/a.h": ""}, '"new" has no floor')
        self.expect("check_floors.py",
                    {"src/buckens/fem/a.h": '#include "buckens/base/gone.h"\n'}, "no such file")
        self.expect("check_floors.py", {"src/buckens/fem/a.h": '#include "beam.h"\n'},
                    "write the path from src/")

    def test_comment_is_no_include(self):
        self.expect("check_floors.py",
                    {"src/buckens/fem/a.cpp": '// text\n/*\n#include "buckens/loads/force.h"\n*/\n'})

    def test_headers_stand_alone(self):
        self.expect("check_floors.py", {"src/buckens/fem/a.h": "// text\n"},
                    "a.h: a header needs `#pragma once`")
        for text in ('#include <string>\n#include "buckens/fem/beam.h"\n',
                     '#include "buckens/base/errors.h"\n#include "buckens/fem/beam.h"\n', ""):
            self.expect("check_floors.py", {"src/buckens/fem/beam.cpp": text},
                        'include "buckens/fem/beam.h" first')
        self.expect("check_floors.py", {
            "src/buckens/fem/beam.cpp": '// text\n#include "buckens/fem/beam.h"\n#include <a>\n'})


class Streams(Checks):
    def test_each_forbidden_call(self):
        for statement in ("std::cout << 1;", "std::cerr << 1;", 'printf("a");', "std::abort();",
                          'fprintf(stderr, "a");', 'fmt::print("a");', "exit(1);",
                          "std::terminate();", "int i = rand();", "auto m = Matrix3d::Random();",
                          "std::random_device d;", 'std::setlocale(LC_ALL, "");',
                          "std::locale::global(std::locale());"):
            self.expect("check_streams.py",
                        {"src/buckens/fem/a.cpp": f"void f() {{\n  {statement}\n}}\n"},
                        "src/buckens/fem/a.cpp:2")

    def test_innocent_text_passes(self):
        self.expect("check_streams.py", {
            "src/buckens/fem/a.cpp": '// std::cout, abort()\nauto s = "exit(1) printf(";\n'
                                     'int n = std::snprintf(b, 2, "x"); pool.exit(); strand(1);\n',
            "src/buckens/fem/test/a_test.cpp": "void f() { std::cout << 1; }\n",
            "apps/cli/main.cpp": "void f() { std::cout << 1; }\n"})


class Sizes(Checks):
    def test_long_file(self):
        self.expect("check_sizes.py", {"src/buckens/fem/a.h": "//\n" * 601}, "a.h: 601 lines")
        status, output = run_check("check_sizes.py", {"src/buckens/fem/a.h": "//\n" * 301})
        self.assertEqual((status, "warning: src/buckens/fem/a.h: 301" in output), (0, True))

    def test_long_functions(self):
        body = "  x();\n" * 59
        for head in ("int f(int a) {", "Foo::Foo(int a) : a_{a}, b_(2) {",
                     "auto Foo::g() const -> int {", "void operator()(struct S s) noexcept {",
                     "TEST(Beam, Mass) {"):
            text = f"namespace a {{\nnamespace {{\n\n{head}\n{body}}}\n}}\n}}\n"
            self.expect("check_sizes.py", {"src/buckens/fem/a.cpp": text}, "a.cpp:4: function",
                        "has 61 lines")
            shorter = text.replace("  x();\n", "", 1)
            self.expect("check_sizes.py", {"src/buckens/fem/a.cpp": shorter})
        self.expect("check_sizes.py", {"tools/a.py": "def f():\n" + "    x()\n" * 60},
                    "tools/a.py:1: function f has 61 lines")

    def test_method_in_class_is_found_and_class_is_no_function(self):
        methods = "  int f() {\n    return 1;\n  }\n" * 30
        self.assertEqual([f[2] for f in check_sizes.cpp_functions(
            "template <class T>\nclass A : public B<T> {\n public:\n" + methods + "};\n")],
            [3] * 30)

    def test_tables_and_lambdas(self):
        table = "const std::map<int, int> kTable = {\n" + "    {1, 2},\n" * 80 + "};\n"
        self.assertEqual(check_sizes.cpp_functions(table), [])
        text = "int f() {\n  auto g = [&](int i) {\n    return i;\n  };\n  return g(1);\n}\n"
        self.assertEqual([(f[0], f[2]) for f in check_sizes.cpp_functions(text)], [("f", 6)])


class Pages(Checks):
    INDEX = {"docs/README.md": "[a](a.md) [examples](tutorials/README.md)\n",
             "docs/a.md": "# A b, c\n\n## D `e`\n\n[itself](#a-b-c) [out](https://example.org/x)\n",
             "docs/tutorials/README.md": "[fork](../../examples/fork/README.md)\n",
             "examples/fork/README.md": "[d](../../docs/a.md#d-e), `docs/a.md`, `tests/NAME_fuzz.cpp`\n"}

    def expect_pages(self, changes, *words):
        self.expect("check_pages.py", {**self.INDEX, **changes}, *words)

    def test_sound_pages_pass(self):
        self.expect_pages({})
        self.expect_pages({"docs/a.md": "# A b, c\n\n```\n[no](link.md) `docs/no.md`\n```\n## D e\n"})

    def test_link_heading_picture_and_path_that_do_not_exist(self):
        self.expect_pages({"examples/fork/README.md": "\n[d](../../docs/b.md)\n"},
                          "examples/fork/README.md:2: the link to ../../docs/b.md leads nowhere")
        self.expect_pages({"examples/fork/README.md": "[d](../../docs/a.md#f)\n"},
                          "docs/a.md has no heading #f")
        self.expect_pages({"examples/fork/README.md": "![p](p.png)\n"}, "p.png leads nowhere")
        self.expect_pages({"examples/fork/README.md": "see `docs/b.md`\n"}, "there is no docs/b.md")

    def test_page_and_example_that_nothing_lists(self):
        self.expect_pages({"docs/b.md": ""}, "docs/README.md: does not lead to docs/b.md")
        self.expect_pages({"examples/door/door.yaml": ""}, "does not lead to examples/door/README.md")

    def test_torn_table(self):
        table = "| a |\n|---|\n| 1 |\n\n| 2 |\n"
        self.expect_pages({"examples/fork/README.md": table}, "README.md:5: an empty line tears")
        self.expect_pages({"examples/fork/README.md": table.replace("| 2 |", "| b |\n|---|\n| 2 |")})

    def test_formulas(self):
        sound = "A mass $m$ ($m > 0$ no, `$m > 0$`) and $\\lbrace x \\rbrace$:\n\n$$\n\\text{Stoß} \\\\ a \\tag{L1}\n$$\n"
        self.expect_pages({"examples/fork/README.md": sound.replace("m > 0$ no", "m \\gt 0$ yes")})
        self.expect_pages({"examples/fork/README.md": sound}, "README.md:1: `>` in a formula may get lost")
        for text, words in (("a\n\n$$\n\\{x\\}\n$$\n", "README.md:3: `\\{` in a formula"),
                            ("$ω$\n", "README.md:1: `ω` in a formula"),
                            ("\n| $|x|$ | 1 |\n", "README.md:2: | in a formula divides"),
                            ("non-$x$\n", "README.md:1: a formula begins after a space"),
                            ("\n$$x = 1$$\n", "README.md:2: $$ stands on a line of its own"),
                            ("$$\nx = 1\n", "README.md:1: $$ stands on a line of its own")):
            self.expect_pages({"examples/fork/README.md": text}, words)

    def test_machine_paths_and_unfinished_marks(self):
        for text, words in (("# see /ho" "me/me/x", "one machine"), ("# TO" "DO later", "unfinished")):
            self.expect_pages({"tools/a.py": text + "\n"}, "tools/a.py:1:", words)
        self.expect_pages({"tools/a.py": "# a home/me, TODOS, mkdtemp('aXXXXXX')\n"})


class Format(Checks):
    def test_format(self):
        style = {".clang-format": "BasedOnStyle: Google\n"}
        self.expect("check_format.sh", style)
        self.expect("check_format.sh", {**style, "src/buckens/fem/a.h": "int   a ;\n"}, "a.h:1")


if __name__ == "__main__":
    unittest.main()
