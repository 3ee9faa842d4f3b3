// diptych: one writer of a folder at a time
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace diptych::coupling
{
  // Locks a folder for this process as long as the object lives. A folder that does not exist is made, and removed again if it
  // stays empty. The lock is the system's (flock) on the file .diptych.lock in the folder, which names process and machine. It
  // ends with the process and with the workers that the process has started.
  class FolderLock
  {
  public:
    // Waits up to 90 s for the workers of a process that was killed. Throws std::runtime_error naming the folder and its
    // writer, or the system's reason; std::invalid_argument for a name that no folder can have; StoppedOnRequest while it waits.
    explicit FolderLock(const std::string &directory);
    ~FolderLock();
    FolderLock(const FolderLock &)            = delete;
    FolderLock &operator=(const FolderLock &) = delete;

    const std::string &folder() const { return directory; }
    int                number() const { return descriptor; } // file descriptor of the lock

    // Renames the folder to `aside` and goes on with a new, locked folder in its place. Throws std::runtime_error.
    void set_aside(const std::string &aside);

  private:
    bool try_lock();
    void take();
    void give_back(const std::string &folder);

    std::string directory;
    bool        was_made   = false;
    int         descriptor = -1;
  };

  // Throws std::runtime_error naming the writer where another process has locked the folder.
  void require_unlocked(const std::string &directory);

  // No file but a lock and what a killed run has left unfinished (.part).
  bool is_empty_folder(const std::string &directory);

  // Makes a folder that can be written to. Throws as FolderLock does.
  void make_folder(const std::string &directory);
} // namespace diptych::coupling
