// diptych: tables of numbers with named columns, as other codes write them
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/import/number_table.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "coupling/scene/scene_error.h"
#include "discrete/files/csv_file.h"
#include "discrete/files/words.h"

namespace diptych::coupling
{
  namespace
  {
    bool starts_with_a_letter(const std::string_view word)
    {
      return !word.empty() && std::isalpha(static_cast<unsigned char>(word[0])) != 0 && word != "nan" && word != "inf";
    }

    // "force_x y z" stands for force_x, force_y and force_z.
    std::vector<std::string> names_of(const std::vector<std::string_view> &words)
    {
      std::vector<std::string> names;
      for (const std::string_view word : words)
        {
          const std::string before  = names.empty() ? "" : names.back();
          const bool        goes_on = before.size() > 2 && before[before.size() - 2] == '_' && word.size() == 1 &&
                               word[0] == before.back() + 1;
          names.push_back((goes_on ? before.substr(0, before.size() - 1) : "") + std::string(word));
        }
      return names;
    }

    // Turns "# x y" and "#x,y" into "x y".
    std::string_view without_mark(std::string_view line)
    {
      line = discrete::trimmed(line);
      if (line.substr(0, 3) == "\xEF\xBB\xBF")
        line.remove_prefix(3);
      while (!line.empty() && line[0] == '#')
        line = discrete::trimmed(line.substr(1));
      return line;
    }
  } // namespace

  std::optional<std::size_t> NumberTable::find(const std::string &column) const
  {
    const auto same = [](const char a, const char b) {
      return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
    };
    const auto found = std::find_if(columns.begin(), columns.end(), [&](const std::string &name) {
      return name.size() == column.size() && std::equal(name.begin(), name.end(), column.begin(), same);
    });
    return found == columns.end() ? std::nullopt : std::optional<std::size_t>(found - columns.begin());
  }

  std::optional<std::size_t> NumberTable::find_any(const std::vector<std::string> &names) const
  {
    for (const std::string &name : names)
      if (const auto found = find(name))
        return found;
    return std::nullopt;
  }

  std::size_t NumberTable::place_of(const std::string &column) const
  {
    return place_of_any({column}, "'" + column + "'");
  }

  std::size_t NumberTable::place_of_any(const std::vector<std::string> &names, const std::string &what) const
  {
    if (const auto found = find_any(names))
      return *found;
    throw SceneError(path + ": no column for " + what + " (" + discrete::listed(names) + "); its columns are " +
                     discrete::listed(columns));
  }

  void NumberTable::refuse(const std::size_t row, const std::string &why) const
  {
    throw SceneError(path + ", line " + std::to_string(line[row]) + ": " + why);
  }

  long NumberTable::whole(const std::size_t row, const std::size_t column) const
  {
    const double value = at(row, column);
    if (value != std::floor(value) || std::abs(value) > 9e15)
      refuse(row, "column " + columns[column] + " = " + discrete::exact_text(value) + " is not a whole number");
    return long(value);
  }

  double NumberTable::positive(const std::size_t row, const std::size_t column) const
  {
    const double value = at(row, column);
    if (!(value > 0))
      refuse(row, "column " + columns[column] + " = " + discrete::exact_text(value) + " must be positive");
    return value;
  }

  void add_row(NumberTable &table, const TextLines &lines, const std::string_view text)
  {
    const std::vector<std::string_view> words = words_of(text);
    if (words.size() != table.columns.size())
      lines.refuse(std::to_string(words.size()) + " entries; expected " + std::to_string(table.columns.size()) + ": " +
                   discrete::listed(table.columns));
    for (std::size_t c = 0; c < words.size(); ++c)
      table.values.push_back(lines.number(words[c], "column " + table.columns[c]));
    table.line.push_back(lines.line());
  }

