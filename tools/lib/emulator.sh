# SPDX-License-Identifier: Apache-2.0
# The decoder board, emulated. Sourced by scripts.

# emulate IMAGE LINE [QEMU-OPTION...]: runs an image with the capture block's words from standard input
# (firmware/board/qemu_virt/capture_replay.hpp) until they end; what its UART says goes to the file LINE. An instruction
# takes 1 ns of the emulator's time; what is decoded is repeatable (firmware/README.md: what is not). Its exit code is
# that of the image, 124 when it hangs.
emulate() {
  local image=$1 line=$2
  shift 2
  timeout --kill-after=5 600 qemu-system-riscv32 -M virt -smp 1 -m 32M -bios none -nodefaults -display none \
    -icount shift=0,sleep=off -device loader,file="$image",cpu-num=0 -serial "file:$line" \
    -chardev stdio,id=edges,signal=off -device virtio-serial-device -device virtconsole,chardev=edges "$@"
}

# emulate_live IMAGE LINK: the same at the tape's own speed, with the UART on a pseudo-terminal that LINK then names.
# Ends with the words, as the image does; whoever kills this kills the emulator.
emulate_live() {
  local image=$1 link=$2
  exec qemu-system-riscv32 -M virt -smp 1 -m 32M -bios none -nodefaults -display none \
    -device loader,file="$image",cpu-num=0 -chardev pty,id=line -serial chardev:line \
    -chardev stdio,id=edges,signal=off -device virtio-serial-device -device virtconsole,chardev=edges \
    > >(port=$(grep -o -m 1 '/dev/pts/[0-9]*') && ln -sfn "$port" "$link" && cat >/dev/null)
}
