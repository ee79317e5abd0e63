// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

namespace pharos::host {

/// A network of the test's own, with a loopback interface (127.0.0.1 and 127.0.0.2) and a route for multicast: there is
/// one GigE Vision camera an address (UDP port 3956), and tests of several build trees run at once. Where the kernel
/// does not let us, the computer's own loopback serves. Make one before main() begins, while the program has one
/// thread.
class NetworkNamespace : public ::testing::Environment {
 public:
  void SetUp() override;
};

}  // namespace pharos::host
