// diptych: checkpoint file of the continuum panel
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/store/continuum_checkpoint_file.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <type_traits>

#include "discrete/files/hdf5_file.h"

namespace diptych::coupling
{
  namespace
  {
    using discrete::Hdf5Reader;
    using discrete::Hdf5Writer;
    using Lines = std::vector<std::string>;

    constexpr double  most_count = 1e9;
    const char       *length     = "length";
    const char       *law_states = "values"; // of nodes and points
    const std::string format     = "diptych continuum checkpoint 4";

    // Cells' names hold no blank.
    std::string text_of(const Lines &lines)
    {
      std::string text;
      for (const std::string &line : lines)
        text += line + ' ';
      return text;
    }

    Lines split(const std::string &text)
    {
      Lines lines;
      for (std::size_t begin = 0, end; (end = text.find(' ', begin)) != std::string::npos; begin = end + 1)
        lines.push_back(text.substr(begin, end - begin));
      return lines;
    }

    std::string numbered(const std::string &name, const std::size_t k)
    {
      return name + "/" + std::to_string(k);
    }

    // A file holds every entry under its name: numbers as attributes of the root, the rest as datasets that say how long they
    // are: what came to be shorter is refused before the mesh is there that would show it.
    struct Put
    {
      Hdf5Writer &file;

      void operator()(const std::string &name, const double value) const { file.attribute("/", name, value); }
      void operator()(const std::string &name, const std::optional<double> &value) const
      {
        file.attribute("/", name, value ? std::vector<double>{1, *value} : std::vector<double>{0, 0});
      }
      void operator()(const std::string &name, const Eigen::Vector2d &value) const
      {
        file.attribute("/", name, std::vector<double>{value.x(), value.y()});
      }
      void operator()(const std::string &name, const std::vector<double> &values) const
      {
        file.write(name, values);
        file.attribute(name, length, double(values.size()));
      }
      void operator()(const std::string &name, const Lines &lines) const
      {
        const std::string text = text_of(lines);
        file.write_string(name, text);
        file.attribute(name, length, double(text.size()));
      }
      template <class T> void operator()(const std::string &name, const std::vector<std::vector<T>> &lists) const
      {
        (*this)(name + "_count", double(lists.size()));
        for (std::size_t k = 0; k < lists.size(); ++k)
          (*this)(numbered(name, k), lists[k]);
      }
    };

    struct Get
    {
      const Hdf5Reader &file;

      template <class Number, std::enable_if_t<std::is_arithmetic_v<Number>, int> = 0>
      void operator()(const std::string &name, Number &value) const
      {
        const double number = file.attribute("/", name);
        if (std::is_integral_v<Number> && !(number == std::floor(number) && std::abs(number) <= most_count))
          throw std::invalid_argument(file.path() + ": '" + name + "' is no whole number");
        demand_finite(name, {number});
        value = Number(number);
      }
      void operator()(const std::string &name, std::optional<double> &value) const
      {
        const std::vector<double> pair = numbers(name, 2);
        value                          = pair[0] == 1 ? std::optional<double>(pair[1]) : std::nullopt;
      }
      void operator()(const std::string &name, Eigen::Vector2d &value) const
      {
        const std::vector<double> pair = numbers(name, 2);
        value                          = {pair[0], pair[1]};
      }
      void operator()(const std::string &name, std::vector<double> &values) const
      {
        if (file.extents(name).size() != 1)
          throw std::invalid_argument(file.path() + ": '" + name + "' is no list");
        values = file.read(name);
        check_length(name, values.size());
        if (name != law_states) // which are the law's: what has no determinant yet has an infinite one
          demand_finite(name, values);
      }
      void operator()(const std::string &name, Lines &lines) const
      {
        const std::string text = file.read_string(name);
        check_length(name, text.size());
        lines = split(text);
      }
      template <class T> void operator()(const std::string &name, std::vector<std::vector<T>> &lists) const
      {
        int n = 0;
        (*this)(name + "_count", n);
        for (int k = 0; k < n; ++k) // not resized at once: the file may lie
          (*this)(numbered(name, std::size_t(k)), lists.emplace_back());
      }

    private:
      void demand_finite(const std::string &name, const std::vector<double> &values) const
      {
        if (!std::all_of(values.begin(), values.end(), [](const double value) { return std::isfinite(value); }))
          throw std::invalid_argument(file.path() + ": '" + name + "' holds a number that is not finite");
      }
      void check_length(const std::string &name, const std::size_t found) const
      {
        if (const double told = file.attribute(name, length); told != double(found))
          throw std::invalid_argument(file.path() + ": '" + name + "' holds " + std::to_string(found) + " values where " +
                                      std::to_string(std::llround(told)) + " were written");
      }
      std::vector<double> numbers(const std::string &name, const std::size_t n) const
      {
        std::vector<double> values = file.attributes("/", name);
        demand_finite(name, values);
        if (values.size() != n)
          throw std::invalid_argument(file.path() + ": '" + name + "' holds " + std::to_string(values.size()) + " numbers, not " +
                                      std::to_string(n));
        return values;
      }
    };
  } // namespace

  void write_continuum_checkpoint(const std::string &path, const ContinuumCheckpoint &c)
  {
    const continuum::Checkpoint &p = c.panel;
    if (p.values.size() != p.cells.size() * std::size_t(p.values_per_cell))
      throw std::invalid_argument("checkpoint: " + std::to_string(p.values.size()) + " values for " +
                                  std::to_string(p.cells.size()) + " cells of " + std::to_string(p.values_per_cell));
    Hdf5Writer file(path);
    file.write_string("format", format);
    file.write_string("scene", c.scene);
    file.write_string("sample", c.sample);
    file.attribute("/", "n_rows", double(c.n_rows));
    continuum::visit_entries(p, Put{file});
    file.finish();
  }

  ContinuumCheckpoint read_continuum_checkpoint(const std::string &path)
  {
    const Hdf5Reader file(path, Hdf5Reader::From::this_program);
    if (!file.has("format") || file.read_string("format") != format)
      throw std::invalid_argument(path + ": is no '" + format + "'; was it written by another version?");
    ContinuumCheckpoint c;
    c.scene  = file.read_string("scene");
    c.sample = file.read_string("sample");
    Get{file}("n_rows", c.n_rows);
    continuum::visit_entries(c.panel, Get{file});
    if (c.n_rows < 0 || c.panel.stage < 0 || c.panel.values_per_cell < 0)
      throw std::invalid_argument(path + ": 'n_rows', 'stage' or 'values_per_cell' is negative");
    if (c.panel.values.size() != c.panel.cells.size() * std::size_t(c.panel.values_per_cell))
      throw std::invalid_argument(path + ": 'values' does not hold one row for each of " + std::to_string(c.panel.cells.size()) +
                                  " cells");
    return c;
  }
} // namespace diptych::coupling
