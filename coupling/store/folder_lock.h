// diptych: one writer of a folder at a time
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace diptych::coupling
{
  // Locks a folder for this process as long as the object lives. Makes the folder if it does not exist, and removes such a folder
  // if it stays empty. The lock is a flock() on the file .diptych.lock in the folder, which names process and machine. The system
  // releases it when the process and all workers that it started have ended.
  class FolderLock
  {
  public:
    // Waits up to 90 s for the workers of a process that was killed. Throws std::runtime_error with the folder and its writer, or
    // with the system's message. Throws std::invalid_argument if no folder can have this name, and StoppedOnRequest on a stop
    // signal.
    explicit FolderLock(const std::string &directory);
    ~FolderLock();
    FolderLock(const FolderLock &)            = delete;
    FolderLock &operator=(const FolderLock &) = delete;

    const std::string &folder() const { return directory; }
    int                number() const { return descriptor; } // file descriptor of the lock

    // Renames the folder to `aside` and makes a new, locked folder in its place. Throws std::runtime_error.
    void set_aside(const std::string &aside);

  private:
    bool try_lock();
    void take();
    void give_back(const std::string &folder);

    std::string directory;
    bool        was_made   = false;
    int         descriptor = -1;
  };

  // Throws std::runtime_error with the name of the writer if another process has locked the folder.
  void require_unlocked(const std::string &directory);

  // True if the folder holds no files, apart from a lock and unfinished files (.part) of a killed run.
  bool is_empty_folder(const std::string &directory);

  // Makes a folder and checks that files can be written to it. Throws like FolderLock.
  void make_folder(const std::string &directory);
} // namespace diptych::coupling
