#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests of the checks: a violation is planted in a temporary tree, and the check must report it."""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).parent
COMPILER = sys.argv.pop() if len(sys.argv) > 1 and not sys.argv[-1].startswith("-") else "c++"


def run(check, *arguments):
    """(exit code, output) of a check."""
    done = subprocess.run([sys.executable, HERE / check, *arguments], capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


class ScratchTree(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)

    def plant(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path


class Includes(ScratchTree):
    def refused(self, file, include, reason):
        self.plant(file, f"#include {include}\n")
        code, output = run("includes.py", self.root)
        self.assertEqual(code, 1, output)
        self.assertIn(f"{file}:1", output)
        self.assertIn(reason, output)

    def allowed(self, file, include):
        self.plant(file, f"#include {include}\n")
        code, output = run("includes.py", self.root)
        self.assertEqual(code, 0, output)

    def test_core_may_not_reach_the_host(self):
        self.plant("host/clock/clock.hpp", "")
        self.refused("common/pharos/pose/solve.cpp", '"host/clock/clock.hpp"', "may not reach host")

    def test_core_may_not_climb_out_by_a_relative_path(self):
        self.plant("host/clock/clock.hpp", "")
        self.refused("common/pharos/pose/solve.cpp", '"../../../host/clock/clock.hpp"', "may not reach host")

    def test_base_may_not_reach_geometry(self):
        self.plant("common/pharos/geometry/pose.hpp", "")
        self.refused("common/pharos/base/ring_buffer.hpp", '"pharos/geometry/pose.hpp"', "may not reach common/pharos/geometry")

    def test_wire_may_not_reach_lighthouse(self):
        self.plant("common/pharos/lighthouse/sweep.hpp", "")
        self.refused("common/pharos/wire/frame.cpp", '"pharos/lighthouse/sweep.hpp"', "may not reach")

    def test_pose_and_lighthouse_do_not_know_each_other(self):
        self.plant("common/pharos/lighthouse/sweep.hpp", "")
        self.refused("common/pharos/pose/solve.cpp", '"pharos/lighthouse/sweep.hpp"', "may not reach")

    def test_host_may_not_reach_tools(self):
        self.plant("tools/support/commands.hpp", "")
        self.refused("host/daemon/loop.cpp", '"tools/support/commands.hpp"', "may not reach tools")

    def test_firmware_may_not_reach_the_host(self):
        self.plant("host/clock/clock.hpp", "")
        self.refused("firmware/app/main.cpp", '"host/clock/clock.hpp"', "may not reach host")

    def test_a_row_does_not_open_the_rooms_in_its_folder(self):
        self.plant("tools/sim/tof/scene.hpp", "")
        self.refused("tools/sim/povray/render.cpp", '"tools/sim/tof/scene.hpp"', "may not reach tools/sim/tof")

    def test_device_and_daemon_do_not_reach_each_other(self):
        self.plant("host/daemon/daemon.hpp", "")
        self.refused("host/device/source.cpp", '"host/daemon/daemon.hpp"', "may not reach host/daemon")

    def test_a_folder_has_a_row_of_its_own(self):
        self.plant("host/novelty/novelty.hpp", "")
        code, output = run("includes.py", self.root)
        self.assertEqual(code, 1, output)
        self.assertIn("host/novelty: no row of its own", output)

    def test_rows_allow_no_cycle(self):
        rules = self.plant("rooms.toml", '[rooms]\n"host/a" = ["host/b"]\n"host/b" = ["host/c"]\n"host/c" = ["host/a"]\n'
                           "[third_party]\n[standard]\nrestricted = []\nallowed = []\n")
        code, output = run("includes.py", self.root, "--rules", rules)
        self.assertEqual(code, 1, output)
        self.assertIn("host/a -> host/b -> host/c -> host/a", output)

    def test_core_may_not_use_the_heap_s_containers(self):
        for header in ("vector", "string", "functional", "memory", "map", "new", "iostream", "chrono", "thread", "mutex"):
            with self.subTest(header):
                self.refused("common/pharos/base/ring_buffer.hpp", f"<{header}>", "portable core")

    def test_core_may_not_use_the_operating_system(self):
        self.refused("common/pharos/wire/port.cpp", "<unistd.h>", "portable core")

    def test_third_party_headers_stay_in_their_adaptor(self):
        for file, header in (("host/daemon/loop.cpp", "opencv2/core.hpp"), ("host/serial/port.cpp", "lcm/lcm-cpp.hpp"),
                             ("host/publish/pose.cpp", "toml++/toml.h"), ("host/record/file.cpp", "spdlog/spdlog.h"),
                             ("host/clock/clock.cpp", "CLI/CLI.hpp"), ("common/pharos/pose/solve.cpp", "opencv2/core.hpp")):
            with self.subTest(header):
                self.refused(file, f"<{header}>", "is not for")
                (self.root / file).unlink()

    def test_what_the_rules_allow_passes(self):
        self.plant("common/pharos/base/ring_buffer.hpp", "#include <array>\n")
        self.plant("host/toml/load.cpp", '#include <toml++/toml.h>\n#include <string>\n')
        self.allowed("common/pharos/geometry/pose.hpp", '"pharos/base/ring_buffer.hpp"')


class Vocabulary(ScratchTree):
    def refused(self, name, text, word):
        self.plant(name, text)
        code, output = run("vocabulary.py", self.root)
        self.assertEqual(code, 1, output)
        self.assertIn(f"'{word}' is retired", output)

    def test_retired_identifiers_are_refused(self):
        for text, word in (("constexpr int kLeastPoints = 3;", "kLeastPoints"), ("constexpr double kMostSpread_rad = 1;", "kMostSpread_rad"),
                           ("int most_sensors = 0;", "most_sensors"), ("double inlier_share = 0;", "inlier_share"),
                           ("constexpr long kSilenceNs = 1;", "kSilenceNs"), ("class MotionBank;", "MotionBank"),
                           ("class TelescopeLine;", "TelescopeLine"), ("void startle();", "startle"), ("std::string trouble_;", "trouble_")):
            with self.subTest(word):
                self.refused("host/daemon/planted.hpp", text + "\n", word)

    def test_a_file_s_name_counts_too(self):
        self.refused("common/pharos/motion/motion_bank.cpp", "", "motion_bank")

    def test_keys_comments_and_english_pass(self):
        self.plant("host/config/planted.cpp", 'read("least_outer_radius_m", value.min_outer_radius_m);  // kLeastPoints of old\n'
                   "auto most_probable = at_least(3); bool share = true; auto p = std::make_shared<int>(3);\n")
        code, output = run("vocabulary.py", self.root)
        self.assertEqual(code, 0, output)


class CoreSymbols(ScratchTree):
    def compiled(self, text):
        source = self.plant("planted.cpp", text)
        library = self.root / "planted.o"
        subprocess.run([COMPILER, "-std=c++20", "-O2", "-c", source, "-o", library], check=True)
        return run("core_symbols.py", library)

    def refused(self, text, reason):
        code, output = self.compiled(text)
        self.assertEqual(code, 1, output)
        self.assertIn(reason, output)

    def test_finds_new(self):
        self.refused("int* leak() { return new int(1); }", "heap")

    def test_finds_malloc(self):
        self.refused("#include <cstdlib>\nvoid* leak() { return std::malloc(8); }", "heap")

    def test_finds_a_container_that_grows(self):
        self.refused("#include <vector>\nvoid grow(std::vector<int>& all) { all.push_back(1); }", "heap")

    def test_finds_exceptions(self):
        self.refused("void fail() { throw 1; }", "exceptions")

    def test_finds_run_time_types(self):
        self.refused("struct Base { virtual int value(); }; int Base::value() { return 1; }", "run-time types")

    def test_finds_the_clock(self):
        self.refused("#include <ctime>\nlong now() { return std::time(nullptr); }", "clock")
        self.refused("#include <chrono>\nauto now() { return std::chrono::steady_clock::now(); }", "clock")

    def test_finds_output(self):
        self.refused('#include <cstdio>\nvoid tell() { std::printf("%d", 1); }', "input and output")

    def test_finds_writable_globals(self):
        self.refused("int count = 3;\nint next() { return ++count; }", "writable data")
        self.refused("static int count;\nint next() { return ++count; }", "writable data")
        self.refused("int next() { static int count = 0; return ++count; }", "writable data")

    def test_finds_thread_local_state(self):
        self.refused("thread_local int count = 3;\nint next() { return ++count; }", "writable data")

    def test_finds_statics_initialised_at_run_time(self):
        self.refused("int read(); int value() { static const int once = read(); return once; }", "run-time initialised")

    def test_passes_constants_and_tables_of_pointers(self):
        code, output = self.compiled(
            'constexpr double kTable[] = {1.0, 2.0};\nconst char* const kNames[] = {"a", "b"};\n'
            "double at(int i) { return kTable[i]; }\nconst char* name(int i) { return kNames[i]; }")
        self.assertEqual(code, 0, output)


class House(ScratchTree):
    LICENCE = "// SPDX-License-Identifier: Apache-2.0\n"

    def refused(self, name, text, reason):
        self.plant(name, text)
        code, output = run("house.py", self.root)
        self.assertEqual(code, 1, output)
        self.assertIn(reason, output)

    def test_finds_a_missing_licence_line(self):
        self.refused("host/clock/clock.cpp", "int x;\n", "SPDX")

    def test_finds_a_leftover(self):
        self.refused("host/clock/clock.cpp", self.LICENCE + "// TO" "DO later\n", "leftover")

    def test_finds_a_file_too_long_to_read(self):
        self.refused("host/clock/clock.cpp", self.LICENCE + "int x;\n" * 401, "split it")

    def test_passes_a_good_file(self):
        self.plant("host/clock/clock.cpp", self.LICENCE + "int x;\n")
        self.assertEqual(run("house.py", self.root)[0], 0)


@unittest.skipUnless(shutil.which("clang-tidy-14"), "clang-tidy-14 is not installed")
class Tidy(ScratchTree):
    """The files of a target are looked at as one text: what a check or the analyser finds, and where, is as of each file alone."""

    GOOD = "#include <cstddef>\nnamespace pharos {\nstd::size_t twice(std::size_t x) { return 2 * x; }\n}  // namespace pharos\n"

    def setUp(self):
        super().setUp()
        for folder in (".", "tests"):
            self.plant(f"{folder}/.clang-tidy", (HERE.parents[1] / folder / ".clang-tidy").read_text())

    def looked_at(self, **texts):
        entries = []
        for name, text in texts.items():
            file = self.plant(f"host/clock/{name}.cpp", text)
            command = f"c++ -std=c++20 -o host/clock/CMakeFiles/clock.dir/{name}.cpp.o -c {file}"
            entries.append({"directory": str(self.root), "file": str(file), "command": command})
        commands = self.plant("compile_commands.json", json.dumps(entries))
        return run("tidy.py", self.root, commands, self.root / "work", "1", "host/")

    def refused(self, text, line, reason):
        code, output = self.looked_at(before=self.GOOD, clock="#include <cstddef>\n" + text)
        self.assertEqual(code, 1, output)
        self.assertRegex(output, rf"host/clock/clock\.cpp:{line}:.*{reason}")

    def test_finds_a_name_of_another_style(self):
        self.refused("\nint BadName() { return 1; }\n", 3, "readability-identifier-naming")

    def test_finds_by_the_analyser(self):
        self.refused("int at(const int* p) {\n  if (p == nullptr) return *p;\n  return 0;\n}\n", 3, "clang-analyzer-core.NullDereference")

    def test_finds_what_is_looked_for_in_the_main_file_only(self):
        self.refused("namespace other {}\nnamespace again = other;\n", 3, "misc-unused-alias-decls")

    def test_finds_an_include_that_stands_twice_in_a_file(self):
        self.refused("#include <cstddef>\n", 2, "readability-duplicate-include")

    def test_an_include_of_two_files_is_none_twice(self):
        code, output = self.looked_at(before=self.GOOD, clock=self.GOOD.replace("twice", "double_of"))
        self.assertEqual(code, 0, output)
        self.assertIn("2 files in 1 texts, 0 with findings", output)


if __name__ == "__main__":
    unittest.main()
