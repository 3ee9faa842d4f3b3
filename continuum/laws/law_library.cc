// diptych: a shared library that holds a law of the user
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/law_library.h"

#include <algorithm>
#include <cctype>
#include <csignal>
#include <filesystem>
#include <map>
#include <mutex>
#include <set>

#include <dlfcn.h>
#include <unistd.h>

#include "continuum/require.h"

namespace diptych::continuum
{
  namespace
  {
    template <class... Text> void require_library(const bool holds, const std::string &path, const Text &...text)
    {
      require_keys(holds, {"law_library"}, "law_library = ", path, ' ', text...);
    }

    void *opened(const std::string &path)
    {
      require_keys(!path.empty(), {"law_library", "law"}, "law = library needs law_library, the path of a shared library");
      std::error_code none;
      require_library(std::filesystem::is_regular_file(path, none), path,
                      "is not a file. Build it: cc -shared -fPIC -O2 -I/usr/include/diptych -o mylaw.so mylaw.c");
      void       *handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
      const char *error  = handle == nullptr ? dlerror() : nullptr;
      require_library(handle != nullptr, path, "cannot be opened: ", error == nullptr ? "unknown reason" : error,
                      ". It must be a shared library for this machine (cc -shared -fPIC)");
      return handle;
    }

    template <class Function> Function found(void *handle, const std::string &path, const char *name, const bool is_needed = true)
    {
      void *symbol = dlsym(handle, name);
      require_library(symbol != nullptr || !is_needed, path, "has no function ", name,
                      ". Define it as diptych_law.h declares it; in C++ inside extern \"C\" { }");
      return reinterpret_cast<Function>(symbol);
    }

    template <class Entry>
    void check_names(const std::string &path, const char *kind, const Entry *entries, const int n, const int most)
    {
      require_library(n >= 0 && n <= most && (n == 0 || entries != nullptr), path, "describes ", n, ' ', kind, "s; 0 to ", most,
                      " are possible");
      std::set<std::string> names;
      for (int k = 0; k < n; ++k)
        {
          const std::string name = entries[k].name == nullptr ? "" : entries[k].name;
          const bool        good = !name.empty() && std::all_of(name.begin(), name.end(),
                                                                [](const unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
          require_library(good && names.insert(name).second, path, "names ", kind, ' ', k + 1, " '", name,
                          "'; a name has letters, digits and _, and occurs once");
          require_library(entries[k].unit != nullptr && entries[k].meaning != nullptr, path, "gives ", kind, " '", name,
                          "' no unit or no meaning");
        }
    }

    void check_law(const std::string &path, const diptych_law *law)
    {
      constexpr int most_parameters = 1000;
      require_library(law != nullptr, path, "describes no law: diptych_law_describe returns a null pointer");
      require_library(law->interface_version == DIPTYCH_LAW_INTERFACE, path, "has interface version ", law->interface_version,
                      "; this program needs ", DIPTYCH_LAW_INTERFACE,
                      ". Compile it again with the diptych_law.h of this program");
      require_library(law->n_components == 3 || law->n_components == 6, path, "has ", law->n_components,
                      " components; 3, or 6 for a Cosserat law");
      check_names(path, "parameter", law->parameters, law->n_parameters, most_parameters);
      check_names(path, "state variable", law->variables, law->n_variables, DIPTYCH_MOST_VARIABLES);
      for (int k = 0; k < law->n_parameters; ++k)
        {
          const diptych_parameter &p = law->parameters[k];
          require_library(p.usual >= p.least && p.usual <= p.greatest, path, "gives parameter '", p.name, "' the usual value ",
                          p.usual, " outside its range [", p.least, ", ", p.greatest, "]");
        }
    }

    std::vector<unsigned int> tensors_of(const std::string &path, const diptych_law &law)
    {
      std::vector<unsigned int> tensors;
      int                       end = 0; // of the last tensor
      for (int k = 0; k < law.n_variables; ++k)
        if (law.variables[k].kind == DIPTYCH_TENSOR)
          {
            require_library(k >= end && k + 3 <= law.n_variables, path, "declares variable '", law.variables[k].name,
                            "' as a tensor, which needs three variables xx, yy, xy of its own");
            tensors.push_back(unsigned(k));
            end = k + 3;
          }
      return tensors;
    }

    std::string last_words; // of a crash; complete before tell_of_crash() may run

    void tell_of_crash(int)
    {
      (void)!write(STDERR_FILENO, last_words.data(), last_words.size());
    }

    // After these words the signal ends the process as it would without them.
    void name_in_a_crash(const std::string &path)
    {
      last_words += "diptych: a crash ends this program, which uses the law library " + path +
                    "; a run keeps its finished stages and its last checkpoint\n";
      struct sigaction action = {};
      action.sa_handler       = tell_of_crash;
      action.sa_flags         = int(SA_RESETHAND);
      for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
        sigaction(signal, &action, nullptr);
    }

    LawLibrary library_at(const std::string &path)
    {
      void *handle = opened(path);
      name_in_a_crash(path);
      LawLibrary library;
      library.update      = found<decltype(library.update)>(handle, path, "diptych_law_update");
      library.start       = found<decltype(library.start)>(handle, path, "diptych_law_start", false);
      const auto describe = found<decltype(&diptych_law_describe)>(handle, path, "diptych_law_describe");
      library.law         = describe();
      check_law(path, library.law);
      library.tensors = tensors_of(path, *library.law);
      return library;
    }
  } // namespace

  const LawLibrary &law_library(const std::string &path)
  {
    static std::mutex                        mutex;
    static std::map<std::string, LawLibrary> open;
    const std::lock_guard                    lock(mutex);
    const auto                               known = open.find(path);
    return known != open.end() ? known->second : open.emplace(path, library_at(path)).first->second;
  }

  std::vector<std::string> variable_names(const LawLibrary &library)
  {
    std::vector<std::string> names;
    for (int k = 0; k < library.law->n_variables; ++k)
      names.push_back(LawParameters::prefix + std::string(library.law->variables[k].name));
    return names;
  }

  void complete(LibraryOptions &options)
  {
    const LawLibrary &library = law_library(options.file.path);
    LawParameters     all;
    std::string       names;
    for (int k = 0; k < library.law->n_parameters; ++k)
      {
        const diptych_parameter &p = library.law->parameters[k];
        LawParameter             one{p.name, p.usual, p.unit, p.meaning, {p.least, p.greatest}};
        if (const LawParameter *given = options.parameters.find(p.name))
          one.value = given->value;
        require_keys(one.value >= p.least && one.value <= p.greatest, {LawParameters::prefix + one.name, "law_library"},
                     LawParameters::prefix, one.name, " = ", one.value, " must lie in [", p.least, ", ", p.greatest, "] ",
                     one.unit);
        names += (names.empty() ? "" : ", ") + (LawParameters::prefix + one.name);
        all.list.push_back(std::move(one));
      }
    for (const LawParameter &given : options.parameters.list)
      require_keys(all.find(given.name) != nullptr, {LawParameters::prefix + given.name, "law_library"}, LawParameters::prefix,
                   given.name, " is not a parameter of ", options.file.path, "; it has ", names.empty() ? "none" : names);
    options.parameters  = std::move(all);
    options.is_cosserat = library.is_cosserat();
  }
} // namespace diptych::continuum
