// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

namespace pharos::host {

/// A separate network namespace, with a loopback interface (127.0.0.1 and 127.0.0.2) and a route for multicast: only
/// one GigE Vision camera per address is possible (UDP port 3956), and tests of several build trees may run in
/// parallel. If the kernel does not permit it, the computer's own loopback is used. Construct it before main() begins,
/// while the program has one thread.
class NetworkNamespace : public ::testing::Environment {
 public:
  void SetUp() override;
};

}  // namespace pharos::host
