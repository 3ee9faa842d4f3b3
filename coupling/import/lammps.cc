// diptych: reads LAMMPS: dump custom of grains and walls, dump local of contacts, data files
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <cmath>
#include <map>

#include "coupling/import/dump_file.h"
#include "coupling/import/readers.h"
#include "coupling/import/wall_table.h"
#include "coupling/scene/scene_error.h"
#include "discrete/files/words.h"

namespace diptych::coupling
{
  namespace
  {
    // Columns of compute pair/local and property/local in the order of README.md.
    const std::vector<std::string> lammps_contact_columns = {"index", "patom1", "patom2", "dist", "force",
                                                             "fx",    "fy",     "p1",     "p2",   "p4"};

    struct LammpsFiles
    {
      std::map<long, DumpSection> grains, contacts, walls; // by step
      std::vector<std::string>    wall_tables, data_files;
    };

    void sort_section(DumpSection &&section, LammpsFiles &files)
    {
      const bool has_places = section.table.has("x") && section.table.has("y");
      const bool is_grains  = section.kind == "ATOMS" && has_places && section.table.find_any({"radius", "diameter"});
      const bool is_walls   = section.kind == "ATOMS" && !has_places;
      if (section.kind == "ATOMS" && !is_grains && !is_walls)
        throw SceneError(section.table.path + ": step " + std::to_string(section.step) +
                         ": grains need the columns id, x, y and radius (or diameter)");
      for (const int axis : {0, 1})
        if (section.is_periodic[axis])
          throw SceneError(section.table.path + ": the box is periodic along " + "xy"[axis] +
                           "; the files do not show contacts across its edge, so walls are needed");
      auto             &place = is_grains ? files.grains : is_walls ? files.walls : files.contacts;
      const std::string path  = section.table.path;
      const long        step  = section.step;
      if (!place.emplace(step, std::move(section)).second)
        throw SceneError(path + ": step " + std::to_string(step) + " occurs twice");
    }

    bool is_data_file(const std::string &path)
    {
      TextLines lines(path);
      for (int k = 0; k < 40 && !lines.at_end(); ++k)
        {
          const auto words = words_of(lines.take("a line"));
          if (words.size() == 2 && words[1] == "atoms")
            return true;
        }
      return false;
    }

    LammpsFiles sorted_files(const ForeignOptions &options)
    {
      LammpsFiles files;
      for (const std::string &path : options.files)
        if (is_dump(path))
          for (DumpSection &section : read_dump(path))
            sort_section(std::move(section), files);
        else if (is_wall_table(path))
          files.wall_tables.push_back(path);
        else if (is_data_file(path))
          files.data_files.push_back(path);
        else
          throw SceneError(path +
                           ": is neither a dump (ITEM: TIMESTEP), a data file (N atoms) nor a wall table (step, width, height)");
      return files;
    }

    struct ContactColumns
    {
      std::size_t                first, second, fx, fy;
      std::optional<std::size_t> p1, p2, distance, force;
    };

    ContactColumns lammps_columns(NumberTable &table, const ForeignOptions &options)
    {
      const bool               named = table.has("patom1") || table.has("id1");
      std::vector<std::string> names = columns_for(options, "contacts");
      if (names.empty() && !named)
        names = lammps_contact_columns;
      if (!names.empty() && names.size() != table.columns.size())
        throw SceneError(table.path + ": rows have " + std::to_string(table.columns.size()) + " columns, not " +
                         std::to_string(names.size()) + "; name them with --columns contacts=index,patom1,patom2,...");
      if (!names.empty())
        table.columns = names;
      return {table.place_of_any({"patom1", "id1"}, "the first grain"),
              table.place_of_any({"patom2", "id2"}, "the second grain"),
              table.place_of("fx"),
              table.place_of("fy"),
              table.find("p1"),
              table.find("p2"),
              table.find("dist"),
              table.find("force")};
    }

