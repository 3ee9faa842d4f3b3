// diptych: one writer of a folder at a time
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/folders/folder_lock.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <set>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "coupling/processes/child_process.h"
#include "coupling/processes/stop_signal.h"
#include "discrete/files/text_file.h"
#include "discrete/files/write_guard.h"

namespace diptych::coupling
{
  namespace
  {
    namespace fs = std::filesystem;

    // Longer than what is left behind by its parent has to end (panels_main.cc).
    constexpr std::chrono::seconds patience(90);

    std::string own_name()
    {
      char host[256] = "";
      gethostname(host, sizeof host - 1);
      const std::time_t now        = std::time(nullptr);
      char              moment[32] = "";
      std::strftime(moment, sizeof moment, "%Y-%m-%d %H:%M:%S UTC", std::gmtime(&now));
      return "process " + std::to_string(getpid()) + " on " + host + " since " + moment;
    }

    // "process 12 on here since ...", as the file tells.
    std::string owner_of(const std::string &file)
    {
      std::string owner = discrete::read_text(file);
      owner.erase(std::remove(owner.begin(), owner.end(), '\n'), owner.end());
      return owner.empty() ? "another run" : owner;
    }

    // A process of this machine that has ended, as far as it can be told: its number may be another's by now.
    bool is_gone(const std::string &owner)
    {
      int  process   = 0;
      char host[256] = "", own[256] = "";
      gethostname(own, sizeof own - 1);
      if (std::sscanf(owner.c_str(), "process %d on %255s", &process, host) != 2 || std::strcmp(host, own) != 0)
        return false;
      const std::string status = discrete::read_text("/proc/" + std::to_string(process) + "/stat");
      const std::size_t name   = status.rfind(')'); // "12 (diptych) Z ...": ended, and nobody has asked how
      return status.empty() || (name != std::string::npos && status.compare(name, 3, ") Z") == 0);
    }

    std::runtime_error being_written_to(const std::string &directory, const std::string &owner)
    {
      return std::runtime_error("the folder '" + directory + "' is being written to by " + owner +
                                "; wait for it or name another folder; nothing was written");
    }

    // What is not there of a path, the innermost first. A link that leads nowhere is there.
    std::vector<std::string> missing_folders(const std::string &directory)
    {
      std::vector<std::string> missing;
      std::error_code          unreadable;
      for (fs::path path = fs::absolute(directory).lexically_normal(); !fs::exists(fs::symlink_status(path, unreadable));
           path          = path.parent_path())
        {
                   if (path.has_filename())
            missing.push_back(path.string());
          if (path == path.parent_path())
            break;
        }
      return missing;
    }

    [[noreturn]] void fail(const std::string &directory, const int error)
    {
      throw std::runtime_error("the folder '" + directory + "' cannot be locked for this run: " + std::strerror(error));
    }
  } // namespace

  const char *const folder_lock_name = ".diptych.lock";

  namespace
  {
    std::set<const FolderLock *> &held()
    {
      static std::set<const FolderLock *> locks;
      return locks;
    }
  } // namespace

  bool is_empty_folder(const std::string &directory)
  {
    const fs::directory_iterator entries(directory);
    return std::all_of(begin(entries), end(entries), [](const fs::directory_entry &entry) {
      return entry.path().filename() == folder_lock_name || (entry.path().extension() == ".part" && entry.is_regular_file());
    });
  }

  void make_folder(const std::string &directory)
  {
    std::error_code error;
    fs::create_directories(directory, error);
    const auto is = [&](const std::errc what) { return error == std::make_error_condition(what); };
    if (is(std::errc::not_a_directory) || is(std::errc::file_exists) || is(std::errc::filename_too_long) ||
        is(std::errc::too_many_symbolic_link_levels))
      throw std::invalid_argument("the folder '" + directory + "' cannot be made: " + error.message() +
                                  "; name another; nothing was written");
    if (error)
      throw std::runtime_error("the folder '" + directory + "' cannot be made: " + error.message());
    if (access(directory.c_str(), W_OK) != 0)
      throw std::runtime_error("the folder '" + directory + "' cannot be written to: " + std::strerror(errno) +
                               "; nothing was written");
  }

