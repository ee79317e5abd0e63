#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`pharos flash` against the real loader under QEMU: successful runs and required failures. 77 = skipped."""

import argparse
import fcntl
import os
import pathlib
import pty
import subprocess
import sys
import tempfile
import unittest

from qemu_target import DECODER, LOADER, VERIFIER_OFFSET, PoorLine, QemuTarget, have_qemu, raw_line

PHAROS = IMAGES = None
LOADER_MOST_BYTES = 4096 + 2048
ON_CHIP = 0x80001000
TEST_KEY = pathlib.Path(__file__).parents[2] / "firmware/boot/test_key/test_only_private_key.pem"
RESET, CAUSE_COMMAND = 3, 2  # wire::CommandCode, wire::ResetCause
BAUD = 460_800


def flash(port, image, *options, **keywords):
    return subprocess.run([PHAROS, "flash", port, image, *options], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          timeout=600, **keywords)


class FlashUnderQemu(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.target = QemuTarget(IMAGES, pathlib.Path(self.folder.name) / "flash")
        self.addCleanup(self.target.switch_off)
        self.first, self.second, self.large = (IMAGES / f"flash_probe_{n}.image" for n in (1, 2, 3))

    def damaged(self, change):
        data = bytearray(self.first.read_bytes())
        path = pathlib.Path(self.folder.name) / "damaged.image"
        path.write_bytes(change(data) or data)
        return path

    def flashed(self, image, *options, port=None):
        run = flash(port or self.target.port, image, *options)
        self.assertEqual(run.returncode, 0, run.stderr)
        return dict(zip(*(line.split(",") for line in run.stdout.splitlines())))

    def refused(self, code, words, image, *options):
        run = flash(self.target.port, image, *options)
        self.assertEqual(run.returncode, code, run.stderr)
        self.assertIn(words, run.stderr)
        self.assertEqual(len(run.stderr.splitlines()), 1, run.stderr)
        self.assertEqual(run.stdout, "")

    def assert_runs(self, version):
        self.target.forget()
        hello = self.target.hello()
        self.assertIsNotNone(hello, "nothing says Hello")
        self.assertEqual((hello.role, hello.version, hello.board), (DECODER, version, "qemu_virt"))
        return hello

    def test_takes_images_in_turn_and_keeps_them_without_power(self):
        self.target.switch_on()
        hello = self.target.hello()
        self.assertEqual((hello.role, hello.board), (LOADER, "qemu_virt"))
        row = self.flashed(self.first)
        self.assertEqual(tuple(row.values())[:4], ("qemu_virt", "flash_probe", "1.0.1", ""))
        self.assertEqual(self.assert_runs((1, 0, 1)).reset_cause, 2)
        row = self.flashed(self.second)
        self.assertEqual((row["version"], row["version_before"]), ("1.0.2", "1.0.1"))
        self.assert_runs((1, 0, 2))
        self.target.switch_off()
        self.target.switch_on()
        hello = self.assert_runs((1, 0, 2))
        self.assertEqual((hello.reset_cause, hello.start_count), (1, 1))
        self.refused(1, "version 1.0.1, older than 1.0.2", self.first)
        self.assert_runs((1, 0, 2))
        self.assertEqual(self.flashed(self.first, "--allow-older")["version"], "1.0.1")
        self.assert_runs((1, 0, 1))

    def test_refuses_what_is_no_image_for_this_target(self):
        self.target.switch_on()
        self.flashed(self.first)
        self.refused(2, "cut short", self.damaged(lambda data: data[:-100]))
        self.refused(2, "damaged", self.damaged(lambda data: data.__setitem__(5000, data[5000] ^ 1)))
        self.refused(2, "damaged", self.damaged(lambda data: data.__setitem__(30, data[30] ^ 1)))
        self.refused(2, "is no image", self.target.loader)
        self.refused(2, "cannot be read", pathlib.Path("/nowhere"))
        self.refused(2, "for the board 'ep4ce10'", self.made("--board", "ep4ce10", "--version", "2.0.0"))
        self.assert_runs((1, 0, 1))

    def test_refuses_what_is_not_signed_with_its_key(self):
        self.target.switch_on()
        self.flashed(self.first)
        key = pathlib.Path(self.folder.name) / "other.pem"
        subprocess.run(["openssl", "genpkey", "-algorithm", "ed25519", "-out", key], check=True)
        words = "signature is not of the key"
        new = ("--board", "qemu_virt", "--version", "2.0.0")
        self.refused(1, words, self.made(*new, "--key", key))
        self.refused(1, words, self.damaged(lambda data: data.__setitem__(100, data[100] ^ 1)))
        self.refused(1, words, self.damaged(lambda data: data.__setitem__(150, data[150] ^ 1)))
        # Another body with its digest and CRCs, under the signature of the first.
        made = bytearray(self.made(*new).read_bytes())
        made[96:160] = self.first.read_bytes()[96:160]
        self.refused(1, words, self.damaged(lambda data: made))
        self.assert_runs((1, 0, 1))
        self.assertEqual(self.flashed(self.made("--board", "qemu_virt", "--version", "1.0.1"))["version"], "1.0.1")

    def test_runs_an_unsigned_image_only_with_the_jumper(self):
        self.target.switch_on()
        self.flashed(self.first)
        bare = self.made("--board", "qemu_virt", "--version", "1.0.1", "--unsigned")
        self.refused(1, "is not signed, and the target's development jumper is not set", bare)
        self.assert_runs((1, 0, 1))
        self.target.switch_off()
        self.target.jumper = True
        self.target.switch_on()
        self.assertEqual(self.flashed(bare)["version"], "1.0.1")
        self.assert_runs((1, 0, 1))

    def test_refuses_versions_below_its_floor(self):
        self.target.switch_on()
        for image in (self.first, self.second, self.large):
            self.flashed(image)
            self.target.forget()
            for _ in range(3):
                self.assertIsNotNone(self.target.hello())  # so long that the start is confirmed
        self.refused(1, "older than 1.0.2, the oldest version", self.first, "--allow-older")
        self.assert_runs((1, 0, 3))
        self.assertEqual(self.flashed(self.second, "--allow-older")["version"], "1.0.2")

    def test_verifies_nothing_with_a_changed_verifier(self):
        self.target.write_flash(VERIFIER_OFFSET + 1000, b"\0")
        self.target.switch_on()
        self.refused(1, "verifier of signatures is missing or damaged", self.first)

    def test_takes_64_kib_over_a_line_of_460800_baud(self):
        self.target.switch_on()
        line = PoorLine(self.target.port, BAUD)
        self.addCleanup(line.close)
        row = self.flashed(self.large, port=line.port)
        payload = int(row["image_bytes"])
        self.assertGreater(payload, 65536)
        seconds = float(row["line_s"])
        # The seconds depend on this computer and its load; the bytes do not.
        self.assertGreaterEqual(payload / line.bytes, 0.65)
        share = 10 * payload / BAUD / seconds
        print(f"{payload} bytes in {seconds:.2f} s: {share:.0%} of the line; {line.bytes} bytes sent in all")

    def test_a_line_that_loses_bytes_ends_well_or_cleanly(self):
        self.target.switch_on()
        self.flashed(self.first)
        codes = []
        rates = (20_000, 5_000, 1_000, 200) if "PHAROS_LONG" in os.environ else (20_000, 200)
        for round, lost_of in enumerate(rates):
            line = PoorLine(self.target.port, 10 * BAUD, lost_of, seed=round)
            run = flash(line.port, self.second if round % 2 == 0 else self.first, "--allow-older")
            line.close()
            codes.append(run.returncode)
            self.assertIn(run.returncode, (0, 1), run.stderr)
            self.target.switch_off()
            self.target.switch_on()
            self.assertIn(self.target.hello().version, ((1, 0, 1), (1, 0, 2)))
        self.assertTrue(all(code == 0 for code, lost_of in zip(codes, rates) if lost_of >= 5_000), codes)
        self.flashed(self.first, "--allow-older")

    def comes_back(self, name):
        edges = pathlib.Path(self.folder.name) / "edges"
        self.target = QemuTarget(IMAGES, pathlib.Path(self.folder.name) / "decoder_flash", edges)
        self.addCleanup(self.target.switch_off)
        self.target.switch_on()
        image = IMAGES / f"{name}.qemu_virt.image"
        row = self.flashed(image)
        self.assertEqual((row["board"], row["name"]), ("qemu_virt", name))
        self.assertEqual(self.flashed(image)["version_before"], row["version"], "the program starts the loader when it is told to")
        self.target.forget()
        before = self.target.hello()
        self.target.command(RESET)
        self.target.forget()
        said = [self.target.hello() for _ in range(4)]  # the last one of the previous program may be among them
        hello = next((one for one in said if one and one.start_count != before.start_count), before)
        self.assertEqual((hello.role, hello.reset_cause, hello.start_count), (DECODER, CAUSE_COMMAND, before.start_count + 1))

    def test_the_decoder_runs_on_chip_starts_the_loader_and_comes_back(self):
        load_address = int.from_bytes((IMAGES / "decoder.qemu_virt.image").read_bytes()[12:16], "little")
        self.assertEqual(load_address, ON_CHIP)
        self.comes_back("decoder")

    @unittest.skipUnless("PHAROS_LONG" in os.environ, "a quarter of a megabyte, twice: runs with the label long")
    def test_the_decoder_with_poses_starts_the_loader_and_comes_back(self):
        self.comes_back("decoder_pose")

    def test_goes_back_from_an_image_that_stays_silent(self):
        self.target.switch_on()
        self.flashed(self.first)
        run = flash(self.target.port, IMAGES / "flash_probe_4.image", "--wait", "10")
        self.assertEqual(run.returncode, 1, "it cannot be said to run: " + run.stderr)
        print(run.stderr.strip())
        self.assert_runs((1, 0, 1))
        self.assertEqual(self.flashed(self.second)["version"], "1.0.2")
        self.assert_runs((1, 0, 2))

    def made(self, *options):
        path = pathlib.Path(self.folder.name) / "made.image"
        maker = pathlib.Path(__file__).parents[2] / "firmware/boot/make_image.py"
        keys = () if "--key" in options or "--unsigned" in options else ("--key", TEST_KEY)
        options = [option for option in options if option != "--unsigned"]
        subprocess.run([sys.executable, "-B", maker, *keys, *options, "--name", "made", IMAGES / "flash_probe_1.elf", path], check=True)
        return path

    def test_a_held_port_is_told(self):
        held, end = pty.openpty()
        fcntl.flock(end, fcntl.LOCK_EX)  # as pharosd and pharos lock it
        self.addCleanup(os.close, held)
        self.addCleanup(os.close, end)
        run = flash(os.ttyname(end), self.first)
        self.assertEqual(run.returncode, 2)
        self.assertIn("in use by another program", run.stderr)

    def test_a_silent_port_ends_with_what_to_do(self):
        silent, end = pty.openpty()
        raw_line(end)
        run = flash(os.ttyname(end), self.first, "--wait", "1")
        os.close(silent)
        os.close(end)
        self.assertEqual(run.returncode, 1)
        self.assertIn("no answer from the target", run.stderr)

    def test_asks_on_a_terminal_before_it_goes_back(self):
        self.target.switch_on()
        self.flashed(self.second)
        for answer, code, version in ((b"n\n", 1, (1, 0, 2)), (b"y\n", 0, (1, 0, 1))):
            ours, theirs = pty.openpty()
            with subprocess.Popen([PHAROS, "flash", self.target.port, self.first], stdin=theirs, stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, text=True) as run:
                os.write(ours, answer)
                _, messages = run.communicate(timeout=120)
            os.close(ours)
            os.close(theirs)
            self.assertEqual(run.returncode, code, messages)
            self.assertIn("older than 1.0.2 that is there: write it?", messages)
            self.assert_runs(version)

    def test_shows_progress_on_a_terminal(self):
        self.target.switch_on()
        ours, theirs = pty.openpty()
        with subprocess.Popen([PHAROS, "flash", self.target.port, self.first], stdin=subprocess.DEVNULL,
                              stdout=subprocess.DEVNULL, stderr=theirs) as run:
            os.close(theirs)
            shown = b""
            try:
                while part := os.read(ours, 4096):
                    shown += part
            except OSError:
                pass  # the program ended
        os.close(ours)
        self.assertEqual(run.returncode, 0, shown)
        self.assertIn(b"writing", shown)

    def test_the_loaders_keep_their_6_kib(self):
        for board in ("qemu_virt", "ep4ce10"):
            size = (IMAGES / f"{board}_loader.bin").stat().st_size
            print(f"loader of {board}, code and constants: {size} bytes")
            self.assertLessEqual(size, LOADER_MOST_BYTES)
            self.assertGreater(size, 1000)


def main():
    global PHAROS, IMAGES
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("pharos", type=pathlib.Path)
    parser.add_argument("images", type=pathlib.Path)
    parser.add_argument("tests", nargs="*")
    arguments = parser.parse_args()
    PHAROS, IMAGES = arguments.pharos, arguments.images
    if not have_qemu():
        print("skipped: qemu-system-riscv32 is not installed (tools/install-dependencies test)")
        return 77
    program = unittest.main(argv=[sys.argv[0], *arguments.tests], exit=False, verbosity=2)
    return 0 if program.result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
