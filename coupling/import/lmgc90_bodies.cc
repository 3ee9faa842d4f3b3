// diptych: bodies of an LMGC90 run, shared by its two formats
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/import/lmgc90_bodies.h"

#include <cmath>

#include "coupling/import/lmgc90_text.h"
#include "coupling/scene/scene_error.h"

namespace diptych::coupling
{
  namespace
  {
    bool holds(const std::string_view line, const std::string_view word)
    {
      return line.find(word) != std::string_view::npos;
    }
  } // namespace

  Lmgc90Bodies read_lmgc90_bodies(const std::string &path)
  {
    TextLines    lines(path);
    Lmgc90Bodies bodies;
    Lmgc90Body  *body = nullptr;
    while (!lines.at_end())
      {
        const std::string_view line = lines.take("a body");
        if (const long number = lmgc90_body_number(lines, line); number > 0)
          {
            if (bodies.count(number) > 0)
              lines.refuse("body " + std::to_string(number) + " occurs twice");
            body = &bodies[number];
          }
        if (body == nullptr)
          continue;
        if (holds(line, "avrd="))
          {
            const auto words        = words_of(line);
            body->material          = words.size() > 3 ? words[3] : std::string_view();
            body->equivalent_radius = lmgc90_field(lines, line, "avrd=");
          }
        if (holds(line, "coo1="))
          body->reference = {lmgc90_field(lines, line, "coo1="), lmgc90_field(lines, line, "coo2=")};
        if (holds(line, "byrd="))
          body->disc_radius = lmgc90_field(lines, line, "byrd=");
        if (holds(line, "axe1="))
          {
            body->half_length    = lmgc90_field(lines, line, "axe1=");
            body->half_thickness = lmgc90_field(lines, line, "axe2=");
          }
        if (holds(line, "DISKx") || holds(line, "JONCx") || !holds(line, "color"))
          continue;
        lines.refuse("this contactor is neither DISKx nor JONCx");
      }
    for (const auto &[number, found] : bodies)
      if (!found.reference.allFinite() || (!found.is_wall() && !(found.disc_radius > 0)))
        throw SceneError(path + ": body " + std::to_string(number) +
                         " has no position (coo1, coo2) or no radius (byrd); is the file truncated?");
    if (bodies.empty())
      throw SceneError(path + ": contains no body RBDY2");
    return bodies;
  }

  std::map<std::string, double> read_lmgc90_densities(const std::string &path)
  {
    TextLines                     lines(path);
    std::map<std::string, double> densities;
    while (!lines.at_end())
      {
        const std::string_view line  = lines.take("a behaviour");
        const auto             words = words_of(line);
        if (!words.empty() && !words[0].empty() && words[0][0] != '!' && holds(line, "Umas="))
          densities[std::string(words[0])] = lmgc90_field(lines, line, "Umas=");
      }
    if (densities.empty())
      throw SceneError(path + ": contains no density (Umas=)");
    return densities;
  }

  std::map<long, int> lmgc90_walls(const Lmgc90Bodies &bodies)
  {
    std::map<long, int> walls;
    for (const auto &[number, body] : bodies)
      if (body.is_wall())
        walls.emplace(number, int(walls.size()));
    return walls;
  }

  void place_lmgc90_bodies(const Lmgc90Bodies                  &bodies,
                           const std::map<std::string, double> &densities,
                           const std::map<long, Lmgc90Motion>  &motions,
                           ForeignFrame                        &frame)
  {
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    for (const auto &[number, body] : bodies)
      {
        const auto motion = motions.find(number);
        if (motion == motions.end())
          throw SceneError(frame.grain_file + ": frame " + frame.name + ": body " + std::to_string(number) +
                           " of BODIES.DAT has no displacement");
        if (body.is_wall())
          continue;
        ForeignGrain g;
        g.id           = number;
        g.position     = body.reference + motion->second.displacement.head<2>();
        g.velocity     = motion->second.velocity.head<2>();
        g.rotation     = motion->second.displacement.z();
        g.spin         = motion->second.velocity.z();
        g.radius       = body.disc_radius;
        const auto rho = densities.find(body.material);
        if (rho != densities.end())
          g.mass = rho->second * M_PI * body.equivalent_radius * body.equivalent_radius;
        frame.grains.push_back(g);
        middle += g.position;
      }
    middle /= std::max<double>(1, double(frame.grains.size()));
    for (const auto &[number, body] : bodies)
      if (body.is_wall())
        {
          const Lmgc90Motion   &motion = motions.at(number);
          const Eigen::Vector2d centre = body.reference + motion.displacement.head<2>();
          const double          turn   = std::abs(std::sin(motion.displacement.z()));
          if (turn > 1e-4 && turn < 1 - 1e-8)
            throw SceneError(frame.grain_file + ": wall body " + std::to_string(number) +
                             " is inclined (X(3)); only horizontal and vertical walls are supported");
          const bool  upright = turn > 0.5;
          ForeignWall wall;
          wall.name   = "body " + std::to_string(number);
          wall.side   = upright ? (centre.x() < middle.x() ? Side::left : Side::right)
                                : (centre.y() < middle.y() ? Side::lower : Side::upper);
          wall.place  = upright ? centre.x() + (centre.x() < middle.x() ? 1 : -1) * body.half_thickness
                                : centre.y() + (centre.y() < middle.y() ? 1 : -1) * body.half_thickness;
          wall.travel = upright ? motion.displacement.y() : motion.displacement.x();
          frame.walls.push_back(wall);
        }
  }

  ForeignContact foreign_contact(const Lmgc90Contact &c, const std::map<long, int> &walls)
  {
    ForeignContact contact;
    contact.first  = c.candidate;
    contact.second = c.antagonist;
    if (const auto wall = walls.find(c.antagonist); wall != walls.end())
      contact.wall = wall->second;
    contact.force   = c.normal * c.direction + c.tangential * Eigen::Vector2d(c.direction.y(), -c.direction.x());
    contact.point   = c.point;
    contact.overlap = -c.gap;
    contact.status  = c.slides ? discrete::ContactStatus::slipping : discrete::ContactStatus::sticking;
    contact.line    = c.line;
    return contact;
  }
} // namespace diptych::coupling
