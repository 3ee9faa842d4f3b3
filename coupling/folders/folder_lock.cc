// diptych: one writer of a folder at a time
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/folders/folder_lock.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <stdexcept>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "discrete/files/text_file.h"

namespace diptych::coupling
{
  namespace
  {
    namespace fs = std::filesystem;

    std::string own_name()
    {
      char host[256] = "";
      gethostname(host, sizeof host - 1);
      const std::time_t now        = std::time(nullptr);
      char              moment[32] = "";
      std::strftime(moment, sizeof moment, "%Y-%m-%d %H:%M:%S UTC", std::gmtime(&now));
      return "process " + std::to_string(getpid()) + " on " + host + " since " + moment;
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
      throw std::runtime_error("the folder '" + directory + "' cannot be written to: " + std::strerror(errno));
  }

  FolderLock::FolderLock(const std::string &directory)
      : directory(directory),
        file((fs::path(directory) / folder_lock_name).string()),
        made(missing_folders(directory))
  {
    try
      {
        make_folder(directory);
        while (!lock())
          {}
      }
    catch (const std::exception &)
      {
        remove_made();
        throw;
      }
    const std::string name = own_name() + "\n";
    if (ftruncate(descriptor, 0) != 0 || write(descriptor, name.data(), name.size()) < 0)
      {} // the name is for people; the lock holds without it, on a full disk, too
  }

  // False where the one that held it has removed the file meanwhile.
  bool FolderLock::lock()
  {
    descriptor = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (descriptor < 0)
      fail(directory, errno);
    struct stat opened = {}, named = {};
    int         error = flock(descriptor, LOCK_EX | LOCK_NB) == 0 ? 0 : errno;
    if (error == 0 && fstat(descriptor, &opened) == 0 && stat(file.c_str(), &named) == 0 && opened.st_ino == named.st_ino)
      return true;
    close(descriptor);
    descriptor = -1;
    if (error == 0)
      return false;
    if (error != EWOULDBLOCK)
      fail(directory, error);
    std::string owner = discrete::read_text(file);
    owner.erase(std::remove(owner.begin(), owner.end(), '\n'), owner.end());
    throw std::runtime_error("the folder '" + directory + "' is being written to by " + (owner.empty() ? "another run" : owner) +
                             "; wait for it or name another folder; nothing was written");
  }

  FolderLock::~FolderLock()
  {
    unlink(file.c_str());
    close(descriptor);
    remove_made();
  }

  void FolderLock::remove_made() const
  {
    std::error_code not_empty;
    for (const std::string &folder : made)
      if (!fs::remove(folder, not_empty))
        return;
  }
} // namespace diptych::coupling
