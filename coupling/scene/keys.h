// diptych: describes keys and sets a key from a text
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "continuum/options.h"
#include "coupling/scene/element_path.h"
#include "discrete/panel/options.h"

namespace diptych::coupling
{
  using Range = std::array<double, 2>;

  // file_of(value): the name of a file that a value holds; nullptr if it holds none.
  struct FileOf
  {
    std::string *operator()(discrete::FileName &value) const { return &value.path; }
    std::string *operator()(continuum::LibraryFile &value) const { return &value.path; }
    std::string *operator()(discrete::DriveOption &value) const { return value.names_a_file() ? &value.value : nullptr; }
    std::string *operator()(continuum::MeshOption &value) const { return value.names_a_file() ? &value.file : nullptr; }
    std::string *operator()(PathOption &value) const { return value.names_a_file() ? &value.text : nullptr; }
    template <class Value> std::string *operator()(Value &) const { return nullptr; }
  };
  constexpr FileOf file_of;

  template <class Value>
  constexpr bool is_file_name = std::is_same_v<Value, discrete::FileName> || std::is_same_v<Value, continuum::LibraryFile>;

  struct KeyDescription
  {
    std::string              section, name, value, unit, allowed, meaning;
    std::vector<std::string> choices; // the allowed values, if the key has only a few

    std::string full_name() const { return section + "/" + name; }
  };

  // The shortest text that reads back as the same number. All files and messages use it.
  std::string        text_of(double value);
  std::string        text_of(const std::optional<double> &value); // or auto
  std::string        text_of(const std::vector<double> &values);  // separated by ", "
  inline std::string text_of(const bool value)
  {
    return value ? "true" : "false";
  }
  inline std::string text_of(const int value)
  {
    return std::to_string(value);
  }
  inline std::string text_of(const std::string &value)
  {
    return value;
  }
  template <class E, std::enable_if_t<std::is_enum_v<E>, int> = 0> std::string text_of(const E value)
  {
    return discrete::name_of(value);
  }

  template <class File, std::enable_if_t<is_file_name<File>, int> = 0> std::string text_of(const File &file)
  {
    return file.path;
  }

  // All allowed values of a choice; empty for other types.
  template <class Value> std::vector<std::string> choices_of(const Value &value)
  {
    std::vector<std::string> names;
    if constexpr (std::is_same_v<Value, bool>)
      names = {"true", "false"};
    else if constexpr (std::is_enum_v<Value>)
      for (const auto &choice : choices(value))
        names.emplace_back(choice.second);
    return names;
  }

  std::string        allowed_number(const Range &range);
  inline std::string allowed_value(const bool)
  {
    return "true or false";
  }
  inline std::string allowed_value(const std::string &)
  {
    return "any text";
  }
  template <class File, std::enable_if_t<is_file_name<File>, int> = 0> std::string allowed_value(const File &)
  {
    return "the name of a file";
  }
  inline std::string allowed_value(const discrete::DriveOption &)
  {
    return "auto, velocity V or force F, where V and F are a number or the name of a CSV file";
  }
  inline std::string allowed_value(const continuum::MeshOption &)
  {
    return "outline, rectangle or a .msh or .geo file";
  }
  inline std::string allowed_value(const PathOption &)
  {
    return "drained, constant_volume, constant_mean_stress, simple_shear or the name of a CSV file";
  }
  template <class E, std::enable_if_t<std::is_enum_v<E>, int> = 0> std::string allowed_value(const E value)
  {
    std::string text;
    for (const std::string &name : choices_of(value))
      text += (text.empty() ? "one of " : ", ") + name;
    return text;
  }

  struct DescribeKeys
  {
    std::string                  section;
    std::vector<KeyDescription> &keys;

    template <class Number>
    void operator()(const char *name, const Number &value, const char *unit, const Range range, const char *meaning) const
    {
      std::string allowed = allowed_number(range);
      if constexpr (std::is_same_v<Number, int>)
        allowed = "a whole " + allowed.substr(2);
      if constexpr (std::is_same_v<Number, std::optional<double>>)
        allowed = "auto or " + allowed;
      if constexpr (std::is_same_v<Number, std::vector<double>>)
        allowed = "a list of numbers" + allowed.substr(std::string("a number").size());
      add(name, value, unit, meaning).allowed = allowed;
    }
    void operator()(const char *prefix, const continuum::LawParameters &parameters, const char *, const char *) const
    {
      for (const continuum::LawParameter &one : parameters.list)
        add(prefix + one.name, one.value, one.unit, one.meaning).allowed = allowed_number(one.range);
    }
    template <class Value> void operator()(const char *name, const Value &value, const char *unit, const char *meaning) const
    {
      KeyDescription &key = add(name, value, unit, meaning);
      key.allowed         = allowed_value(value);
      key.choices         = choices_of(value);
    }

