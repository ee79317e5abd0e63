// SPDX-License-Identifier: Apache-2.0
// Nothing runs here: the program exists to be linked with every object of the portable core. Each PHAROS_PLANT_ block
// is one thing that the core must not do; the check's own test builds with it and expects the link to break.
#include <cstdlib>
#include <ctime>

// The one thing of the C library that stops a program; what it does is the target's business.
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
