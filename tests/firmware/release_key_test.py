#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""usage: release_key_test.py PHAROS IMAGES: loader and verifier built with a key of its own (PHAROS_SIGNING_KEY), the public half
alone, refuse images of the public test key and take those signed with its private half. 77 = skipped."""

import pathlib
import shutil
import subprocess
import sys
import tempfile

from qemu_target import DECODER, QemuTarget, have_qemu

ROOT = pathlib.Path(__file__).parents[2]


def quietly(*command):
    run = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)
    if run.returncode != 0:
        sys.exit(f"FAILED: {' '.join(map(str, command))}\n{run.stdout[-3000:]}{run.stderr[-3000:]}")
    return run.stdout


def main():
    pharos, images = map(pathlib.Path, sys.argv[1:])
    if not have_qemu():
        print("skipped: qemu-system-riscv32 is not installed (tools/install-dependencies test)")
        return 77
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        private, public, tree = folder / "release.pem", folder / "release.public", folder / "tree"
        quietly("openssl", "genpkey", "-algorithm", "ed25519", "-out", private)
        der = subprocess.run(["openssl", "pkey", "-in", private, "-pubout", "-outform", "DER"], capture_output=True, check=True).stdout
        public.write_text(der[-32:].hex() + "\n")
        launcher = shutil.which("ccache") or ""
        quietly("cmake", "-S", ROOT, "-B", tree, "--preset", "rv32im", f"-DPHAROS_SIGNING_KEY={public}", f"-DCMAKE_CXX_COMPILER_LAUNCHER={launcher}")
        quietly("cmake", "--build", tree, "--target", "verifier_digest", "qemu_virt_loader")
        for file in ("verifier.bin", "qemu_virt_loader.elf"):
            if (tree / "bin" / file).read_bytes() == (images / file).read_bytes():
                sys.exit(f"FAILED: {file} does not depend on the key")
        signed = folder / "signed.image"
        quietly(sys.executable, "-B", ROOT / "firmware/boot/make_image.py", "--key", private, "--board", "qemu_virt", "--name", "probe",
                "--version", "1.0.1", images / "flash_probe_1.elf", signed)

        def flash(target, image):
            return subprocess.run([pharos, "flash", target.port, image, "--wait", "20"], stdin=subprocess.DEVNULL, capture_output=True,
                                  text=True, timeout=120)

        with QemuTarget(tree / "bin", folder / "flash") as target:
            target.switch_on()
            run = flash(target, images / "flash_probe_2.image")
            if run.returncode != 1 or "signature is not of the key" not in run.stderr:
                sys.exit(f"FAILED: an image of the test key: exit code {run.returncode}: {run.stderr}")
            print("refused:", run.stderr.strip())
            run = flash(target, signed)
            if run.returncode != 0:
                sys.exit(f"FAILED: the key's own image: {run.stderr}")
            target.forget()
            hello = target.hello()
            if hello is None or (hello.role, hello.version) != (DECODER, (1, 0, 1)):
                sys.exit("FAILED: the key's own image does not run")
            print("taken: the image signed with the key")
    return 0


if __name__ == "__main__":
    sys.exit(main())
