// diptych: what progress prints on a terminal and in a log
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/processes/progress.h"
#include "tests/common.h"

#include <iostream>

#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

namespace
{
  using namespace diptych::coupling;

  bool has_text(const std::string &text, const std::string &part)
  {
    return text.find(part) != std::string::npos;
  }

  // The output of a process whose three streams are a terminal.
  std::string printed_on_a_terminal(const std::function<void()> &work)
  {
    int         terminal = -1;
    const pid_t child    = forkpty(&terminal, nullptr, nullptr, nullptr);
    if (child == 0)
      {
        work();
        _exit(0);
      }
    std::string text;
    char        bytes[256];
    for (ssize_t n = 0; (n = read(terminal, bytes, sizeof bytes)) > 0;)
      text.append(bytes, std::size_t(n));
    close(terminal);
    waitpid(child, nullptr, 0);
    return text;
  }

  TEST(Progress, EveryPhaseOfALogEndsAtHundredPerCent)
  {
    testing::internal::CaptureStderr();
    {
      Progress progress(false);
      progress.update("preparing", 0);
      progress.update("preparing", 0.7); // an estimate that was too long
      progress.update("loading", 0);
      progress.update("loading", 0.5);
      progress.finish();
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "preparing: 0 %, 0 s elapsed\n"
                                                      "preparing: 70 %, 0 s elapsed, 0 s remaining\n"
                                                      "preparing: 100 %, 0 s elapsed\n"
                                                      "loading: 0 %, 0 s elapsed\n"
                                                      "loading: 50 %, 0 s elapsed, 0 s remaining\n"
                                                      "loading: 100 %, 0 s elapsed\n");
  }

  TEST(Progress, APhaseThatFailsIsNotCalledComplete)
  {
    testing::internal::CaptureStderr();
    {
      Progress progress(false);
      progress.update("loading", 0.5);
    }
    EXPECT_FALSE(has_text(testing::internal::GetCapturedStderr(), "100 %"));
    EXPECT_FALSE(has_text(printed_on_a_terminal([] { Progress(false).update("loading", 0.5); }), "done"));
  }

  TEST(Progress, AMessageBeginsOnALineOfItsOwn)
  {
    const std::string text = printed_on_a_terminal([] {
      Progress progress(false);
      progress.update("preparing", 0);
      Progress::make_room();
      std::cout << "loading: about 300 steps" << std::endl;
      progress.update("loading", 0.5);
      Progress::make_room();
      Progress::make_room(); // nothing is open
    });
    EXPECT_TRUE(has_text(text, "preparing: done in 0 s\r\nloading: about 300 steps\r\n")) << text;
    EXPECT_TRUE(has_text(text, "loading: done in 0 s\r\n")) << text;
    EXPECT_FALSE(has_text(text, "?")) << text;
  }
} // namespace
