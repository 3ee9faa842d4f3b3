// diptych: one writer of a folder at a time
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/store/folder_lock.h"

#include <chrono>
#include <csignal>
#include <thread>

#include <sys/wait.h>
#include <unistd.h>

#include "coupling/processes/child_process.h"
#include "discrete/files/text_file.h"
#include "tests/common.h"

namespace
{
  namespace fs = std::filesystem;
  using namespace diptych::coupling;
  using namespace diptych::discrete;
  using namespace diptych::tests;

  constexpr char lock_name[] = ".diptych.lock";

  struct Lock : testing::Test
  {
    const Folder folder;
    fs::path     top = folder.path, out = top / "results" / "one";

    fs::path file() const { return out / lock_name; }

    // The message that another process gets when it asks for the folder; empty if it got it.
    std::string asked_by_another() const
    {
      const pid_t child = fork();
      if (child == 0)
        {
          write_text(top / "told", refusal<std::runtime_error>([&] { FolderLock{out}; }));
          _exit(0);
        }
      waitpid(child, nullptr, 0);
      return read_text(top / "told");
    }
  };

  TEST_F(Lock, ASecondWriterIsRefusedNamingTheFirst)
  {
    const FolderLock  lock(out);
    const std::string told = asked_by_another();
    expect_words(told, {out.string(), "process " + std::to_string(getpid())});
  }

  TEST_F(Lock, IsGivenBack)
  {
    {
      const FolderLock lock(out);
      std::ofstream(out / "result") << "kept";
    }
    EXPECT_FALSE(fs::exists(file()));
    EXPECT_EQ(asked_by_another(), "");
    EXPECT_TRUE(fs::exists(out / "result"));
  }

  // Killed while it wrote its first file.
  TEST_F(Lock, AnUnfinishedFileOfAKilledProcessLeavesTheFolderEmpty)
  {
    fs::create_directories(out);
    std::ofstream(file()) << "process 1 on nowhere since yesterday";
    std::ofstream(out / "import.json.part") << "half";
    EXPECT_TRUE(is_empty_folder(out));
    std::ofstream(out / "letter.txt") << "somebody's";
    EXPECT_FALSE(is_empty_folder(out));
  }

  TEST_F(Lock, TheLockOfAKilledProcessIsTakenOver)
  {
    fs::create_directories(out);
    std::ofstream(file()) << "process 1 on nowhere since yesterday";
    const FolderLock lock(out);
    expect_words(read_text(file()), {std::to_string(getpid())});
  }

  // A worker of a killed study still writes its checkpoint.
  TEST_F(Lock, WorkersOfAKilledProcessAreWaitedFor)
  {
    const fs::path end    = top / "ended";
    const pid_t    killed = fork();
    if (killed == 0)
      {
        const FolderLock  lock(out);
        const fs::path    begun   = top / "begun";
        const std::string program = "trap '' TERM; touch '" + begun.string() + "'; sleep 1; touch '" + end.string() +
                                    "'; exec sleep 0.2";
        std::thread([&] { (void)run_program({"/bin/sh", "-c", program}); }).detach();
        while (!fs::exists(begun))
          std::this_thread::sleep_for(std::chrono::milliseconds(5));
        kill(getpid(), SIGKILL);
      }
    siginfo_t how; // nobody has asked it yet how it ended: it is not gone from the system's list
    ASSERT_EQ(waitid(P_PID, id_t(killed), &how, WEXITED | WNOWAIT), 0);
    testing::internal::CaptureStderr();
    const FolderLock  lock(out);
    const std::string told = testing::internal::GetCapturedStderr();
    EXPECT_TRUE(fs::exists(end)) << "the program still wrote";
    expect_words(told, {"workers of process " + std::to_string(killed)});
    waitpid(killed, nullptr, 0);
  }

  TEST_F(Lock, SetAsideTheOldFilesAreInTheOtherFolderAndTheNewOneIsLocked)
  {
    const fs::path aside = top / "results" / "one.1";
    FolderLock     lock(out);
    std::ofstream(out / "rows.csv") << "a";
    lock.set_aside(aside);
    EXPECT_TRUE(fs::exists(aside / "rows.csv"));
    EXPECT_FALSE(fs::exists(aside / lock_name));
    EXPECT_TRUE(is_empty_folder(out));
    EXPECT_NE(asked_by_another(), "");
  }

  TEST_F(Lock, AFolderThatStaysEmptyIsRemoved)
  {
    {
      const FolderLock lock(out);
      EXPECT_TRUE(fs::is_directory(out));
      EXPECT_TRUE(is_empty_folder(out));
    }
    EXPECT_FALSE(fs::exists(out));
    EXPECT_TRUE(fs::exists(top));
  }

  // A disk that is not mounted just now leaves such a link.
  TEST_F(Lock, ABrokenLinkStays)
  {
    fs::create_symlink("nowhere/folder", top / "results");
    EXPECT_THROW(FolderLock{out}, std::invalid_argument);
    EXPECT_TRUE(fs::is_symlink(top / "results"));
  }

  TEST_F(Lock, AFileInThePlaceOfTheFolderIsNamed)
  {
    std::ofstream(top / "results") << "a file";
    expect_refused({(top / "results").string()}, [&] { FolderLock{out}; });
  }
} // namespace
