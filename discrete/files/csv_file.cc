// diptych: tables of numbers in comma-separated files, checked as they are read
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/files/csv_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "discrete/files/nearest_name.h"
#include "discrete/files/text_file.h"
#include "discrete/files/words.h"

namespace diptych::discrete
{
  namespace
  {
    std::vector<std::string> fields_of(const std::string &line)
    {
      std::vector<std::string> fields;
      for (std::size_t start = 0; start != std::string::npos;)
        {
          const std::size_t comma = line.find(',', start);
          fields.emplace_back(trimmed(line.substr(start, comma == std::string::npos ? comma : comma - start)));
          start = comma == std::string::npos ? comma : comma + 1;
        }
      return fields;
    }

    struct Line
    {
      int         number;
      std::string text;
    };

    // One look at a clock or a flag in a thousand lines costs nothing.
    void call_now_and_then(const CheckStop &check_stop, const std::size_t line)
    {
      if (line % 1024 == 0)
        call(check_stop);
    }

    std::vector<Line> lines_of(const std::string &path, const CheckStop &check_stop)
    {
      constexpr std::size_t most_bytes = std::size_t(4) << 30; // ten million grains need a tenth of it
      std::istringstream    file(read_input(path, most_bytes, check_stop));
      std::vector<Line>     lines;
      std::string           text;
      for (int number = 1; std::getline(file, text); ++number)
        {
          call_now_and_then(check_stop, std::size_t(number));
          text = std::string(trimmed(text));
          if (!text.empty() && text[0] != '#')
            lines.push_back({number, text});
        }
      if (lines.empty())
        throw std::invalid_argument(path + ": is empty; its first line must name the columns");
      return lines;
    }

    // std::from_chars leaves no room for a locale; it takes no plus sign.
    std::from_chars_result parse(const std::string &text, double &value)
    {
      const char *first = text.data(), *last = text.data() + text.size();
      if (text.size() > 1 && text[0] == '+' && text[1] != '-')
        ++first;
      std::from_chars_result result = std::from_chars(first, last, value);
      if (result.ptr != last)
        result.ec = std::errc::invalid_argument;
      return result;
    }

    double number(const std::string &text, const std::string &place)
    {
      double          value = 0;
      const std::errc error = parse(text, value).ec;
      if (error == std::errc::result_out_of_range)
        throw std::invalid_argument(place + " is beyond double precision; allowed: about 1e-307 to 1e308 either side of 0");
      if (error != std::errc())
        throw std::invalid_argument(place + " is not a number");
      if (!std::isfinite(value))
        throw std::invalid_argument(place + " is not finite");
      return value;
    }

    bool contains(const std::vector<std::string> &names, const std::string &name)
    {
      return std::find(names.begin(), names.end(), name) != names.end();
    }

    void check_header(const std::vector<std::string> &columns, const CsvHeader &header, const std::string &place)
    {
      std::vector<std::string> known = header.required, seen;
      known.insert(known.end(), header.optional.begin(), header.optional.end());
      for (const std::string &column : columns)
        {
          double value = 0;
          if (parse(column, value).ec == std::errc())
            throw std::invalid_argument(place + ": '" + column +
                                        "' is a number, not a column's name; the header line is missing");
          if (column.empty())
            throw std::invalid_argument(place + ": column " + std::to_string(seen.size() + 1) + " has no name");
          if (contains(seen, column))
            throw std::invalid_argument(place + ": column '" + column + "' occurs twice");
          if (!header.others && !contains(known, column))
            throw std::invalid_argument(place + ": unknown column '" + column + "'; the nearest is '" +
                                        nearest_name(column, known) + "'");
          seen.push_back(column);
        }
      for (const std::string &column : header.required)
        if (!contains(columns, column))
          throw std::invalid_argument(place + ": column '" + column + "' is missing");
    }

    std::vector<double> row_of(const Line &line, const CsvTable &table)
    {
      const std::string              place  = table.path + ", line " + std::to_string(line.number);
      const std::vector<std::string> fields = fields_of(line.text);
      if (fields.size() != table.columns.size())
        throw std::invalid_argument(place + ": " + std::to_string(fields.size()) + " fields; allowed: " +
                                    std::to_string(table.columns.size()) + ", as many as the header line names");
      std::vector<double> row;
      for (std::size_t c = 0; c < fields.size(); ++c)
        row.push_back(number(fields[c], place + ": column '" + table.columns[c] + "' = '" + fields[c] + "'"));
      return row;
    }
  } // namespace

  std::optional<std::size_t> CsvTable::find(const std::string &column) const
  {
    const auto found = std::find(columns.begin(), columns.end(), column);
    return found == columns.end() ? std::nullopt : std::optional<std::size_t>(found - columns.begin());
  }

  CsvTable read_csv(const std::string &path, const CsvHeader &header, const CheckStop &check_stop)
  {
    const std::vector<Line> lines = lines_of(path, check_stop);
    CsvTable                table;
    table.path    = path;
    table.columns = fields_of(lines[0].text);
    check_header(table.columns, header, path + ", line " + std::to_string(lines[0].number));
    for (std::size_t k = 1; k < lines.size(); ++k)
      {
        call_now_and_then(check_stop, k);
        table.rows.push_back(row_of(lines[k], table));
        table.line.push_back(lines[k].number);
      }
    if (table.rows.empty())
      throw std::invalid_argument(path + ": holds no line of numbers below the header; allowed: 1 or more");
    return table;
  }

  std::string cell_place(const CsvTable &table, const std::size_t row, const std::string &column)
  {
    return table.path + ", line " + std::to_string(table.line[row]) + ": column '" + column + "' = '" +
           exact_text(table.at(row, column)) + "'";
  }

  void refuse_cell(const CsvTable &table, const std::size_t row, const std::string &column, const std::string &allowed)
  {
    throw std::invalid_argument(cell_place(table, row, column) + " is out of range; allowed: " + allowed);
  }

  double tidy(double value)
  {
    char       text[32];
    const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 10).ptr;
    std::from_chars(text, end, value);
    return value;
  }

  std::string exact_text(const double value)
  {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
  }
} // namespace diptych::discrete
