// diptych: reads MercuryDPM: .data with .fstat, .restart
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "coupling/import/mercury_restart.h"
#include "coupling/import/readers.h"
#include "coupling/import/wall_table.h"
#include "coupling/scene/scene_error.h"
#include "discrete/files/csv_file.h"

namespace diptych::coupling
{
  namespace
  {
    constexpr double same_time = 1e-8; // relative; files have ten digits

    // 2D: x y vx vy r angle omega info. 3D: x y z vx vy vz r, three angles, three spins, info. The row number is the id.
    ForeignGrain grain_of_row(TextLines &lines, const long index, const bool is_3d)
    {
      const auto        words  = words_of(lines.take("grain " + std::to_string(index)));
      const std::size_t wanted = is_3d ? 14 : 8;
      if (words.size() != wanted)
        lines.refuse(std::to_string(words.size()) + " entries; a grain has " + std::to_string(wanted));
      const auto   number = [&](const std::size_t k, const char *what) { return lines.number(words[k], what); };
      ForeignGrain g;
      g.id       = index;
      g.line     = lines.line();
      g.position = {number(0, "x"), number(1, "y")};
      g.velocity = {number(is_3d ? 3 : 2, "vx"), number(is_3d ? 4 : 3, "vy")};
      g.radius   = lines.positive(words[is_3d ? 6 : 4], "radius");
      g.rotation = number(is_3d ? 9 : 5, "angle");
      g.spin     = number(is_3d ? 12 : 6, "omega");
      return g;
    }

    void read_data(const std::string &path, ForeignSample &sample)
    {
      TextLines lines(path);
      while (!lines.at_end())
        {
          const auto head = words_of(lines.take("a head: N time and the domain"));
          if (head.empty())
            continue;
          if (head.size() != 6 && head.size() != 8)
            lines.refuse(std::to_string(head.size()) + " entries; the head of a frame has 6 (2D) or 8 (3D)");
          const long count = lines.whole(head[0], "the number of grains");
          if (count < 1)
            lines.refuse("the number of grains is " + std::to_string(count));
          ForeignFrame frame;
          frame.time       = lines.number(head[1], "time");
          frame.name       = "time " + std::string(head[1]);
          frame.grain_file = path;
          for (std::size_t k = 2; k < head.size(); ++k)
            (void)lines.number(head[k], "the domain");
          for (long k = 0; k < count; ++k)
            frame.grains.push_back(grain_of_row(lines, k, head.size() == 8));
          sample.frames.push_back(std::move(frame));
        }
    }

    ForeignFrame &frame_at(ForeignSample &sample, const TextLines &lines, const double time)
    {
      for (ForeignFrame &frame : sample.frames)
        if (std::abs(*frame.time - time) <= same_time * std::abs(time))
          return frame;
      lines.refuse("no frame of the .data file has this time; the frames do not match");
    }

    // Wall k is j = -k-1. Normal and force act on the wall. Its face lies half an overlap before the contact point.
    struct FstatWalls
    {
      std::map<long, int>    place_in_frame;
      std::map<long, double> sum;
      std::map<long, int>    count;
    };

    void add_fstat_wall(ForeignFrame          &frame,
                        FstatWalls            &walls,
                        const long             wall,
                        const Eigen::Vector2d &normal,
                        ForeignContact        &contact)
    {
      const int  axis = std::abs(normal.x()) > std::abs(normal.y()) ? 0 : 1;
      const Side side = axis == 0 ? (normal.x() < 0 ? Side::left : Side::right) : (normal.y() < 0 ? Side::lower : Side::upper);
      if (walls.place_in_frame.count(wall) == 0)
        {
          walls.place_in_frame[wall] = int(frame.walls.size());
          frame.walls.push_back({"wall " + std::to_string(-wall - 1), side});
        }
      walls.sum[wall] += contact.point[axis] - 0.5 * contact.overlap * normal[axis];
      ++walls.count[wall];
      contact.wall  = walls.place_in_frame[wall];
      contact.force = -contact.force;
    }

    void add_fstat_row(TextLines &lines, const std::vector<std::string_view> &words, ForeignFrame &frame, FstatWalls &walls)
    {
      if (words.size() != 16)
        lines.refuse(std::to_string(words.size()) + " entries; a contact has 16");
      const auto            number = [&](const std::size_t k, const char *what) { return lines.number(words[k], what); };
      const Eigen::Vector2d normal(number(10, "nx"), number(11, "ny")), tangent(number(13, "tx"), number(14, "ty"));
      if (!is_unit(normal))
        lines.refuse("nx, ny are not a unit normal; the sum of their squares is " + discrete::exact_text(normal.squaredNorm()));
      ForeignContact contact;
      contact.first   = lines.whole(words[1], "the first grain");
      contact.second  = lines.whole(words[2], "the second body");
      contact.point   = {number(3, "cx"), number(4, "cy")};
      contact.overlap = number(6, "overlap");
      contact.force   = number(8, "fn") * normal + number(9, "ft") * tangent;
      contact.line    = lines.line();
      if (contact.second < 0)
        add_fstat_wall(frame, walls, contact.second, normal, contact);
      frame.contacts.push_back(contact);
    }