    // Checks the meaning of the columns: the distance is that of the centres, and the normal force is parallel to them.
    void verify(const NumberTable &table, const std::size_t row, const ContactColumns &c, const Eigen::Vector2d &branch)
    {
      const Eigen::Vector2d force(table.at(row, c.fx), table.at(row, c.fy));
      const bool            far = c.distance && std::abs(table.at(row, *c.distance) - branch.norm()) > 1e-5 * branch.norm();
      const bool   else_normal  = c.force && std::abs(std::abs(table.at(row, *c.force)) - force.norm()) > 1e-5 * force.norm();
      const double off          = std::abs(branch.x() * force.y() - branch.y() * force.x());
      if (far || else_normal || off > 1e-4 * branch.norm() * force.norm())
        table.refuse(row, std::string(far           ? "the distance of the centres"
                                      : else_normal ? "the size of the normal force"
                                                    : "the direction of the normal force") +
                            " does not agree with the grains; does the column have another meaning (--columns "
                            "contacts=index,patom1,patom2,dist,...)?");
    }

    void add_contacts(DumpSection &section, const ForeignOptions &options, ForeignFrame &frame)
    {
      NumberTable                    &table = section.table;
      const ContactColumns            c     = lammps_columns(table, options);
      std::map<long, Eigen::Vector2d> centre;
      for (const ForeignGrain &g : frame.grains)
        centre[g.id] = g.position;
      frame.has_contacts = true;
      frame.contact_file = table.path;
      for (std::size_t row = 0; row < table.n_rows(); ++row)
        {
          ForeignContact contact;
          contact.first  = table.whole(row, c.first);
          contact.second = table.whole(row, c.second);
          contact.line   = table.line[row];
          const auto a = centre.find(contact.first), b = centre.find(contact.second);
          if (a != centre.end() && b != centre.end())
            verify(table, row, c, a->second - b->second);
          contact.force = {table.at(row, c.fx), table.at(row, c.fy)};
          if (c.p1 && c.p2)
            contact.force += Eigen::Vector2d(table.at(row, *c.p1), table.at(row, *c.p2));
          if (contact.force != Eigen::Vector2d::Zero())
            frame.contacts.push_back(contact);
        }
    }

    // Columns f_NAME[k] of `fix wall/gran ... contacts`: 1 touches, 2 and 3 force on the grain, 5 and 6 contact point.
    void add_wall_contacts(const DumpSection &section, ForeignFrame &frame)
    {
      const NumberTable       &table = section.table;
      std::vector<std::string> names;
      for (const std::string &column : table.columns)
        if (const std::size_t bracket = column.find("[1]"); column.rfind("f_", 0) == 0 && bracket != std::string::npos)
          names.push_back(column.substr(0, bracket));
      const std::size_t id = table.place_of("id");
      for (const std::string &name : names)
        {
          const std::size_t touches = table.place_of(name + "[1]"), fx = table.place_of(name + "[2]"),
                            fy = table.place_of(name + "[3]"), x = table.place_of(name + "[5]"), y = table.place_of(name + "[6]");
          frame.walls.push_back({name});
          for (std::size_t row = 0; row < table.n_rows(); ++row)
            if (table.at(row, touches) != 0)
              {
                ForeignContact contact;
                contact.first = table.whole(row, id);
                contact.wall  = int(frame.walls.size()) - 1;
                contact.force = {table.at(row, fx), table.at(row, fy)};
                contact.point = {table.at(row, x), table.at(row, y)};
                contact.line  = table.line[row];
                frame.contacts.push_back(contact);
              }
        }
    }