  FolderLock::FolderLock(const std::string &directory)
      : directory(directory),
        file((fs::path(directory) / folder_lock_name).string()),
        made(missing_folders(directory))
  {
    try
      {
        make_folder(directory);
        folder = open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        if (folder < 0)
          fail(directory, errno);
        take();
      }
    catch (const std::exception &)
      {
        unlock();
        throw;
      }
    held().insert(this);
    discrete::set_write_guard(demand_here);
    const std::string name = own_name() + "\n";
    if (ftruncate(descriptor, 0) != 0 || write(descriptor, name.data(), name.size()) < 0)
      {} // the name is for people; the lock holds without it, on a full disk, too
  }

  void FolderLock::take()
  {
    const auto until   = std::chrono::steady_clock::now() + patience;
    bool       is_told = false;
    Attempt    attempt = lock();
    for (; attempt != Attempt::locked; attempt = lock())
      {
        if (attempt == Attempt::again)
          continue;
        if (std::chrono::steady_clock::now() > until)
          throw being_written_to(directory, owner_of(file) + ", which is gone, by programs that it started");
        if (!is_told)
          std::cerr << "waiting for the programs of " << owner_of(file) << ", which is gone, to end in " << directory
                    << std::endl;
        is_told = true;
        leave_if_stopped("waiting for the programs of " + owner_of(file));
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
      }
    hold_in_programs(descriptor);
  }

  FolderLock::Attempt FolderLock::lock()
  {
    descriptor = openat(folder, folder_lock_name, O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (descriptor < 0)
      fail(directory, errno);
    const int error = flock(descriptor, LOCK_EX | LOCK_NB) == 0 ? 0 : errno;
    if (error == 0 && has_its_name())
      return Attempt::locked;
    close(descriptor);
    descriptor = -1;
    if (error == 0)
      return Attempt::again;
    if (error != EWOULDBLOCK)
      fail(directory, error);
    if (is_gone(owner_of(file)))
      return Attempt::bereaved;
    throw being_written_to(directory, owner_of(file));
  }

  void demand_not_written_to(const std::string &directory)
  {
    const std::string file   = (fs::path(directory) / folder_lock_name).string();
    const int         opened = open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (opened < 0)
      return;
    const bool is_held = flock(opened, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    close(opened);
    if (is_held)
      throw being_written_to(directory, owner_of(file));
  }

  FolderLock::~FolderLock()
  {
    held().erase(this);
    no_longer_hold_in_programs(descriptor);
    if (has_its_name())
      unlinkat(folder, folder_lock_name, 0); // wherever the folder is by now
    unlock();
  }

  void FolderLock::unlock()
  {
    if (folder < 0 || is_here())
      remove_made();
    for (const int opened : {descriptor, folder})
      if (opened >= 0)
        close(opened);
  }

  bool FolderLock::has_its_name() const
  {
    struct stat opened = {}, named = {};
    return fstat(descriptor, &opened) == 0 && fstatat(folder, folder_lock_name, &named, 0) == 0 && opened.st_ino == named.st_ino;
  }

  bool FolderLock::is_here() const
  {
    struct stat locked = {}, named = {};
    return fstat(folder, &locked) == 0 && stat(directory.c_str(), &named) == 0 && locked.st_ino == named.st_ino &&
           locked.st_dev == named.st_dev;
  }

  void FolderLock::demand_here(const std::string &file)
  {
    for (const FolderLock *lock : held())
      if (file.rfind(lock->directory + "/", 0) == 0 && !lock->is_here())
        throw FolderGone("the folder '" + lock->directory + "' is no longer the one that this run locked: it was renamed, " +
                         "removed or replaced; what was written until then is kept where it is now, and " + file +
                         " was not written");
  }

  void FolderLock::remove_made() const
  {
    std::error_code not_empty;
    for (const std::string &folder : made)
      if (!fs::remove(folder, not_empty))
        return;
  }
} // namespace diptych::coupling