    void read_fstat(const std::string &path, ForeignSample &sample)
    {
      TextLines                            lines(path);
      ForeignFrame                        *frame = nullptr;
      std::map<ForeignFrame *, FstatWalls> walls;
      int                                  comment = 0;
      while (!lines.at_end())
        {
          const auto words = words_of(lines.take("a contact"));
          if (words.empty())
            continue;
          if (words[0] == "#")
            {
              if (comment++ % 3 != 0)
                continue;
              if (words.size() != 3)
                lines.refuse("expected '# TIME 1' at the head of a frame");
              frame               = &frame_at(sample, lines, lines.number(words[1], "time"));
              frame->has_contacts = true;
              frame->contact_file = path;
              continue;
            }
          if (frame == nullptr)
            lines.refuse("this contact comes before the first head '# TIME 1'");
          if (std::abs(lines.number(words[0], "time") - *frame->time) > same_time * std::abs(*frame->time))
            lines.refuse("the time differs from that of the frame's head");
          add_fstat_row(lines, words, *frame, walls[frame]);
        }
      for (auto &[of, found] : walls)
        for (const auto &[wall, place] : found.place_in_frame)
          of->walls[std::size_t(place)].place = found.sum[wall] / found.count[wall];
    }

    // A contact of two free grains occurs as (i, j) and as (j, i). Without fixed grains, a contact that occurs once shows a
    // truncated file.
    void require_both_halves(const ForeignFrame &frame, const bool may_be_fixed)
    {
      std::map<std::pair<long, long>, int> seen;
      for (const ForeignContact &c : frame.contacts)
        if (c.wall < 0)
          ++seen[{std::min(c.first, c.second), std::max(c.first, c.second)}];
      for (const auto &[pair, times] : seen)
        if (times != 2 && !may_be_fixed)
          throw SceneError(frame.contact_file + ": frame " + frame.name + ": the contact of " + std::to_string(pair.first) +
                           " and " + std::to_string(pair.second) + " occurs " + std::to_string(times) +
                           " times, not twice; is the file truncated? (With fixed grains, add the .restart file.)");
    }

    // The .ene file contains the number of contacts of every frame.
    void check_counts(const std::string &path, const ForeignSample &sample)
    {
      const NumberTable table = read_number_table(path);
      const std::size_t time = table.place_of("time"), count = table.place_of("collisions");
      for (const ForeignFrame &frame : sample.frames)
        for (std::size_t row = 0; row < table.n_rows(); ++row)
          {
            const long walls = std::count_if(frame.contacts.begin(), frame.contacts.end(),
                                             [](const auto &c) { return c.wall >= 0; });
            const long found = (long(frame.contacts.size()) - walls) / 2 + walls;
            if (std::abs(table.at(row, time) - *frame.time) <= 1e-5 * std::abs(*frame.time) && table.whole(row, count) != found)
              table.refuse(row, "counts " + std::to_string(table.whole(row, count)) + " contacts; " + frame.contact_file +
                                  " has " + std::to_string(found));
          }
    }

    struct MercuryFiles
    {
      std::string              data, fstat, energies;
      std::vector<std::string> restarts, wall_tables;
    };

    MercuryFiles sorted_mercury(const ForeignOptions &options)
    {
      MercuryFiles files;
      for (const std::string &path : options.files)
        {
          const std::string suffix = std::filesystem::path(path).extension().string();
          std::string      *place  = suffix == ".data"    ? &files.data
                                     : suffix == ".fstat" ? &files.fstat
                                     : suffix == ".ene"   ? &files.energies
                                                          : nullptr;
          if (place != nullptr && !place->empty())
            throw SceneError(path + ": " + *place + " was given as well; import one run at a time");
          if (place != nullptr)
            *place = path;
          else if (path.find(".restart") != std::string::npos)
            files.restarts.push_back(path);
          else if (is_wall_table(path) || !columns_for(options, "walls").empty())
            files.wall_tables.push_back(path);
          else
            throw SceneError(path + ": is neither *.data, *.fstat, *.restart* or *.ene nor a wall table (time, width, height; "
                                    "without column names use --columns walls=time,width,height,...)");
        }
      if (files.data.empty() && files.restarts.empty())
        throw SceneError("import mercurydpm: no file contains grains (*.data or *.restart)");
      if (!files.fstat.empty() && files.data.empty())
        throw SceneError(files.fstat + ": needs the .data file of the same run");
      return files;
    }

    void take_masses(const MercuryRestart &restart, ForeignSample &sample)
    {
      sample.is_spheres = restart.particle_dimensions == 3;
      sample.density    = restart.density;
      for (ForeignFrame &frame : sample.frames)
        for (ForeignGrain &g : frame.grains)
          if (std::isnan(g.mass))
            g.mass = restart.mass_of(g.radius);
    }
  } // namespace

  ForeignSample read_mercurydpm(const ForeignOptions &options)
  {
    const MercuryFiles files = sorted_mercury(options);
    ForeignSample      sample;
    sample.format = "mercurydpm";
    std::vector<MercuryRestart> restarts;
    for (const std::string &path : files.restarts)
      restarts.push_back(read_mercury_restart(path));
    if (!files.data.empty())
      {
        read_data(files.data, sample);
        if (!files.fstat.empty())
          read_fstat(files.fstat, sample);
        const bool fixed = std::any_of(restarts.begin(), restarts.end(), [](const auto &r) { return r.has_fixed; });
        for (const ForeignFrame &frame : sample.frames)
          require_both_halves(frame, fixed);
        if (!files.energies.empty())
          check_counts(files.energies, sample);
      }
    else
      for (MercuryRestart &restart : restarts)
        sample.frames.push_back(restart.frame);
    if (!restarts.empty())
      take_masses(restarts.front(), sample);
    else
      sample.lacking.push_back("density (a .restart file of the run contains it)");
    for (const std::string &path : files.wall_tables)
      {
        const bool is_named = is_wall_table(path);
        add_wall_table(sample, read_number_table(path, is_named ? std::vector<std::string>() : columns_for(options, "walls")));
        if (!is_named)
          sample.unnamed = {"walls"};
      }
    return sample;
  }
} // namespace diptych::coupling
