// SPDX-License-Identifier: Apache-2.0
// This program is not run, only linked with every object of the portable core. Each PHAROS_PLANT_ block is one
// violation of the core's rules; the check's own test builds with it and expects the link to fail.
#include <cstdlib>
#include <ctime>

// The function of the C library that stops a program; the target defines it.
extern "C" void abort() {
  for (;;) asm volatile("");
}

struct Guarded {
  Guarded();
  ~Guarded();
  int value;
};

int main() {
#if defined(PHAROS_PLANT_HEAP)
  return std::malloc(1) == nullptr;
#elif defined(PHAROS_PLANT_NEW)
  int* volatile leaked = new int(1);
  return *leaked;
#elif defined(PHAROS_PLANT_CLOCK)
  return static_cast<int>(std::time(nullptr));
#elif defined(PHAROS_PLANT_STATIC)
  static Guarded guarded;
  return guarded.value;
#else
  return 0;
#endif
}
