// diptych: one writer of a folder at a time
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/store/folder_lock.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "coupling/processes/child_process.h"
#include "coupling/processes/stop_signal.h"
#include "discrete/files/text_file.h"

namespace diptych::coupling
{
  namespace
  {
    namespace fs = std::filesystem;

    constexpr std::chrono::seconds patience(90); // longer than workers take to stop without their parent (panels_main.cc)
    constexpr char                 lock_name[] = ".diptych.lock";

    std::string lock_file(const std::string &directory)
    {
      return (fs::path(directory) / lock_name).string();
    }

    std::string host_name()
    {
      char host[256] = "";
      gethostname(host, sizeof host - 1);
      return host;
    }

    std::string own_name()
    {
      const std::time_t now        = std::time(nullptr);
      char              moment[32] = "";
      std::strftime(moment, sizeof moment, "%Y-%m-%d %H:%M:%S UTC", std::gmtime(&now));
      return "process " + std::to_string(getpid()) + " on " + host_name() + " since " + moment;
    }

    // "process 12 on here since ...", as the file says.
    std::string owner_of(const std::string &directory)
    {
      std::string owner = discrete::read_text(lock_file(directory));
      owner.erase(std::remove(owner.begin(), owner.end(), '\n'), owner.end());
      return owner.empty() ? "another run" : owner;
    }

    // The owner was a process of this machine and has ended.
    bool is_gone(const std::string &owner)
    {
      int  process   = 0;
      char host[256] = "";
      if (std::sscanf(owner.c_str(), "process %d on %255s", &process, host) != 2 || host != host_name())
        return false;
      const std::string status = discrete::read_text("/proc/" + std::to_string(process) + "/stat");
      const std::size_t name   = status.rfind(')'); // "12 (diptych) Z ...": a zombie has ended, too
      return status.empty() || (name != std::string::npos && status.compare(name, 3, ") Z") == 0);
    }

    [[noreturn]] void fail(const std::string &directory, const int error)
    {
      throw std::runtime_error("the folder '" + directory + "' cannot be locked: " + std::strerror(error));
    }
  } // namespace

  bool is_empty_folder(const std::string &directory)
  {
    const fs::directory_iterator entries(directory);
    return std::all_of(begin(entries), end(entries), [](const fs::directory_entry &entry) {
      return entry.path().filename() == lock_name || (entry.path().extension() == ".part" && entry.is_regular_file());
    });
  }

  void require_unlocked(const std::string &directory)
  {
    const int opened = open(lock_file(directory).c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (opened < 0)
      return;
    const bool is_locked = flock(opened, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    close(opened);
    if (is_locked)
      throw std::runtime_error("the folder '" + directory + "' is being written to by " + owner_of(directory) +
                               ". Wait for it, or name another folder.");
  }

  void make_folder(const std::string &directory)
  {
    std::error_code error;
    fs::create_directories(directory, error);
    const auto is = [&](const std::errc what) { return error == std::make_error_condition(what); };
    if (is(std::errc::not_a_directory) || is(std::errc::file_exists) || is(std::errc::filename_too_long) ||
        is(std::errc::too_many_symbolic_link_levels))
      throw std::invalid_argument("the folder '" + directory + "' cannot be made: " + error.message() + ". Give another name.");
    if (error)
      throw std::runtime_error("the folder '" + directory + "' cannot be made: " + error.message());
    if (access(directory.c_str(), W_OK) != 0)
      throw std::runtime_error("the folder '" + directory + "' cannot be written to: " + std::strerror(errno));
  }

  FolderLock::FolderLock(const std::string &directory)
      : directory(directory),
        was_made(!fs::exists(directory))
  {
    make_folder(directory);
    take();
  }

  void FolderLock::take()
  {
    const auto until = std::chrono::steady_clock::now() + patience;
    for (bool is_reported = false; !try_lock(); is_reported = true)
      {
        const std::string owner = owner_of(directory);
        if (!is_gone(owner) || std::chrono::steady_clock::now() > until)
          throw std::runtime_error("the folder '" + directory + "' is being written to by " +
                                   (is_gone(owner) ? "workers of " : "") + owner + ". Wait for it, or name another folder.");
        if (!is_reported)
          std::cerr << "waiting until the workers of " << owner << ", which was killed, have left " << directory << std::endl;
        leave_if_stopped("waiting for " + directory);
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
      }
    keep_open_in_programs(descriptor);
    const std::string name = own_name() + "\n";
    if (ftruncate(descriptor, 0) != 0 || write(descriptor, name.data(), name.size()) < 0)
      {} // the name only informs people: on a full disk the lock holds without it
  }

  // False where another process holds the lock. The last owner removes the file, perhaps after it was opened here: then again.
  bool FolderLock::try_lock()
  {
    const std::string file = lock_file(directory);
    while (true)
      {
        descriptor = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
        if (descriptor < 0)
          fail(directory, errno);
        const int   error  = flock(descriptor, LOCK_EX | LOCK_NB) == 0 ? 0 : errno;
        struct stat opened = {}, named = {};
        if (error == 0 && fstat(descriptor, &opened) == 0 && stat(file.c_str(), &named) == 0 && opened.st_ino == named.st_ino)
          return true;
        close(descriptor);
        descriptor = -1;
        if (error == EWOULDBLOCK)
          return false;
        if (error != 0)
          fail(directory, error);
      }
  }

  void FolderLock::give_back(const std::string &folder)
  {
    close_in_programs(descriptor);
    unlink(lock_file(folder).c_str());
    close(descriptor);
    descriptor = -1;
  }

  void FolderLock::set_aside(const std::string &aside)
  {
    std::error_code error;
    fs::rename(directory, aside, error);
    if (error)
      throw std::runtime_error("the folder '" + directory + "' cannot be renamed to '" + aside + "': " + error.message());
    give_back(aside);
    make_folder(directory);
    take();
  }

  FolderLock::~FolderLock()
  {
    if (descriptor >= 0)
      give_back(directory);
    std::error_code not_empty;
    if (was_made)
      fs::remove(directory, not_empty);
  }
} // namespace diptych::coupling
