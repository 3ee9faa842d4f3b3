// diptych: reads LIGGGHTS: dump custom of grains, dump local of contacts and wall contacts, STL of plates
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "coupling/import/dump_file.h"
#include "coupling/import/readers.h"
#include "coupling/import/wall_table.h"
#include "coupling/scene/scene_error.h"

namespace diptych::coupling
{
  namespace
  {
    // Keywords of compute pair/gran/local and wall/gran/local with their numbers of columns.
    const std::map<std::string, int> keyword_columns = {
      {"pos", 6},    {"id", 3},       {"force", 3},        {"force_normal", 3}, {"force_tangential", 3},
      {"torque", 3}, {"torque_n", 3}, {"torque_t", 3},     {"history", 3},      {"contactArea", 1},
      {"delta", 1},  {"heatFlux", 1}, {"contactPoint", 3}, {"vel", 6}};

    // pos.1 ... pos.6, id.1 ...: column names from keywords.
    std::vector<std::string> expanded(const std::vector<std::string> &keywords)
    {
      std::vector<std::string> columns;
      for (const std::string &keyword : keywords)
        {
          const auto known = keyword_columns.find(keyword);
          if (known == keyword_columns.end())
            throw SceneError("--columns: '" + keyword + "' is not a keyword of compute pair/gran/local");
          for (int k = 1; k <= known->second; ++k)
            columns.push_back(keyword + "." + std::to_string(k));
        }
      return columns;
    }

    struct PlateVertex
    {
      Eigen::Vector3d place;
    };

    // Planes of an STL with a normal along x or y, each once. Their places later show which wall they are.
    std::vector<std::pair<int, double>> planes_of_stl(const std::string &path)
    {
      TextLines                           lines(path);
      std::vector<std::pair<int, double>> planes; // axis, place
      std::vector<Eigen::Vector3d>        corner;
      if (lines.take("solid").substr(0, 5) != "solid")
        lines.refuse("expected 'solid': a text STL");
      while (!lines.at_end())
        {
          const auto words = words_of(lines.take("a facet"));
          if (words.empty() || words[0] != "vertex")
            continue;
          if (words.size() != 4)
            lines.refuse("expected vertex X Y Z");
          corner.emplace_back(lines.number(words[1], "x"), lines.number(words[2], "y"), lines.number(words[3], "z"));
          if (corner.size() % 3 != 0)
            continue;
          const auto *v = &corner[corner.size() - 3];
          for (const int axis : {0, 1})
            if (v[0][axis] == v[1][axis] && v[1][axis] == v[2][axis])
              if (const std::pair<int, double> plane(axis, v[0][axis]); std::count(planes.begin(), planes.end(), plane) == 0)
                planes.push_back(plane);
        }
      if (corner.empty() || corner.size() % 3 != 0)
        throw SceneError(path + ": contains no complete triangle");
      return planes;
    }

    // An STL has six digits, so it gives only places that no other file contains.
    void add_stl(const std::string &path, ForeignFrame &frame)
    {
      Eigen::Vector2d middle = Eigen::Vector2d::Zero();
      for (const ForeignGrain &g : frame.grains)
        middle += g.position / double(frame.grains.size());
      if (frame.wall_file.empty())
        frame.wall_file = path;
      for (const auto &[axis, place] : planes_of_stl(path))
        {
          const Side side = axis == 1 ? (place < middle.y() ? Side::lower : Side::upper)
                                      : (place < middle.x() ? Side::left : Side::right);
          auto       wall = std::find_if(frame.walls.begin(), frame.walls.end(),
                                         [side = side](const ForeignWall &w) { return w.side == side; });
          if (wall == frame.walls.end())
            frame.walls.push_back({side_names[int(side)], side, place});
          else if (!std::isfinite(wall->place))
            wall->place = place;
        }
    }

    struct LiggghtsFiles
    {
      std::map<long, DumpSection> grains, contacts, walls;
      std::map<long, std::string> plates; // by the number in the file's name
      std::vector<std::string>    wall_tables;
    };

    // Rows of wall contacts have no second grain. Mesh and triangle count from 0, and the grain is in the sixth column.
    bool is_of_walls(const DumpSection &section, const ForeignOptions &options)
    {
      const std::vector<std::string> named = columns_for(options, "walls");
      if (!named.empty() && expanded(named).size() == section.table.columns.size() &&
          expanded(columns_for(options, "contacts")).size() != section.table.columns.size())
        return true;
      return section.table.columns.front().rfind("c_cw", 0) == 0 || section.table.columns.size() == 15;
    }

    LiggghtsFiles liggghts_files(const ForeignOptions &options)
    {
      LiggghtsFiles files;
      for (const std::string &path : options.files)
        if (is_dump(path))
          for (DumpSection &section : read_dump(path))
            {
              auto &place = section.kind == "ATOMS" ? files.grains : is_of_walls(section, options) ? files.walls : files.contacts;
              const long step = section.step;
              if (!place.emplace(step, std::move(section)).second)
                throw SceneError(path + ": step " + std::to_string(step) + " occurs twice");
            }
        else if (std::filesystem::path(path).extension() == ".stl")
          files.plates[number_in_name(path)] = path;
        else if (is_wall_table(path))
          files.wall_tables.push_back(path);
        else
          throw SceneError(path + ": is neither a dump (ITEM: TIMESTEP), an .stl nor a wall table (step, width, height)");
      return files;
    }

