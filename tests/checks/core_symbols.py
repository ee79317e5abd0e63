#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads the symbol tables of the portable core's libraries and fails on heap, exceptions, RTTI, clocks, input/output,
threads and writable data. Builds with sanitizers or without optimisation are not checked: they add their own symbols."""

import argparse
import re
import subprocess
import sys

# Symbols that an object of the core may not refer to, by the demangled or plain name.
FORBIDDEN = {
    "heap": r"operator (new|delete)|^(malloc|calloc|realloc|free|aligned_alloc|posix_memalign|memalign)$",
    "exceptions": r"^__cxa_(throw|rethrow|allocate_exception|begin_catch)|^_Unwind_|^__gxx_personality|^std::__throw_",
    "run-time types": r"^__dynamic_cast$|^typeinfo for |^vtable for __cxxabiv1",
    "clock": r"^(time|clock|clock_gettime|gettimeofday|localtime|gmtime)$|std::chrono::.*now\(",
    "input and output": r"^(v?f?printf|v?sn?printf|puts|putchar|fopen|fwrite|fputs|open|read|write)$|std::(basic_)?[io]stream|std::ios_base",
    "threads": r"^pthread_|^std::thread|^std::mutex|^__tls_get_addr$",
    "run-time initialised static": r"^__cxa_(guard_acquire|atexit)$",
    "random numbers": r"^(rand|srand|random|drand48)$",
}
WRITABLE = re.compile(r"^\.(data|bss|tdata|tbss|init_array)(?!\.rel\.ro)")


def symbols(library):
    """(name, section) of every symbol; the section of an undefined one is *UND*."""
    table = subprocess.run(["nm", "--demangle", "--format=sysv", library], check=True, capture_output=True, text=True)
    for line in table.stdout.splitlines():
        fields = [field.strip() for field in line.split("|")]
        if len(fields) == 7:
            yield fields[0], fields[2], fields[6]


def violations(library):
    for name, kind, section in symbols(library):
        if section == "*UND*" or kind in ("U", "w"):
            plain = name.split("@")[0]
            for what, pattern in FORBIDDEN.items():
                if re.search(pattern, plain):
                    yield f"{library}: {what}: {plain}"
        elif WRITABLE.match(section):
            yield f"{library}: writable data: {name} in {section}"
        elif name.startswith(("typeinfo for ", "typeinfo name for ")):
            yield f"{library}: run-time types: {name}"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("libraries", nargs="+", metavar="LIBRARY")
    arguments = parser.parse_args()
    found = sorted({violation for library in arguments.libraries for violation in violations(library)})
    for violation in found:
        print(violation)
    print(f"{len(found)} forbidden symbols in {len(arguments.libraries)} libraries")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