  NumberTable read_number_table(const std::string &path, const std::vector<std::string> &columns)
  {
    TextLines   lines(path);
    NumberTable table;
    table.path      = path;
    table.columns   = columns;
    bool are_marked = true; // the names have a mark; a comment below unmarked names is skipped
    while (!lines.at_end())
      {
        const std::string_view text = lines.take("a row"), plain = without_mark(text);
        if (plain.empty())
          continue;
        auto words = words_of(plain);
        if (words.size() > 1 && words[0].empty() && table.columns.empty())
          words[0] = "-"; // pandas writes its index without a name
        const bool is_names  = std::all_of(words.begin() + (words[0] == "-" ? 1 : 0), words.end(), starts_with_a_letter);
        const bool is_marked = discrete::trimmed(text)[0] == '#';
        if (is_names && table.n_rows() == 0 && columns.empty() && (are_marked || !is_marked))
          {
            table.columns = names_of(words);
            are_marked    = is_marked;
          }
        if (is_names && table.n_rows() > 0 && !is_marked && names_of(words) != table.columns)
          lines.refuse("text among rows of numbers; expected numbers, or the same column names again");
        if (is_names || is_marked)
          continue;
        if (table.columns.empty())
          lines.refuse("no line above these numbers names the columns");
        add_row(table, lines, text);
      }
    if (table.n_rows() == 0)
      throw SceneError(path + ": contains no row of numbers");
    for (std::size_t c = 0; c < table.columns.size(); ++c)
      if (std::count(table.columns.begin(), table.columns.end(), table.columns[c]) > 1 && table.columns[c] != "-")
        throw SceneError(path + ": two columns have the name " + table.columns[c]);
    return table;
  }

  std::vector<ForeignGrain> grains_of(const NumberTable &table)
  {
    const std::size_t x = table.place_of("x"), y = table.place_of("y");
    const auto        diameter = table.find_any({"diameter", "d"});
    const auto        radius   = table.find_any({"radius", "r", "R"});
    const std::size_t r        = diameter ? *diameter : table.place_of_any({"radius", "r", "R"}, "the radius");
    const auto        id       = table.find("id");
    const auto        optional = [&](const std::vector<std::string> &names) {
      const auto column = table.find_any(names);
      return [&table, column](const std::size_t row) { return column ? table.at(row, *column) : not_told; };
    };
    const auto mass = optional({"mass", "m"}), vx = optional({"vx", "vel_x"}), vy = optional({"vy", "vel_y"}),
               spin     = optional({"omegaz", "omega", "wz", "angVel_z", "spin"}),
               rotation = optional({"rotation", "angle", "theta"}), fx = optional({"fx", "f_x"}), fy = optional({"fy", "f_y"});
    std::vector<ForeignGrain> grains(table.n_rows());
    for (std::size_t k = 0; k < grains.size(); ++k)
      {
        ForeignGrain &g = grains[k];
        g.id            = id ? table.whole(k, *id) : long(k);
        g.position      = {table.at(k, x), table.at(k, y)};
        g.radius        = table.positive(k, r) * (diameter ? 0.5 : 1.);
        if (diameter && radius && std::abs(table.at(k, *radius) - g.radius) > 1e-5 * g.radius)
          table.refuse(k, "a radius of " + discrete::exact_text(table.at(k, *radius)) + " and a diameter of " +
                            discrete::exact_text(2 * g.radius) + " contradict each other");
        g.mass = mass(k);
        if (g.mass <= 0)
          table.refuse(k, "a mass of " + discrete::exact_text(g.mass) + " must be positive");
        g.velocity  = {vx(k), vy(k)};
        g.spin      = spin(k);
        g.rotation  = rotation(k);
        g.resultant = {fx(k), fy(k)};
        g.line      = table.line[k];
      }
    return grains;
  }

  std::vector<std::string> columns_for(const ForeignOptions &options, const std::string &kind)
  {
    std::vector<std::string> names;
    for (const std::string &text : options.columns)
      if (text.rfind(kind + "=", 0) == 0)
        for (const std::string_view name : words_of(std::string_view(text).substr(kind.size() + 1)))
          names.emplace_back(name);
    return names;
  }
} // namespace diptych::coupling
