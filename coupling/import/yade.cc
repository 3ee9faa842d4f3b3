// diptych: reads Yade: text exports of spheres, interactions and walls
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "coupling/import/readers.h"
#include "coupling/import/wall_table.h"
#include "coupling/scene/scene_error.h"
#include "discrete/files/words.h"

namespace diptych::coupling
{
  namespace
  {
    // id1 id2, then contactPoint, normal, normalForce, shearForce (three columns each), penetrationDepth.
    const std::vector<std::string> yade_contact_columns = {
      "id1",           "id2",          "contactPoint_x", "contactPoint_y", "contactPoint_z",
      "normal_x",      "normal_y",     "normal_z",       "normalForce_x",  "normalForce_y",
      "normalForce_z", "shearForce_x", "shearForce_y",   "shearForce_z",   "penetrationDepth"};

    struct YadeWall
    {
      long            id   = -1;
      int             axis = -1;
      Eigen::Vector2d position, force;
    };

    struct YadeFiles
    {
      std::string spheres, contacts, walls;
    };

    enum class YadeKind
    {
      spheres,
      contacts,
      walls,
      wall_table,
      vtk,
      unknown
    };

    bool contains_word(const std::vector<std::string_view> &words, const std::string_view word)
    {
      return std::find(words.begin(), words.end(), word) != words.end();
    }

    // Uses the names in the comments above the numbers. Without them a row of 15 numbers is an interaction.
    YadeKind kind_of(const std::string &path)
    {
      const std::string ending = std::filesystem::path(path).extension().string();
      if (ending == ".vtu" || ending == ".vtp")
        return YadeKind::vtk;
      if (is_wall_table(path))
        return YadeKind::wall_table;
      TextLines lines(path);
      while (!lines.at_end())
        {
          const std::string_view line  = discrete::trimmed(lines.take("a line"));
          const auto             words = words_of(line);
          if (words.empty())
            continue;
          if (line[0] != '#')
            return words.size() == 15 ? YadeKind::contacts : YadeKind::unknown;
          if (contains_word(words, "id1") && contains_word(words, "id2"))
            return YadeKind::contacts;
          if (contains_word(words, "axis"))
            return YadeKind::walls;
          if (words[0] == "#format" || (contains_word(words, "x") && contains_word(words, "r")))
            return YadeKind::spheres;
        }
      return YadeKind::unknown;
    }

    // Reads "# iter N time T" and then rows: name, id, axis, position x y, force x y on the wall.
    std::vector<std::pair<std::string, YadeWall>> walls_in(const std::string &path, ForeignFrame &frame)
    {
      TextLines                                     lines(path);
      std::vector<std::pair<std::string, YadeWall>> walls;
      while (!lines.at_end())
        {
          const auto words = words_of(lines.take("a wall"));
          for (std::size_t k = 0; k + 1 < words.size() && words[0] == "#"; ++k)
            if (words[k] == "time")
              frame.time = lines.number(words[k + 1], "time");
            else if (words[k] == "iter")
              frame.step = lines.whole(words[k + 1], "iter");
          if (words.empty() || words[0].empty() || words[0][0] == '#')
            continue;
          if (words.size() != 7)
            lines.refuse("expected name, id, axis, position (2 numbers) and force (2 numbers) of a wall");
          YadeWall wall;
          wall.id       = lines.whole(words[1], "id");
          wall.axis     = int(lines.whole(words[2], "axis"));
          wall.position = {lines.number(words[3], "position"), lines.number(words[4], "position")};
          wall.force    = {lines.number(words[5], "force"), lines.number(words[6], "force")};
          if (wall.axis != 0 && wall.axis != 1)
            lines.refuse("axis = " + std::string(words[2]) + "; allowed: 0 (wall across x) or 1 (across y)");
          walls.emplace_back(words[0], wall);
        }
      if (walls.empty())
        throw SceneError(path + ": contains no wall");
      return walls;
    }

    std::map<std::string, YadeFiles> frames_of(const ForeignOptions &options, std::vector<std::string> &tables)
    {
      std::map<std::string, YadeFiles> frames; // by the number in the name
      for (const std::string &path : options.files)
        {
          const YadeKind kind = kind_of(path);
          if (kind == YadeKind::wall_table)
            {
              tables.push_back(path);
              continue;
            }
          if (kind == YadeKind::unknown)
            throw SceneError(
              path + ": the comments above its numbers name columns of neither spheres (x y z r id ...), interactions (id1 id2 "
                     "...) nor walls (name id axis ...)");
          const std::string digits = std::to_string(number_in_name(path));
          YadeFiles        &files  = frames[std::string(12 - std::min<std::size_t>(12, digits.size()), ' ') + digits];
          std::string      &place  = kind == YadeKind::spheres    ? files.spheres
                                     : kind == YadeKind::contacts ? files.contacts
                                                                  : files.walls;
          if (!place.empty())
            throw SceneError(path + ": " + place + " belongs to the same frame (the last number in the name is the frame)");
          place = path;
        }
      return frames;
    }

