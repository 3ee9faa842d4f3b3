// diptych: writes a sample in the format of LMGC90
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/import/lmgc90_datbox.h"

#include <cmath>
#include <cstdio>

#include "coupling/scene/scene_error.h"

namespace diptych::coupling
{
  namespace
  {
    std::string text_with(const char *format, const double value)
    {
      char text[40];
      std::snprintf(text, sizeof text, format, value);
      return text;
    }

    std::string real(const double value)
    {
      return text_with("%14.7E", value);
    }

    struct Datbox
    {
      std::string bodies, motions, drives;
      int         n = 0;

      // `mass`: nickname of the bulk, equivalent radius, radius of gyration. `contactor`: the line below $tacty.
      void add(const Eigen::Vector2d &x, const double turn, const std::string &mass, const std::string &contactor)
      {
        const std::string head = "$bdyty\n RBDY2  " + text_with("%5.0f", ++n) + "\n";
        bodies += head + "$blmty\n PLAIN      1  behav  " + mass + "\n$nodty\n NO3xx      1                coo1=" + real(x.x()) +
                  "  coo2=" + real(x.y()) + "  coo3=" + real(0) + "  \n$tacty\n " + contactor + "\n$$$$$$\n";
        motions += head + "$nodty\n NO3xx      1                X(1)=" + real(0) + "  X(2)=" + real(0) + "  X(3)=" + real(turn) +
                   "\n                             V(1)=" + real(0) + "  V(2)=" + real(0) + "  V(3)=" + real(0) + "\n$$$$$$\n";
      }

      // Fixes all three components.
      void hold()
      {
        drives += "$bdyty\n RBDY2  " + text_with("%5.0f", n) +
                  "\n$nodty\n NO3xx      1\n$dofty  numbr [CT......+......AMP..*..cos.(..OMEGA.*.time.+.PHI..)]" +
                  "...*...[RAMPI.....+.....RAMP.*.time]\n";
        for (const int component : {1, 2, 3})
          {
            drives += " vlocy      " + std::to_string(component);
            for (const double value : {0., 0., 0., 0., 1., 0.})
              drives += text_with(" %14.7e", value);
            drives += "\n";
          }
        drives += "$$$$$$\n";
      }
    };

    void add_wall(Datbox                &box,
                  const Eigen::Vector2d &centre,
                  const bool             upright,
                  const double           half_length,
                  const double           half_thickness)
    {
      const double avrd = std::sqrt(4 * half_length * half_thickness / M_PI);
      const double gyrd = std::sqrt((half_length * half_length + half_thickness * half_thickness) / 3);
      box.add(centre, upright ? M_PI / 2 : 0., "WALLx  avrd=" + real(avrd) + "  gyrd=" + real(gyrd),
              "JONCx      1  color  WALLx  axe1=" + real(half_length) + "  axe2=" + real(half_thickness));
      box.hold();
    }

    void add_walls(const discrete::Snapshot &s, Datbox &box)
    {
      const double t = 0.5 * s.mean_diameter, height = s.upper_y - s.lower_y;
      double       left = s.left_x, right = s.right_x;
      const bool   sides = std::isfinite(left) && std::isfinite(right);
      if (!sides)
        {
          left  = HUGE_VAL;
          right = -HUGE_VAL;
          for (const Eigen::Vector2d &x : s.position)
            {
              left  = std::min(left, x.x());
              right = std::max(right, x.x());
            }
        }
      const double middle = 0.5 * (left + right), half = 0.75 * (right - left);
      add_wall(box, {middle, s.lower_y - t}, false, half, t);
      add_wall(box, {middle, s.upper_y + t}, false, half, t);
      if (!sides)
        return;
      add_wall(box, {left - t, 0.5 * (s.lower_y + s.upper_y)}, true, 0.75 * height, t);
      add_wall(box, {right + t, 0.5 * (s.lower_y + s.upper_y)}, true, 0.75 * height, t);
    }

    std::string contact_laws(const Scene &scene, const discrete::Snapshot &s)
    {
      const auto law = [](const char *name, const double friction) {
        return std::string("$behav\n ") + name + "  IQS_CLB                         fric=" + real(friction) + "\n\n";
      };
      const auto see = [&](const char *name, const char *antagonist, const char *colour) {
        return std::string("$seety\n cdbdy  cdtac  cdcol  behav  anbdy  antac  ancol       alert\n RBDY2  DISKx  BLEUx  ") +
               name + "  RBDY2  " + antagonist + "  " + colour + "      " + real(0.05 * s.mean_diameter) + "\n\n";
      };
      return "! laws of contact\n\n" + law("iqsc0", scene.discrete.law.friction) +
             law("iqsc1", scene.discrete.law.platen_friction) + see("iqsc0", "DISKx", "BLEUx") + see("iqsc1", "JONCx", "WALLx");
    }
  } // namespace

  ExportedFiles lmgc90_datbox(const Scene &scene, const discrete::Snapshot &s)
  {
    if (s.cell_width > 0)
      throw SceneError("export: the sample is periodic (discrete/lateral) and has no side walls, which other codes need");
    Datbox box;
    for (std::size_t i = 0; i < s.radius.size(); ++i)
      box.add(s.position[i], 0., "DISCx  avrd=" + real(s.radius[i]) + "  gyrd=" + real(s.radius[i] / std::sqrt(2.)),
              "DISKx      1  color  BLEUx  byrd=" + real(s.radius[i]));
    add_walls(s, box);
    const std::string density = real(scene.sample.density);
    return {{"DATBOX/BODIES.DAT", box.bodies},
            {"DATBOX/DOF.INI", "! DOF\n\n$steps        0              time=" + real(0) + "\n\n" + box.motions},
            {"DATBOX/BULK_BEHAV.DAT", "! bulk behaviours\n\n$gravy\n                   grv1=" + real(0) + "  grv2=" + real(0) +
                                        "  grv3=" + real(0) +
                                        "\n$behav  lawty\n DISCx  RIGID                           Umas=" + density +
                                        "\n$behav  lawty\n WALLx  RIGID                           Umas=" + density + "\n"},
            {"DATBOX/TACT_BEHAV.DAT", contact_laws(scene, s)},
            {"DATBOX/DRV_DOF.DAT", "! DOF\n" + box.drives}};
  }
} // namespace diptych::coupling
