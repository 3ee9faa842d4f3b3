// diptych: what happens in the child process does not end this one
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/mesh/mesh_child.h"

#include <csignal>

#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

#include "continuum/mesh/mesh.h"

namespace
{
  using namespace diptych::continuum;

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
    EXPECT_THROW((void)made_in_child(endless, [] { throw Stopped(); }), Stopped);
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "the child is still there";
    EXPECT_THROW((void)made_in_child(endless, {}, 1), GmshEnded);
    const auto waiting = []() -> QuadMesh { // uses no CPU time
      pause();
      return {};
    };
    EXPECT_THROW((void)made_in_child(waiting, {}, 1), GmshEnded);
  }
} // namespace