    NumberTable interactions(const std::string &path)
    {
      TextLines lines(path);
      for (; !lines.at_end(); lines.skip())
        if (const std::string_view line = discrete::trimmed(lines.peek()); !line.empty())
          return read_number_table(path, line[0] == '#' ? std::vector<std::string>() : yade_contact_columns);
      throw SceneError(path + ": contains no row of numbers");
    }

    // normalForce + shearForce acts on id2. A wall is always id1, whatever its number.
    void add_interactions(const std::string &path, const std::map<long, int> &walls, ForeignFrame &frame)
    {
      const NumberTable table = interactions(path);
      std::set<long>    grains;
      for (const ForeignGrain &g : frame.grains)
        grains.insert(g.id);
      const std::size_t id1 = table.place_of("id1"), id2 = table.place_of("id2"), nx = table.place_of("normalForce_x"),
                        ny = table.place_of("normalForce_y");
      const auto sx = table.find("shearForce_x"), sy = table.find("shearForce_y"), px = table.find("contactPoint_x"),
                 py = table.find("contactPoint_y"), depth = table.find("penetrationDepth");
      std::map<long, int> found = walls; // bodies other than spheres
      frame.has_contacts        = true;
      frame.contact_file        = path;
      for (std::size_t row = 0; row < table.n_rows(); ++row)
        {
          ForeignContact contact;
          const long     first = table.whole(row, id1);
          contact.first        = table.whole(row, id2);
          contact.second       = first;
          contact.line         = table.line[row];
          if (grains.count(contact.first) == 0)
            table.refuse(row, "id2 = " + std::to_string(contact.first) + " is not a sphere of " + frame.grain_file);
          if (grains.count(first) == 0)
            {
              if (found.count(first) == 0)
                {
                  found[first] = int(frame.walls.size());
                  frame.walls.push_back({"body " + std::to_string(first)});
                }
              contact.wall = found[first];
            }
          contact.force = {table.at(row, nx), table.at(row, ny)};
          if (sx && sy)
            contact.force += Eigen::Vector2d(table.at(row, *sx), table.at(row, *sy));
          if (px && py)
            contact.point = {table.at(row, *px), table.at(row, *py)};
          if (depth)
            contact.overlap = table.at(row, *depth);
          if (contact.force != Eigen::Vector2d::Zero())
            frame.contacts.push_back(contact);
        }
    }

    ForeignFrame frame_of(const YadeFiles &files, const std::string &number)
    {
      if (files.spheres.empty())
        throw SceneError((files.contacts.empty() ? files.walls : files.contacts) +
                         (discrete::trimmed(number) == "-1"
                            ? ": its name contains no frame number. "
                            : ": there are no spheres of frame " + std::string(discrete::trimmed(number)) + ". ") +
                         "The last number in a file name is the frame, as in contacts_3.txt with spheres_3.txt");
      ForeignFrame frame;
      frame.name              = "_" + std::string(discrete::trimmed(number));
      frame.grain_file        = files.spheres;
      const NumberTable table = read_number_table(files.spheres);
      if (!table.has("id") && !files.contacts.empty())
        throw SceneError(files.spheres + ": has no ids (export.text renumbers the spheres), but " + files.contacts +
                         " refers to grains by id; use export.textExt with format='x_y_z_r_attrs' and attrs=['b.id', ...]");
      frame.grains = grains_of(table);
      std::map<long, int> walls;
      frame.wall_file = files.walls;
      if (!files.walls.empty())
        for (const auto &[name, wall] : walls_in(files.walls, frame))
          {
            walls[wall.id] = int(frame.walls.size());
            frame.walls.push_back({name, std::nullopt, wall.position[wall.axis], 0, wall.force});
          }
      if (!files.contacts.empty())
        add_interactions(files.contacts, walls, frame);
      return frame;
    }
  } // namespace

  ForeignSample read_yade(const ForeignOptions &options)
  {
    if (std::any_of(options.files.begin(), options.files.end(), [](const std::string &p) { return kind_of(p) == YadeKind::vtk; }))
      return read_yade_vtk(options, options.files);
    std::vector<std::string> tables;
    ForeignSample            sample;
    sample.format     = "yade";
    sample.is_spheres = true;
    for (const auto &[number, files] : frames_of(options, tables))
      sample.frames.push_back(frame_of(files, number));
    add_wall_tables(sample, tables);
    return sample;
  }
} // namespace diptych::coupling
