// diptych: one writer of a folder at a time
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace diptych::coupling
{
  // A folder that a run has locked was renamed, removed or replaced: names it, and the file that was not written.
  struct FolderGone : std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };

  // Held as long as it lives: the folder is this process's to write to. The file `folder_lock_name` in it names process and
  // machine; what holds is the system's lock on that file (flock), which ends with the process and the programs that it has
  // started, however they end: what a killed one leaves is stale, and taken over once its programs, which are asked to stop with
  // it, have ended. A folder that is not there is made, and removed again if nothing has come into it. Files are written by their
  // paths: where such a path comes to lead into another folder than the one that was locked, none is written (FolderGone).
  class FolderLock
  {
  public:
    // Waits for programs of a process that is gone, longer than they have to end. Throws std::runtime_error naming the folder and
    // who writes to it, or what the system says, StoppedOnRequest where it is asked to stop while it waits.
    explicit FolderLock(const std::string &directory);
    ~FolderLock();
    FolderLock(const FolderLock &)            = delete;
    FolderLock &operator=(const FolderLock &) = delete;

  private:
    enum class Attempt
    {
      locked,
      again,   // the one that held it has removed the file meanwhile
      bereaved // programs of a process that is gone hold it
    };
    Attempt lock();
    void    take();
    void    remove_made() const;
    void    unlock();
    bool    has_its_name() const; // the file that is locked stands in the folder
    bool    is_here() const;      // the path still leads to the folder

    static void demand_here(const std::string &file); // of the folder of any lock that is held

    std::string              directory, file;
    std::vector<std::string> made;                         // folders, the innermost first
    int                      folder = -1, descriptor = -1; // opened
  };

  extern const char *const folder_lock_name;

  // Throws std::runtime_error where somebody writes to the folder; nothing is changed.
  void demand_not_written_to(const std::string &directory);

  // Nothing but a lock is in it, and what a killed run had begun to write (.part): its first file has no other name yet.
  bool is_empty_folder(const std::string &directory);

  // Makes a folder that can be written to. Throws std::runtime_error naming it and what the system says.
  void make_folder(const std::string &directory);
} // namespace diptych::coupling
