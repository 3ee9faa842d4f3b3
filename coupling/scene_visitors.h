// diptych: what may be done with a list of parameters: declare, fetch, describe
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>

namespace diptych::coupling
{
  using Range   = std::array<double, 2>;
  using Choices = std::vector<std::string>;

  // Shortest text that reads back as the same number.
  inline std::string text_of(const double value)
  {
    for (int digits = 6; digits <= 17; ++digits)
      {
        std::ostringstream out;
        out.precision(digits);
        out << value;
        if (digits == 17 || std::stod(out.str()) == value)
          return out.str();
      }
    return "";
  }

  inline std::string text_of(const std::vector<double> &values)
  {
    std::string text;
    for (const double value : values)
      text += (text.empty() ? "" : ", ") + text_of(value);
    return text;
  }

  inline std::string joined(const Choices &choices, const std::string &separator)
  {
    std::string text;
    for (const std::string &choice : choices)
      text += (text.empty() ? "" : separator) + choice;
    return text;
  }

  // "auto" or a number within a range.
  class NumberOrAuto : public dealii::Patterns::PatternBase
  {
  public:
    explicit NumberOrAuto(const Range &range)
        : range_(range)
    {}

    bool match(const std::string &text) const override
    {
      return text == "auto" || dealii::Patterns::Double(range_[0], range_[1]).match(text);
    }
    std::string description(const OutputStyle style = Machine) const override
    {
      return "[auto or " + dealii::Patterns::Double(range_[0], range_[1]).description(style) + "]";
    }
    std::unique_ptr<dealii::Patterns::PatternBase> clone() const override { return std::make_unique<NumberOrAuto>(range_); }

  private:
    Range range_;
  };

  inline std::string text_of(const std::optional<double> &value)
  {
    return value ? text_of(*value) : "auto";
  }

  // Declares each key with its pattern in the current subsection.
  struct DeclareVisitor
  {
    dealii::ParameterHandler &prm;

    void operator()(const char *name, double &value, const char *, const Range range, const char *meaning) const
    {
      prm.declare_entry(name, text_of(value), dealii::Patterns::Double(range[0], range[1]), meaning);
    }
    void operator()(const char *name, std::optional<double> &value, const char *, const Range range, const char *meaning) const
    {
      prm.declare_entry(name, text_of(value), NumberOrAuto(range), meaning);
    }
    void operator()(const char *name, int &value, const char *, const Range range, const char *meaning) const
    {
      prm.declare_entry(name, std::to_string(value), dealii::Patterns::Integer(int(range[0]), int(range[1])), meaning);
    }
    void operator()(const char *name, bool &value, const char *, const Choices &, const char *meaning) const
    {
      prm.declare_entry(name, value ? "true" : "false", dealii::Patterns::Bool(), meaning);
    }
    void operator()(const char *name, std::string &value, const char *, const Choices &choices, const char *meaning) const
    {
      if (choices.empty())
        prm.declare_entry(name, value, dealii::Patterns::Anything(), meaning);
      else
        prm.declare_entry(name, value, dealii::Patterns::Selection(joined(choices, "|")), meaning);
    }
    void operator()(const char *name, std::vector<double> &value, const char *, const Range range, const char *meaning) const
    {
      prm.declare_entry(name, text_of(value), dealii::Patterns::List(dealii::Patterns::Double(range[0], range[1])), meaning);
    }
  };

  // Takes each value from the current subsection.
  struct FetchVisitor
  {
    dealii::ParameterHandler &prm;

    void operator()(const char *name, double &value, const char *, Range, const char *) const { value = prm.get_double(name); }
    void operator()(const char *name, std::optional<double> &value, const char *, Range, const char *) const
    {
      const std::string text = prm.get(name);
      value                  = text == "auto" ? std::nullopt : std::optional<double>(dealii::Utilities::string_to_double(text));
    }
    void operator()(const char *name, int &value, const char *, Range, const char *) const { value = int(prm.get_integer(name)); }
    void operator()(const char *name, bool &value, const char *, const Choices &, const char *) const
    {
      value = prm.get_bool(name);
    }
    void operator()(const char *name, std::string &value, const char *, const Choices &, const char *) const
    {
      value = prm.get(name);
    }
    void operator()(const char *name, std::vector<double> &value, const char *, Range, const char *) const
    {
      value.clear();
      for (const std::string &item : dealii::Utilities::split_string_list(prm.get(name)))
        value.push_back(dealii::Utilities::string_to_double(item));
    }
  };

  struct KeyDescription
  {
    std::string section, name, value, unit, allowed, meaning;
  };

  // Collects each key with its present value.
  struct DescribeVisitor
  {
    std::string                  section;
    std::vector<KeyDescription> &keys;

    void operator()(const char *name, double &value, const char *unit, const Range range, const char *meaning) const
    {
      keys.push_back(
        {section, name, text_of(value), unit, "a number from " + text_of(range[0]) + " to " + text_of(range[1]), meaning});
    }
    void operator()(const char            *name,
                    std::optional<double> &value,
                    const char            *unit,
                    const Range            range,
                    const char            *meaning) const
    {
      keys.push_back({section, name, text_of(value), unit,
                      "auto or a number from " + text_of(range[0]) + " to " + text_of(range[1]), meaning});
    }
    void operator()(const char *name, int &value, const char *unit, const Range range, const char *meaning) const
    {
      keys.push_back({section, name, std::to_string(value), unit,
                      "a whole number from " + text_of(range[0]) + " to " + text_of(range[1]), meaning});
    }
    void operator()(const char *name, bool &value, const char *unit, const Choices &, const char *meaning) const
    {
      keys.push_back({section, name, value ? "true" : "false", unit, "true or false", meaning});
    }
    void operator()(const char *name, std::string &value, const char *unit, const Choices &choices, const char *meaning) const
    {
      keys.push_back({section, name, value, unit, choices.empty() ? "any text" : "one of " + joined(choices, ", "), meaning});
    }
    void operator()(const char *name, std::vector<double> &value, const char *unit, const Range range, const char *meaning) const
    {
      keys.push_back({section, name, text_of(value), unit,
                      "a list of numbers from " + text_of(range[0]) + " to " + text_of(range[1]), meaning});
    }
  };
} // namespace diptych::coupling