    // "Atoms # sphere": id, type, diameter, density, x, y, z. The density is always that of a sphere and is not used.
    ForeignFrame data_frame(const std::string &path)
    {
      TextLines    lines(path);
      ForeignFrame frame;
      frame.name = frame.grain_file = path;
      long count                    = -1;
      while (!lines.at_end())
        {
          const auto words = words_of(lines.take("a line"));
          if (words.size() == 2 && words[1] == "atoms")
            count = lines.whole(words[0], "the number of grains");
          if (words.empty() || words[0] != "Atoms")
            continue;
          if (words.size() > 2 && words[2] != "sphere")
            lines.refuse("atom_style " + std::string(words[2]) + "; use atom_style sphere, which has radii");
          while (discrete::trimmed(lines.peek()).empty() && !lines.at_end())
            lines.skip();
          for (long row = 0; row < count; ++row)
            {
              const auto numbers = words_of(lines.take("grain " + std::to_string(row + 1) + " of " + std::to_string(count)));
              if (numbers.size() < 7)
                lines.refuse("expected id, type, diameter, density, x, y, z");
              ForeignGrain g;
              g.id       = lines.whole(numbers[0], "id");
              g.radius   = 0.5 * lines.positive(numbers[2], "diameter");
              g.position = {lines.number(numbers[4], "x"), lines.number(numbers[5], "y")};
              g.line     = lines.line();
              frame.grains.push_back(g);
            }
        }
      if (count < 1 || long(frame.grains.size()) != count)
        throw SceneError(path + ": the section Atoms does not have as many grains as the head announces");
      return frame;
    }

    ForeignFrame dump_frame(DumpSection &grains, LammpsFiles &files, const ForeignOptions &options)
    {
      ForeignFrame frame;
      frame.step = grains.step;
      frame.name = "step " + std::to_string(grains.step);
      if (options.timestep)
        frame.time = double(grains.step) * *options.timestep;
      frame.grain_file = grains.table.path;
      (void)grains.table.place_of("id");
      frame.grains = grains_of(grains.table);
      if (const auto contacts = files.contacts.find(grains.step); contacts != files.contacts.end())
        add_contacts(contacts->second, options, frame);
      if (const auto walls = files.walls.find(grains.step); walls != files.walls.end())
        add_wall_contacts(walls->second, frame);
      return frame;
    }

    // Refuses steps that only one kind of file has.
    void require_same_steps(const LammpsFiles &files, ForeignSample &sample)
    {
      for (const auto &[step, section] : files.grains)
        for (const auto *others : {&files.contacts, &files.walls})
          if (!others->empty() && others->count(step) == 0)
            throw SceneError(section.table.path + ": step " + std::to_string(step) + " is not in " +
                             others->begin()->second.table.path + ": the frames do not match");
      std::size_t unused = 0;
      for (const auto *others : {&files.contacts, &files.walls})
        for (const auto &[step, section] : *others)
          unused += files.grains.count(step) == 0;
      if (unused > 0)
        sample.remarks.push_back(std::to_string(unused) +
                                 " sections of contacts or walls belong to steps without grains and were not used");
    }
  } // namespace

  ForeignSample read_lammps(const ForeignOptions &options)
  {
    LammpsFiles   files = sorted_files(options);
    ForeignSample sample;
    sample.format = "lammps";
    if (files.grains.empty())
      {
        for (const std::string &path : files.data_files)
          sample.frames.push_back(data_frame(path));
        if (sample.frames.empty())
          throw SceneError("import lammps: no file contains grains (dump custom with id, x, y, radius, or a data file)");
      }
    else if (!files.data_files.empty())
      sample.remarks.push_back(files.data_files.front() + ": this data file was not used, because there are dumps");
    require_same_steps(files, sample);
    sample.counts_steps = !files.grains.empty();
    if (!files.contacts.empty())
      sample.unnamed = {"contacts"};
    for (auto &[step, grains] : files.grains)
      sample.frames.push_back(dump_frame(grains, files, options));
    add_wall_tables(sample, files.wall_tables);
    const auto has_tangential = [](const auto &entry) { return entry.second.table.has("p1"); };
    if (!files.contacts.empty() && !std::any_of(files.contacts.begin(), files.contacts.end(), has_tangential))
      sample.lacking.push_back(
        "tangential forces (fx, fy of compute pair/local are the normal part, p1, p2 the tangential part)");
    return sample;
  }
} // namespace diptych::coupling
