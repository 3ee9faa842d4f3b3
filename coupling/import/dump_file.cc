// diptych: reads dump files of LAMMPS and LIGGGHTS
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/import/dump_file.h"

#include "coupling/scene/scene_error.h"
#include "discrete/files/words.h"

namespace diptych::coupling
{
  namespace
  {
    bool begins(const std::string_view line, const std::string_view with)
    {
      return line.substr(0, with.size()) == with;
    }

    // "ITEM: BOX BOUNDS ff ff pp" and three lines of numbers.
    void read_box(TextLines &lines, DumpSection &section)
    {
      const std::string_view head = lines.take("'ITEM: BOX BOUNDS'");
      if (!begins(head, "ITEM: BOX BOUNDS"))
        lines.refuse("expected 'ITEM: BOX BOUNDS'");
      const auto words = words_of(head);
      for (std::size_t axis = 0; axis < 2; ++axis)
        section.is_periodic[axis] = words.size() > 3 + axis && words[3 + axis] == "pp";
      if (words.size() > 6)
        lines.refuse("a triclinic box; only orthogonal boxes are supported");
      for (int axis = 0; axis < 3; ++axis)
        {
          const auto bounds = words_of(lines.take("the bounds of the box"));
          if (bounds.size() != 2)
            lines.refuse("expected two bounds of the box");
          for (const std::string_view bound : bounds)
            (void)lines.number(bound, "a bound of the box");
        }
    }

    long count_of(TextLines &lines)
    {
      const std::string_view head = lines.take("'ITEM: NUMBER OF ...'");
      if (!begins(head, "ITEM: NUMBER OF "))
        lines.refuse("expected 'ITEM: NUMBER OF ATOMS' or 'ENTRIES'");
      const long count = lines.whole(discrete::trimmed(lines.take("a number of rows")), "the number of rows");
      if (count < 0)
        lines.refuse("the number of rows is negative");
      return count;
    }

    DumpSection read_section(TextLines &lines, const std::string &path)
    {
      DumpSection section;
      while (begins(lines.peek(), "ITEM: UNITS") || begins(lines.peek(), "ITEM: TIME") || begins(lines.peek(), "ITEM: LABEL"))
        {
          const bool is_step = begins(lines.take("a head"), "ITEM: TIMESTEP");
          const auto value   = discrete::trimmed(lines.take("its value"));
          if (is_step)
            section.step = lines.whole(value, "the step");
        }
      const long count = count_of(lines);
      read_box(lines, section);
      const auto head = words_of(lines.take("'ITEM: ATOMS' or 'ITEM: ENTRIES' with the columns"));
      if (head.size() < 3 || head[0] != "ITEM:" || (head[1] != "ATOMS" && head[1] != "ENTRIES"))
        lines.refuse("expected 'ITEM: ATOMS' or 'ITEM: ENTRIES' with the names of the columns");
      section.kind       = head[1];
      section.table.path = path;
      section.table.columns.assign(head.begin() + 2, head.end());
      for (long row = 0; row < count; ++row)
        {
          const std::string_view text = lines.take("row " + std::to_string(row + 1) + " of " + std::to_string(count) +
                                                   " of step " + std::to_string(section.step));
          if (begins(text, "ITEM:"))
            lines.refuse("step " + std::to_string(section.step) + " has " + std::to_string(row) + " rows instead of " +
                         std::to_string(count) + " as in its head");
          add_row(section.table, lines, text);
        }
      return section;
    }
  } // namespace

  bool is_dump(const std::string &path)
  {
    return begins(TextLines(path).peek(), "ITEM: ");
  }

  std::vector<DumpSection> read_dump(const std::string &path)
  {
    TextLines                lines(path);
    std::vector<DumpSection> sections;
    while (!lines.at_end())
      {
        if (!begins(lines.peek(), "ITEM: TIMESTEP") && !begins(lines.peek(), "ITEM: UNITS") &&
            !begins(lines.peek(), "ITEM: TIME"))
          {
            lines.skip();
            lines.refuse("expected 'ITEM: TIMESTEP'");
          }
        sections.push_back(read_section(lines, path));
      }
    return sections;
  }
} // namespace diptych::coupling
