#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The layering check has to find what it is there for."""

import pathlib
import tempfile
import unittest

from check_layering import check


def problems_of(files):
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            path = pathlib.Path(folder) / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        return check(pathlib.Path(folder))


class CheckLayering(unittest.TestCase):
    def test_allowed_edges_pass(self):
        self.assertEqual(
            problems_of({
                "core/base/error.h": "#include <string>\n",
                "core/camera/model.h": '#include "core/base/error.h"\n',
                "mapping/mapper.h": '#include "core/camera/model.h"\n',
                "tools/map.cpp": '#include "mapping/mapper.h"\n#include "version.h"\n',
                "tests/map_test.cpp": '#include "tools/tool.h"\n#include "tests/support/x.h"\n',
                "tools/tool.h": "",
            }),
            [],
        )

    def test_edge_upwards_is_named_with_file_and_line(self):
        problems = problems_of({"core/base/error.h": '\n  #  include <mapping/mapper.h>\n', "mapping/mapper.h": ""})
        self.assertEqual(problems, ["core/base/error.h:2: 'core' must not include 'mapping' (mapping/mapper.h)"])

    def test_no_library_includes_tests(self):
        problems = problems_of({"mapping/mapper.cpp": '#include "tests/support/x.h"\n'})
        self.assertEqual(problems, ["mapping/mapper.cpp:1: 'mapping' must not include 'tests' (tests/support/x.h)"])

    def test_sideways_edge_that_the_table_lacks(self):
        problems = problems_of({"semantic/a.h": '#include "registration/b.h"\n', "registration/b.h": ""})
        self.assertEqual(problems, ["semantic/a.h:1: 'semantic' must not include 'registration' (registration/b.h)"])

    def test_cycle_of_sub_folders(self):
        problems = problems_of({
            "mapping/graph/a.h": '#include "mapping/volume/b.h"\n',
            "mapping/volume/b.h": "",
            "mapping/volume/c.cpp": '#include "mapping/odometry/d.h"\n',
            "mapping/odometry/d.h": '#include "mapping/graph/a.h"\n',
        })
        self.assertEqual(len(problems), 1)
        self.assertIn("in a circle: mapping/graph/a.h:1 includes mapping/volume; mapping/volume/c.cpp:1 includes mapping/odometry; "
                      "mapping/odometry/d.h:1 includes mapping/graph", problems[0])

    def test_missing_file(self):
        problems = problems_of({"core/a.h": '#include "core/b.h"\n'})
        self.assertEqual(problems, ["core/a.h:1: there is no file 'core/b.h'; include from the repository's root"])

    def test_comments_and_strings_are_no_includes(self):
        self.assertEqual(problems_of({"core/a.h": '// #include "mapping/b.h"\n///     #include "mapping/b.h"\n'}), [])


if __name__ == "__main__":
    unittest.main()
