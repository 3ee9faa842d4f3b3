// diptych: identity of a scene: all data that decide its results
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/scene/identity.h"

#include <cstdio>
#include <filesystem>
#include <iterator>
#include <set>
#include <vector>

#include "coupling/scene/keys.h"
#include "discrete/files/text_file.h"

namespace diptych::coupling
{
  namespace
  {
    // {seed} in the path of an imported sample.
    std::string with_seed(std::string path, const int seed)
    {
      if (const std::size_t mark = path.find("{seed}"); mark != std::string::npos)
        path.replace(mark, 6, std::to_string(seed));
      return path;
    }

    const std::set<std::string> without_effect = {"discrete/checkpoint_minutes", "discrete/store_problems",
                                                  "continuum/checkpoint_minutes"};

    std::string digest(const std::string &path)
    {
      if (path.empty())
        return "";
      if (!std::filesystem::exists(path))
        return "no file";
      return "content " + std::to_string(digest_of(discrete::read_text(path)));
    }

    struct Values
    {
      std::string section;
      Identity   &identity;

      template <class Number> void operator()(const char *name, const Number &value, const char *, Range, const char *) const
      {
        put(name, text_of(value));
      }
      void operator()(const char *prefix, const continuum::LawParameters &parameters, const char *, const char *) const
      {
        for (const continuum::LawParameter &one : parameters.list)
          put(prefix + one.name, text_of(one.value));
      }
      template <class Value> void operator()(const char *name, Value value, const char *, const char *) const
      {
        if (std::string *file = file_of(value))
          *file = digest(*file);
        put(name, text_of(value));
      }

    private:
      void put(const std::string &name, const std::string &value) const
      {
        if (const std::string key = section + "/" + name; without_effect.count(key) == 0)
          identity[key] = value;
      }
    };

    Identity of_sections(const Scene &scene, const std::set<std::string> &wanted)
    {
      Identity identity;
      Scene    copy             = scene;
      copy.discrete.method.file = with_seed(scene.discrete.method.file, scene.sample.seed);
      for_each_section(copy, [&](const std::string &section, auto &options) {
        if (wanted.count(section) > 0)
          visit_parameters(options, Values{section, identity});
      });
      return identity;
    }

    struct NamedFiles
    {
      std::string                                       section;
      std::vector<std::pair<std::string, std::string>> &files;

      template <class Number> void operator()(const char *, const Number &, const char *, Range, const char *) const {}
      template <class Value> void  operator()(const char *name, Value value, const char *, const char *) const
      {
        if (const std::string *file = file_of(value); file != nullptr && !file->empty())
          files.emplace_back(section + "/" + name, *file);
      }
    };
  } // namespace

  std::vector<std::pair<std::string, std::string>> input_files(const Scene &scene)
  {
    std::vector<std::pair<std::string, std::string>> files;
    Scene                                            copy = scene;
    for_each_section(copy, [&](const std::string &section, auto &options) {
      visit_parameters(options, NamedFiles{section, files});
    });
    for (auto &[key, file] : files)
      file = with_seed(file, scene.sample.seed);
    return files;
  }

  std::uint64_t digest_on(std::uint64_t digest, const std::string_view bytes)
  {
    for (const char byte : bytes)
      digest = (digest ^ std::uint8_t(byte)) * 1099511628211ull;
    return digest;
  }

  std::uint64_t digest_of(const std::string_view bytes)
  {
    return digest_on(empty_digest, bytes);
  }

  std::string hexadecimal(const std::uint64_t digest)
  {
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(digest));
    return digits;
  }

  Identity sample_identity(const Scene &scene)
  {
    return of_sections(scene, {"sample", "loading", "discrete"});
  }

  Identity continuum_identity(const Scene &scene)
  {
    Identity          identity = of_sections(scene, {"sample", "loading", "discrete", "continuum"});
    const std::string coarse   = "comparison/coarse_element_size";
    identity[coarse]           = of_sections(scene, {"comparison"}).at(coarse);
    return identity;
  }

  Identity member_identity(const Scene &scene)
  {
    Identity identity = of_sections(scene, {"sample", "loading", "discrete", "continuum", "comparison"});
    identity.erase("sample/seed");
    for (auto value = identity.begin(); value != identity.end();)
      value = value->first.rfind("comparison/margin_", 0) == 0 ? identity.erase(value) : std::next(value);
    return identity;
  }

  std::string text_of(const Identity &identity)
  {
    std::string text;
    for (const auto &[key, value] : identity)
      text += key + " = " + value + '\n';
    return text;
  }

  std::string first_difference(const Identity &here, const Identity &there)
  {
    for (const auto &[key, value] : here)
      if (const auto other = there.find(key); other == there.end() || other->second != value)
        return key + ": '" + value + "' in the scene, " + (other == there.end() ? "not set" : "'" + other->second + "'") +
               " in the folder";
    return "";
  }
} // namespace diptych::coupling
