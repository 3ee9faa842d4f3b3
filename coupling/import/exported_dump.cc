// diptych: all stages of the grains as dump files of LAMMPS, which OVITO opens
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/import/exported_dump.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "discrete/panel/snapshot_views.h"

namespace diptych::coupling
{
  namespace
  {
    using discrete::ContactForce;
    using discrete::Snapshot;
    using discrete::VtuField;

    std::ostringstream numbers()
    {
      std::ostringstream out;
      out.precision(std::numeric_limits<double>::max_digits10);
      return out;
    }

    // Head of a section. Sides without a wall have the outermost surface of the grains as the bound of the box.
    void begin(std::ostream &out, const std::size_t stage, const Snapshot &s, const char *rows, const std::size_t n_rows)
    {
      const bool periodic = s.cell_width > 0;
      double     left = s.left_x, right = s.right_x;
      for (std::size_t i = 0; i < s.radius.size(); ++i)
        {
          left  = std::fmin(left, s.position[i].x() - s.radius[i]);
          right = std::fmax(right, s.position[i].x() + s.radius[i]);
        }
      if (periodic)
        {
          left  = 0;
          right = s.cell_width;
        }
      out << "ITEM: TIMESTEP\n" << stage << '\n';
      if (std::isfinite(s.time))
        out << "ITEM: TIME\n" << s.time << '\n';
      out << "ITEM: NUMBER OF " << rows << '\n'
          << n_rows << "\nITEM: BOX BOUNDS " << (periodic ? "pp" : "ff") << " ff pp\n"
          << left << ' ' << right << '\n'
          << s.lower_y << ' ' << s.upper_y << "\n-0.5 0.5\n";
    }

    // Names that LAMMPS and OVITO know; other vectors have the axis behind their name.
    std::string columns_of(const VtuField &field)
    {
      if (field.name == "velocity")
        return " vx vy vz";
      if (field.name == "spin")
        return " omegaz";
      if (field.n_components == 1)
        return " " + field.name;
      return " " + field.name + "_x " + field.name + "_y " + field.name + "_z";
    }

    bool is_listed(const Snapshot &s, const ContactForce &c)
    {
      return std::size_t(c.j) < s.position.size() && c.force != Eigen::Vector2d::Zero();
    }
  } // namespace

  std::string grain_dump(const std::vector<Snapshot> &snapshots)
  {
    std::ostringstream out = numbers();
    for (std::size_t stage = 0; stage < snapshots.size(); ++stage)
      {
        const Snapshot             &s      = snapshots[stage];
        const std::vector<VtuField> fields = discrete::grains_of(s).fields;
        begin(out, stage, s, "ATOMS", s.position.size());
        out << "ITEM: ATOMS id type x y z";
        for (const VtuField &field : fields)
          out << columns_of(field);
        for (std::size_t i = 0; i < s.position.size(); ++i)
          {
            out << '\n' << i + 1 << ' ' << 1 + s.fixed[i] << ' ' << s.position[i].x() << ' ' << s.position[i].y() << " 0";
            for (const VtuField &field : fields)
              for (std::size_t k = 0; k < field.n_components; ++k)
                out << ' ' << field.values[i * field.n_components + k];
          }
        out << '\n';
      }
    return out.str();
  }

  std::string contact_dump(const std::vector<Snapshot> &snapshots)
  {
    std::ostringstream out = numbers();
    for (std::size_t stage = 0; stage < snapshots.size(); ++stage)
      {
        const Snapshot &s = snapshots[stage];
        begin(out, stage, s, "ENTRIES",
              std::size_t(std::count_if(s.contacts.begin(), s.contacts.end(), [&](const auto &c) { return is_listed(s, c); })));
        out << "ITEM: ENTRIES index patom1 patom2 force fx fy p1 p2\n";
        std::size_t index = 0;
        for (const ContactForce &c : s.contacts)
          if (is_listed(s, c))
            {
              const double          size   = c.force.dot(c.normal);
              const Eigen::Vector2d normal = size * c.normal, tangential = c.force - normal;
              out << ++index << ' ' << c.i + 1 << ' ' << c.j + 1 << ' ' << size << ' ' << normal.x() << ' ' << normal.y() << ' '
                  << tangential.x() << ' ' << tangential.y() << '\n';
            }
      }
    return out.str();
  }
} // namespace diptych::coupling
