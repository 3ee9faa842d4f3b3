// diptych: what happens in the child process does not end this one
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/mesh/mesh_child.h"

#include <csignal>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include <unistd.h>

#include "continuum/mesh/mesh.h"

namespace
{
  using namespace diptych::continuum;

  // Process numbers of the children of this thread; MPI may have one.
  std::string children()
  {
    std::ifstream file("/proc/thread-self/children");
    return {std::istreambuf_iterator<char>(file), {}};
  }

  TEST(MeshChild, ReturnsTheMeshUnchanged)
  {
    const QuadMesh mesh = rectangle_mesh({10, 6.2, 1.3, 0.5});
    const QuadMesh same = made_in_child([&] { return mesh; }, {});
    EXPECT_EQ(same.vertices, mesh.vertices);
    EXPECT_EQ(same.cells, mesh.cells);
    EXPECT_EQ(same.boundary.size(), mesh.boundary.size());
  }

  TEST(MeshChild, ExceptionsCrashesAndExitsAreReported)
  {
    EXPECT_THROW((void)made_in_child([]() -> QuadMesh { throw std::invalid_argument("no"); }, {}), std::invalid_argument);
    EXPECT_THROW((void)made_in_child([]() -> QuadMesh { throw std::runtime_error("no"); }, {}), std::runtime_error);
    const auto crash = []() -> QuadMesh {
      std::raise(SIGSEGV);
      return {};
    };
    EXPECT_THROW((void)made_in_child(crash, {}), GmshEnded);
    EXPECT_THROW((void)made_in_child([]() -> QuadMesh { _exit(0); }, {}), GmshEnded);
  }

  TEST(MeshChild, EndsOnRequestAndAtItsTimeLimit)
  {
    const auto endless = []() -> QuadMesh {
      for (volatile int k = 0;; k = k + 1)
        {}
    };
    struct Stopped
    {};
    const std::string before = children();
    EXPECT_THROW((void)made_in_child(endless, [] { throw Stopped(); }), Stopped);
    EXPECT_EQ(children(), before) << "the child is still there";
    EXPECT_THROW((void)made_in_child(endless, {}, 1), GmshEnded);
    const auto waiting = []() -> QuadMesh { // uses no CPU time
      pause();
      return {};
    };
    EXPECT_THROW((void)made_in_child(waiting, {}, 1), GmshEnded);
  }
} // namespace