  private:
    template <class Value>
    KeyDescription &add(const std::string &name, const Value &value, const std::string &unit, const std::string &meaning) const
    {
      KeyDescription &key = keys.emplace_back();
      key.section         = section;
      key.name            = name;
      key.value           = text_of(value);
      key.unit            = unit;
      key.meaning         = meaning;
      return key;
    }
  };

  // Reads a text as a value; empty if it is not one. Numbers have a decimal point in every locale.
  std::optional<double>              read_number(const std::string &text, const Range &range);
  std::optional<int>                 read_whole(const std::string &text, const Range &range);
  std::optional<std::vector<double>> read_list(const std::string &text, const Range &range);

  // Absolute path of a file that a key names; empty stays empty.
  std::string resolved(const std::string &path, const std::string &folder);

  // Sets the key `name` to `text`. Relative file names refer to `folder`. After a visit, `found` is true if the key exists, and
  // `good` if the text is an allowed value.
  struct SetKey
  {
    std::string name, text, folder;
    bool        found = false, good = false;

    template <class Number> void operator()(const char *key, Number &value, const char *, const Range range, const char *)
    {
      if (!is_mine(key))
        return;
      if constexpr (std::is_same_v<Number, int>)
        take(read_whole(text, range), value);
      else if constexpr (std::is_same_v<Number, std::vector<double>>)
        take(read_list(text, range), value);
      else if (std::is_same_v<Number, std::optional<double>> && text == "auto")
        {
          value = Number();
          good  = true;
        }
      else if (const std::optional<double> number = read_number(text, range))
        {
          value = *number;
          good  = true;
        }
    }
    void operator()(const char *key, const discrete::FileName &file, const char *, const char *)
    {
      if (is_mine(key))
        {
          file.path = resolved(text, folder);
          good      = true;
        }
    }
    void operator()(const char *key, continuum::LibraryFile &file, const char *, const char *)
    {
      if (is_mine(key))
        take(std::optional<std::string>(resolved(text, folder)), file.path);
    }
    // Accepts every name: only the library knows its parameters.
    void operator()(const char *prefix, continuum::LawParameters &parameters, const char *, const char *)
    {
      const std::size_t length = std::string(prefix).size();
      if (name.size() <= length || name.compare(0, length, prefix) != 0)
        return;
      found = true;
      if (const std::optional<double> number = read_number(text, continuum::LawParameter().range))
        {
          parameters.set(name.substr(length), *number);
          good = true;
        }
    }
    void operator()(const char *key, bool &value, const char *, const char *)
    {
      if (is_mine(key) && (text == "true" || text == "false"))
        {
          value = text == "true";
          good  = true;
        }
    }
    void operator()(const char *key, std::string &value, const char *, const char *)
    {
      if (is_mine(key))
        {
          value = text;
          good  = true;
        }
    }
    void operator()(const char *key, discrete::DriveOption &value, const char *, const char *) { take_text(key, value); }
    void operator()(const char *key, continuum::MeshOption &value, const char *, const char *) { take_text(key, value); }
    void operator()(const char *key, PathOption &value, const char *, const char *) { take_text(key, value); }
    template <class E, std::enable_if_t<std::is_enum_v<E>, int> = 0>
    void operator()(const char *key, E &value, const char *, const char *)
    {
      if (is_mine(key))
        take(discrete::value_of<E>(text), value);
    }

  private:
    bool is_mine(const std::string &key)
    {
      found = found || key == name;
      return key == name;
    }
    template <class Value> void take_text(const char *key, Value &value)
    {
      if (!is_mine(key) || text.empty())
        return;
      try
        {
          value = Value{text};
          if (std::string *file = file_of(value))
            *file = resolved(*file, folder);
          good = true;
        }
      catch (const std::invalid_argument &)
        {} // `good` stays false
    }
    template <class Value> void take(const std::optional<Value> &read, Value &value)
    {
      if (read)
        {
          value = *read;
          good  = true;
        }
    }
  };
} // namespace diptych::coupling
