#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# usage: chip_flashes.sh BUILD [ep4ce10|up5k [PROGRAM]]: `pharos flash`'s own sender writes PROGRAM (decoder) into the simulated chip, whose loader
# verifies, marks and starts it; then a forged image is refused and a power cycle starts the program. With `decoder_pose`, whose 237 kB go to the
# SDRAM, the forged image is the decoder's, and what is then in the flash is started before light of two stations: sweeps and poses are the host's
# (chip_poses.py; 1,400 million ticks together, 5 to 14 minutes of a processor). Prints the times of README. 77 = skipped.
set -euo pipefail
build=$1 chip=${2:-ep4ce10} program=${3:-decoder}
images=$build/firmware/bin
[ -r "$images/$program.$chip.image" ] || { echo "skipped: the images are not built (target firmware)"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp "$images/decoder.$chip.image" "$work/forged.image"
printf '\377' | cmp -s -n1 -i 100:0 "$work/forged.image" - && byte='\0' || byte='\377'
printf "$byte" | dd of="$work/forged.image" bs=1 seek=100 conv=notrunc status=none # in the signature
code=0
"$build/tests/chip_flash" "$images/$program.$chip.image" "$work/forged.image" --loader "$images/${chip}_loader.bin" --chip "$chip" \
  --verifier "$images/verifier.bin" --flash "$work/flash" >"$work/rows" || code=$?
cat "$work/rows"
[ $code -eq 1 ] || { echo "FAILED: exit code $code"; exit 1; }
version=$(sed -n 2p "$work/rows" | cut -d, -f3)
sed -n 2p "$work/rows" | grep -q ",$version,\"\"$" || { echo "FAILED: $program was not written and started"; exit 1; }
sed -n 3p "$work/rows" | grep -q ",$version,\"the image's signature is not of the key" ||
  { echo "FAILED: the forged image was not refused, or $program does not start after it"; exit 1; }
[ "$program" != decoder_pose ] || python3 -B "$(dirname "$0")/chip_poses.py" "$build" 11.5 "$work/flash"
