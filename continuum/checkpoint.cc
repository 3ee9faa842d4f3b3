// diptych: the continuum panel put down in a file, to be taken up again
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/checkpoint.h"

#include "continuum/hdf5_access.h"

namespace diptych::continuum
{
  namespace
  {
    const std::string format = "diptych continuum checkpoint 1";

    void write_text(const hid_t file, const std::string &name, const std::string &text)
    {
      hdf5::write(file, name, {text.size()}, std::vector<char>(text.begin(), text.end()));
    }

    std::string read_text(const hid_t file, const std::string &name)
    {
      const auto text = hdf5::read<char>(file, name);
      return std::string(text.begin(), text.end());
    }

    // Every entry ends with a line break.
    void write_lines(const hid_t file, const std::string &name, const std::vector<std::string> &lines)
    {
      std::string text;
      for (const std::string &line : lines)
        text += line + '\n';
      write_text(file, name, text);
    }

    std::vector<std::string> read_lines(const hid_t file, const std::string &name)
    {
      const std::string        text = read_text(file, name);
      std::vector<std::string> lines;
      for (std::size_t begin = 0, end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1)
        lines.push_back(text.substr(begin, end - begin));
      return lines;
    }

    template <class T> void write_map(const hid_t file, const std::string &name, const std::map<std::string, T> &map)
    {
      std::vector<std::string> keys;
      std::vector<T>           values;
      for (const auto &[key, value] : map)
        {
          keys.push_back(key);
          values.push_back(value);
        }
      write_lines(file, name + "/names", keys);
      hdf5::write(file, name + "/values", {values.size()}, values);
    }

    template <class T> std::map<std::string, T> read_map(const hid_t file, const std::string &name)
    {
      const auto keys   = read_lines(file, name + "/names");
      const auto values = hdf5::read<T>(file, name + "/values");
      if (keys.size() != values.size())
        throw std::runtime_error(name + " holds " + std::to_string(keys.size()) + " names for " + std::to_string(values.size()) +
                                 " values");
      std::map<std::string, T> map;
      for (std::size_t k = 0; k < keys.size(); ++k)
        map[keys[k]] = values[k];
      return map;
    }

    void require_one_line(const std::string &text)
    {
      if (text.find('\n') != std::string::npos)
        throw std::invalid_argument("checkpoint: line break in '" + text + "'");
    }

    void validate(const Checkpoint &c)
    {
      if (c.values.size() != c.cells.size() * c.values_per_cell)
        throw std::invalid_argument("checkpoint: " + std::to_string(c.values.size()) + " values for " +
                                    std::to_string(c.cells.size()) + " cells of " + std::to_string(c.values_per_cell));
      for (const std::string &cell : c.cells)
        require_one_line(cell);
      for (const auto &scalar : c.scalars)
        require_one_line(scalar.first);
      for (const auto &count : c.counts)
        require_one_line(count.first);
    }

    template <class T> std::size_t n_bytes(const std::map<std::string, T> &map)
    {
      std::size_t n = 0;
      for (const auto &entry : map)
        n += entry.first.size() + 1 + sizeof(T);
      return n;
    }

    std::size_t n_bytes(const Checkpoint &c)
    {
      std::size_t n = c.fingerprint.size() + c.values.size() * sizeof(double) + n_bytes(c.scalars) + n_bytes(c.counts);
      for (const std::string &cell : c.cells)
        n += cell.size() + 1;
      return n;
    }

    Checkpoint read_contents(const hid_t file)
    {
      if (!hdf5::exists(file, "format") || read_text(file, "format") != format)
        throw std::runtime_error("is no '" + format + "'");
      Checkpoint c;
      c.fingerprint      = read_text(file, "fingerprint");
      c.cells            = read_lines(file, "cells/ids");
      c.values           = hdf5::read<double>(file, "cells/values");
      const auto extents = hdf5::extents_of(file, "cells/values");
      if (extents.size() != 2 || extents[0] != c.cells.size())
        throw std::runtime_error("cells/values has not one row for each of " + std::to_string(c.cells.size()) + " cells");
      c.values_per_cell = extents[1];
      c.scalars         = read_map<double>(file, "scalars");
      c.counts          = read_map<long long>(file, "counts");
      return c;
    }
  } // namespace

  void write_checkpoint(const std::string &file, const Checkpoint &c)
  {
    validate(c);
    hdf5::write_file(file, hdf5::Start::empty, hdf5::room_for(n_bytes(c)), [&](const hid_t to) {
      write_text(to, "format", format);
      write_text(to, "fingerprint", c.fingerprint);
      write_lines(to, "cells/ids", c.cells);
      hdf5::write(to, "cells/values", {c.cells.size(), c.values_per_cell}, c.values);
      write_map(to, "scalars", c.scalars);
      write_map(to, "counts", c.counts);
    });
  }

  Checkpoint read_checkpoint(const std::string &file)
  {
    return hdf5::read_file(file, read_contents);
  }
} // namespace diptych::continuum
