// diptych: what progress prints on a terminal and in a log
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/processes/progress.h"
#include "discrete/loading_variable.h"
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

  struct Row
  {
    diptych::discrete::LoadingVariable loading_variable = diptych::discrete::LoadingVariable::axial_strain;
    double                             progress = 0.0125, stress_ratio = 0.3514;
  };

  std::string logged(const std::chrono::seconds interval)
  {
    testing::internal::CaptureStderr();
    {
      Progress progress(false, interval);
      progress.update("preparing", 0.7); // an estimate that was too long
      progress.update("loading", 0.5, reached_text(std::vector<Row>(1)));
      progress.finish();
    }
    return testing::internal::GetCapturedStderr();
  }

  TEST(Progress, ALogHasStrainAndStressRatioAtIntervalsAndTheEndOfEveryPhase)
  {
    const std::string prepared = "preparing: done in 0 s\n", state = "loading: 1.25 % axial strain, t/s 0.351, ";
    EXPECT_EQ(logged(std::chrono::seconds(10)), prepared + state + "done in 0 s\n");
    EXPECT_EQ(logged(std::chrono::seconds(0)), "preparing: 70 %, 0 s elapsed, 0 s remaining\n" + prepared + state +
                                                 "0 s elapsed, 0 s remaining\n" + state + "done in 0 s\n");
  }

  TEST(Progress, APhaseThatFailsIsNotCalledComplete)
  {
    testing::internal::CaptureStderr();
    {
      Progress progress(false);
      progress.update("loading", 0.5);
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
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
