// diptych: reads restart files of MercuryDPM
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/import/mercury_restart.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "coupling/import/text_lines.h"

namespace diptych::coupling
{
  namespace
  {
    using Words = std::vector<std::string_view>;

    // `n` words after a keyword, in a line "Name key value value key value".
    Words after(const TextLines &lines, const Words &words, const std::string_view key, const std::size_t n)
    {
      const auto found = std::find(words.begin(), words.end(), key);
      if (found == words.end() || std::size_t(words.end() - found) <= n)
        lines.refuse("expected '" + std::string(key) + "' with " + std::to_string(n) + " values");
      return {found + 1, found + 1 + long(n)};
    }

    bool has(const Words &words, const std::string_view key)
    {
      return std::find(words.begin(), words.end(), key) != words.end();
    }

    Eigen::Vector2d plane_vector(const TextLines &lines, const Words &words, const std::string &key)
    {
      const Words values = after(lines, words, key, 3);
      return {lines.number(values[0], key), lines.number(values[1], key)};
    }

    // The wall's normal points out of the sample. It is the x axis, turned by the quaternion (w, x, y, z).
    Side side_of(const TextLines &lines, const Words &words)
    {
      const Words  q = after(lines, words, "orientation", 4);
      const double w = lines.number(q[0], "orientation"), x = lines.number(q[1], "orientation"),
                   y = lines.number(q[2], "orientation"), z = lines.number(q[3], "orientation");
      const double nx = w * w + x * x - y * y - z * z, ny = 2 * (x * y + w * z);
      if (std::abs(nx) > 0.99)
        return nx < 0 ? Side::left : Side::right;
      if (std::abs(ny) > 0.99)
        return ny < 0 ? Side::lower : Side::upper;
      lines.refuse("the normal of this wall is neither along x nor along y");
    }

    void read_wall(TextLines &lines, std::map<long, int> &place, ForeignFrame &frame)
    {
      const Words words = words_of(lines.take("a wall"));
      if (words.empty() || words[0] != "InfiniteWall")
        lines.refuse("expected an InfiniteWall; other shapes are not supported");
      ForeignWall wall;
      const long  id                 = lines.whole(after(lines, words, "id", 1)[0], "id");
      wall.name                      = "wall " + std::to_string(id);
      wall.side                      = side_of(lines, words);
      const bool            sideways = wall.side == Side::left || wall.side == Side::right;
      const Eigen::Vector2d position = plane_vector(lines, words, "position");
      wall.place                     = sideways ? position.x() : position.y();
      wall.force                     = plane_vector(lines, words, "force");
      place[id]                      = int(frame.walls.size());
      frame.walls.push_back(wall);
    }

    void read_particle(TextLines &lines, MercuryRestart &restart, const long index)
    {
      const Words  words = words_of(lines.take("a particle"));
      ForeignGrain g;
      g.line               = lines.line();
      g.id                 = has(words, "id") ? lines.whole(after(lines, words, "id", 1)[0], "id") : index;
      g.position           = plane_vector(lines, words, "position");
      g.velocity           = plane_vector(lines, words, "velocity");
      g.resultant          = plane_vector(lines, words, "force");
      g.spin               = lines.number(after(lines, words, "angularVelocity", 3)[2], "angularVelocity");
      g.radius             = lines.positive(after(lines, words, "radius", 1)[0], "radius");
      const Words q        = after(lines, words, "orientation", 4);
      g.rotation           = 2 * std::atan2(lines.number(q[3], "orientation"), lines.number(q[0], "orientation"));
      const double inverse = lines.number(after(lines, words, "invMass", 1)[0], "invMass");
      if (inverse < 0)
        lines.refuse("invMass is negative");
      restart.has_fixed |= inverse == 0;
      if (inverse > 0)
        g.mass = 1 / inverse;
      restart.frame.grains.push_back(g);
    }

    void read_interaction(TextLines &lines, const std::map<long, int> &walls, ForeignFrame &frame)
    {
      const Words    words   = words_of(lines.take("an interaction"));
      const bool     is_wall = has(words, "particleWallIds");
      const Words    pair    = after(lines, words, is_wall ? "particleWallIds" : "particleIds", 2);
      ForeignContact c;
      c.first  = lines.whole(pair[0], "the first body");
      c.second = lines.whole(pair[1], "the second body");
      c.point  = plane_vector(lines, words, "contactPoint");
      c.force  = plane_vector(lines, words, "force");
      c.line   = lines.line();
      if (is_wall)
        {
          const auto wall = walls.find(c.second);
          if (wall == walls.end())
            lines.refuse("wall " + std::to_string(c.second) + " does not exist");
          c.wall = wall->second;
        }
      frame.contacts.push_back(c);
    }

    long section_size(TextLines &lines, const Words &words)
    {
      if (words.size() != 2)
        lines.refuse("expected '" + std::string(words[0]) + " N'");
      return lines.whole(words[1], "the number of " + std::string(words[0]));
    }
  } // namespace

  double MercuryRestart::mass_of(const double radius) const
  {
    return density * M_PI * radius * radius * (particle_dimensions == 3 ? 4. / 3 * radius : 1.);
  }

  MercuryRestart read_mercury_restart(const std::string &path)
  {
    TextLines           lines(path);
    MercuryRestart      restart;
    std::map<long, int> walls;
    bool                interactions = false;
    restart.frame.grain_file = restart.frame.contact_file = path;
    while (!lines.at_end())
      {
        const Words words = words_of(lines.take("a section"));
        if (words.empty())
          continue;
        if (has(words, "timeStep") && has(words, "time"))
          {
            const std::string_view time = after(lines, words, "time", 1)[0];
            restart.frame.time          = lines.number(time, "time");
            restart.frame.name          = "time " + std::string(time);
          }
        if (has(words, "particleDimensions"))
          restart.particle_dimensions = int(lines.whole(after(lines, words, "particleDimensions", 1)[0], "particleDimensions"));
        if (has(words, "density") && std::isnan(restart.density))
          restart.density = lines.positive(after(lines, words, "density", 1)[0], "density");
        if (words[0] == "Walls")
          for (long n = section_size(lines, words), k = 0; k < n; ++k)
            read_wall(lines, walls, restart.frame);
        else if (words[0] == "Particles")
          for (long n = section_size(lines, words), k = 0; k < n; ++k)
            read_particle(lines, restart, k);
        else if (words[0] == "Interactions")
          {
            interactions = true;
            for (long n = section_size(lines, words), k = 0; k < n; ++k)
              read_interaction(lines, walls, restart.frame);
          }
      }
    restart.frame.has_contacts = interactions;
    if (restart.frame.grains.empty() || !restart.frame.time)
      lines.refuse("the file ends without particles or without a time; is it a restart file, and complete?");
    return restart;
  }
} // namespace diptych::coupling