    NumberTable &with_names(NumberTable &table, const std::vector<std::string> &keywords, const std::string &kind)
    {
      const std::vector<std::string> columns = expanded(keywords);
      if (columns.size() != table.columns.size())
        {
          std::string text;
          for (const std::string &keyword : keywords)
            text += (text.empty() ? "" : ",") + keyword;
          throw SceneError(table.path + ": rows have " + std::to_string(table.columns.size()) + " columns, but " + text +
                           " has " + std::to_string(columns.size()) + "; give the keywords of the compute with --columns " +
                           kind + "=" + text);
        }
      table.columns = columns;
      return table;
    }

    Eigen::Vector2d pair_at(const NumberTable &table, const std::size_t row, const std::string &keyword, const int first)
    {
      return {table.at(row, table.place_of(keyword + "." + std::to_string(first))),
              table.at(row, table.place_of(keyword + "." + std::to_string(first + 1)))};
    }

    void add_contacts_of(NumberTable &table, const ForeignOptions &options, ForeignFrame &frame)
    {
      std::vector<std::string> keywords = columns_for(options, "contacts");
      if (keywords.empty())
        keywords = {"pos", "id", "force", "force_normal", "force_tangential", "contactArea", "delta", "contactPoint"};
      with_names(table, keywords, "contacts");
      std::map<long, Eigen::Vector2d> centre;
      for (const ForeignGrain &g : frame.grains)
        centre[g.id] = g.position;
      const auto delta   = table.find("delta.1");
      frame.has_contacts = true;
      frame.contact_file = table.path;
      for (std::size_t row = 0; row < table.n_rows(); ++row)
        {
          ForeignContact contact;
          contact.first  = table.whole(row, table.place_of("id.1"));
          contact.second = table.whole(row, table.place_of("id.2"));
          if (table.at(row, table.place_of("id.3")) != 0)
            table.refuse(row, "a contact across a periodic edge; walls are needed");
          const auto a = centre.find(contact.first);
          if (a != centre.end() && table.has("pos.1") &&
              (a->second - pair_at(table, row, "pos", 1)).norm() > 1e-6 * a->second.norm())
            table.refuse(row, "grain " + std::to_string(contact.first) +
                                " has another position in the dump of the grains; are these files of different frames, or "
                                "columns of another meaning "
                                "(--columns contacts=pos,id,force,...)");
          contact.force = pair_at(table, row, "force", 1);
          if (table.has("contactPoint.1"))
            contact.point = pair_at(table, row, "contactPoint", 1);
          if (delta)
            contact.overlap = table.at(row, *delta);
          contact.line = table.line[row];
          frame.contacts.push_back(contact);
        }
    }

    // The contact point is the first point of `pos`; the keyword contactPoint is 0 for plates.
    void add_wall_contacts_of(NumberTable &table, const ForeignOptions &options, ForeignFrame &frame)
    {
      std::vector<std::string> keywords = columns_for(options, "walls");
      if (keywords.empty())
        keywords = {"pos", "id", "force", "contactPoint"};
      with_names(table, keywords, "walls");
      std::map<long, int> walls; // by mesh
      for (std::size_t row = 0; row < table.n_rows(); ++row)
        {
          const long mesh = table.whole(row, table.place_of("id.1"));
          if (walls.count(mesh) == 0)
            {
              walls[mesh] = int(frame.walls.size());
              frame.walls.push_back({"mesh " + std::to_string(mesh)});
            }
          ForeignContact contact;
          contact.first = table.whole(row, table.place_of("id.3"));
          contact.wall  = walls[mesh];
          contact.force = pair_at(table, row, "force", 1);
          contact.point = pair_at(table, row, "pos", 1);
          contact.line  = table.line[row];
          frame.contacts.push_back(contact);
        }
    }

    ForeignFrame liggghts_frame(DumpSection &grains, LiggghtsFiles &files, const ForeignOptions &options)
    {
      ForeignFrame frame;
      frame.step = grains.step;
      frame.name = "step " + std::to_string(grains.step);
      if (options.timestep)
        frame.time = double(grains.step) * *options.timestep;
      frame.grain_file = grains.table.path;
      frame.grains     = grains_of(grains.table);
      const auto only  = [&](auto &of, const char *what) {
        const auto found = of.find(grains.step);
        if (!of.empty() && found == of.end())
          throw SceneError(grains.table.path + ": there are no " + what + " of step " + std::to_string(grains.step) +
                            ": the frames do not match");
        return found;
      };
      if (const auto contacts = only(files.contacts, "contacts"); contacts != files.contacts.end())
        add_contacts_of(contacts->second.table, options, frame);
      if (const auto walls = only(files.walls, "wall contacts"); walls != files.walls.end())
        add_wall_contacts_of(walls->second.table, options, frame);
      return frame;
    }
  } // namespace

  ForeignSample read_liggghts(const ForeignOptions &options)
  {
    LiggghtsFiles files = liggghts_files(options);
    ForeignSample sample;
    sample.format     = "liggghts";
    sample.is_spheres = sample.counts_steps = true;
    if (!files.contacts.empty())
      sample.unnamed.push_back("contacts");
    if (!files.walls.empty())
      sample.unnamed.push_back("walls");
    for (auto &[step, grains] : files.grains)
      sample.frames.push_back(liggghts_frame(grains, files, options));
    if (sample.frames.empty())
      throw SceneError("import liggghts: no file contains grains (dump custom with id, x, y, radius)");
    add_wall_tables(sample, files.wall_tables);
    for (ForeignFrame &frame : sample.frames)
      if (const auto plates = files.plates.find(*frame.step); plates != files.plates.end())
        add_stl(plates->second, frame);
    return sample;
  }
} // namespace diptych::coupling
