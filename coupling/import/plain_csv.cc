// diptych: reads plain tables of particles and contacts
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <cmath>
#include <map>

#include "coupling/import/readers.h"
#include "coupling/import/wall_table.h"
#include "coupling/scene/scene_error.h"

namespace diptych::coupling
{
  namespace
  {
    std::string listed_names(const std::vector<std::string> &names)
    {
      std::string text;
      for (const std::string &name : names)
        text += (text.empty() ? "" : ", ") + name;
      return text;
    }

    struct CsvFrameFiles
    {
      std::optional<NumberTable> particles, contacts;
    };

    // Splits a table by its column "frame". Without one, the number in the file's name is the frame.
    std::map<long, NumberTable> split_by_frame(const NumberTable &table)
    {
      const auto column = table.find("frame");
      if (!column)
        return {{number_in_name(table.path), table}};
      std::map<long, NumberTable> parts;
      for (std::size_t row = 0; row < table.n_rows(); ++row)
        {
          NumberTable &part = parts[table.whole(row, *column)];
          part.path         = table.path;
          part.columns      = table.columns;
          part.values.insert(part.values.end(), table.values.begin() + long(row * table.columns.size()),
                             table.values.begin() + long((row + 1) * table.columns.size()));
          part.line.push_back(table.line[row]);
        }
      return parts;
    }

    // A negative second body is a wall. The grains that touch it show which one.
    void add_csv_contacts(const NumberTable &table, ForeignFrame &frame)
    {
      const std::size_t i = table.place_of_any({"i", "id1", "a"}, "the first grain"),
                        j = table.place_of_any({"j", "id2", "b"}, "the second grain"), fx = table.place_of("fx"),
                        fy = table.place_of("fy");
      const auto px = table.find_any({"px", "point_x"}), py = table.find_any({"py", "point_y"}),
                 overlap = table.find_any({"overlap", "penetration"});
      std::map<long, int> walls;
      frame.has_contacts = true;
      frame.contact_file = table.path;
      for (std::size_t row = 0; row < table.n_rows(); ++row)
        {
          ForeignContact contact;
          contact.first  = table.whole(row, i);
          contact.second = table.whole(row, j);
          contact.force  = {table.at(row, fx), table.at(row, fy)};
          contact.line   = table.line[row];
          if (contact.first < 0)
            {
              if (contact.second < 0)
                table.refuse(row, "this is a contact of two walls");
              std::swap(contact.first, contact.second);
              contact.force = -contact.force;
            }
          if (contact.second < 0)
            {
              if (walls.count(contact.second) == 0)
                {
                  walls[contact.second] = int(frame.walls.size());
                  frame.walls.push_back({"wall " + std::to_string(contact.second)});
                }
              contact.wall = walls[contact.second];
            }
          if (px && py)
            contact.point = {table.at(row, *px), table.at(row, *py)};
          if (overlap)
            contact.overlap = table.at(row, *overlap);
          if (contact.force != Eigen::Vector2d::Zero())
            frame.contacts.push_back(contact);
        }
    }

    ForeignFrame csv_frame(const long number, const CsvFrameFiles &files)
    {
      if (!files.particles)
        throw SceneError(files.contacts->path +
                         (number < 0 ? ": its name contains no frame number, and it has no column frame. "
                                     : ": there are no particles of frame " + std::to_string(number) + ". ") +
                         "The last number in a file name is the frame, as in contacts_3.csv with particles_3.csv");
      ForeignFrame frame;
      frame.name       = std::to_string(number);
      frame.step       = number;
      frame.grain_file = files.particles->path;
      frame.grains     = grains_of(*files.particles);
      if (const auto time = files.particles->find("time"))
        frame.time = files.particles->at(0, *time);
      if (files.contacts && !files.particles->has("id"))
        throw SceneError(files.particles->path + ": has no column id, but " + files.contacts->path + " refers to grains by id");
      if (files.contacts)
        add_csv_contacts(*files.contacts, frame);
      return frame;
    }
  } // namespace

  ForeignSample read_plain_csv(const ForeignOptions &options)
  {
    std::map<long, CsvFrameFiles> frames;
    std::vector<std::string>      tables;
    for (const std::string &path : options.files)
      if (is_wall_table(path))
        tables.push_back(path);
      else
        for (auto &[number, table] : split_by_frame(read_number_table(path)))
          {
            const bool is_particles = table.has("x") && table.has("y"), is_contacts = table.has("fx") && table.has("fy");
            if (!is_particles && !is_contacts)
              throw SceneError(path +
                               ": has the columns of neither particles (id, x, y, r), contacts (i, j, fx, fy) nor walls (frame, "
                               "width, height); its columns are " +
                               listed_names(table.columns));
            std::optional<NumberTable> &place = is_particles ? frames[number].particles : frames[number].contacts;
            if (place)
              throw SceneError(path + ": " + place->path + " belongs to the same frame " + std::to_string(number));
            place = table;
          }
    ForeignSample sample;
    sample.format  = "csv";
    sample.density = not_told;
    for (const auto &[number, files] : frames)
      sample.frames.push_back(csv_frame(number, files));
    add_wall_tables(sample, tables);
    return sample;
  }
} // namespace diptych::coupling
