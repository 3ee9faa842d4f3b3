// diptych: exports a sample as a start for other codes
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/import/exported_sample.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <sstream>

#include "coupling/import/exported_dump.h"
#include "coupling/scene/scene_error.h"
#include "discrete/files/csv_file.h"

namespace diptych::coupling
{
  namespace
  {
    using discrete::exact_text;
    using discrete::Snapshot;

    // Lower left and upper right corner of the walls; missing sides are NaN.
    struct ExportBox
    {
      double left, right, lower, upper;

      bool has_sides() const { return std::isfinite(left) && std::isfinite(right); }
    };

    ExportBox box_of(const Snapshot &s)
    {
      if (s.cell_width > 0)
        throw SceneError("export: the sample is periodic (discrete/lateral) and has no side walls, which other codes need");
      return {s.left_x, s.right_x, s.lower_y, s.upper_y};
    }

    struct IsMissing
    {
      bool operator()(const double x) const { return std::isnan(x); }
      bool operator()(const Eigen::Vector2d &x) const { return x.array().isNaN().any(); }
    };
    constexpr IsMissing is_missing;

    std::ostringstream exact_stream()
    {
      std::ostringstream out;
      out.precision(std::numeric_limits<double>::max_digits10);
      return out;
    }

    ExportedFiles as_csv(const Snapshot &s, const int stage)
    {
      std::ostringstream particles = exact_stream(), contacts = exact_stream(), walls = exact_stream();
      // Columns that an imported sample does not have are omitted.
      const auto is_complete = [](const auto &values) { return std::none_of(values.begin(), values.end(), is_missing); };
      const bool mass = is_complete(s.mass), motion = is_complete(s.velocity), spin = is_complete(s.spin);
      particles << "id,x,y,r" << (mass ? ",mass" : "") << (motion ? ",vx,vy" : "") << (spin ? ",omega" : "") << '\n';
      for (std::size_t i = 0; i < s.radius.size(); ++i)
        {
          particles << i << ',' << s.position[i].x() << ',' << s.position[i].y() << ',' << s.radius[i];
          if (mass)
            particles << ',' << s.mass[i];
          if (motion)
            particles << ',' << s.velocity[i].x() << ',' << s.velocity[i].y();
          if (spin)
            particles << ',' << s.spin[i];
          particles << '\n';
        }
      contacts << "# force on i; j = -1 lower, -2 upper, -3 left, -4 right wall\ni,j,fx,fy,px,py\n";
      const int n = int(s.radius.size());
      for (const discrete::ContactForce &c : s.contacts)
        if (c.force != Eigen::Vector2d::Zero())
          contacts << c.i << ',' << (c.j < n ? c.j : n - c.j - 1) << ',' << c.force.x() << ',' << c.force.y() << ','
                   << c.point.x() << ',' << c.point.y() << '\n';
      const ExportBox box = box_of(s);
      walls << "frame," << (box.has_sides() ? "left_x,right_x," : "") << "lower_y,upper_y,upper_travel\n" << stage << ',';
      if (box.has_sides())
        walls << box.left << ',' << box.right << ',';
      walls << box.lower << ',' << box.upper << ',' << s.upper_platen_displacement.x() << '\n';
      const std::string number = std::to_string(stage) + ".csv";
      return {{"particles_" + number, particles.str()}, {"contacts_" + number, contacts.str()}, {"walls_" + number, walls.str()}};
    }

    std::string lammps_script(const discrete::ContactLawOptions &law, const double p, const double rho, const Snapshot &s)
    {
      const ExportBox    box = box_of(s);
      const double       d   = s.mean_diameter;
      const double       kn = 1e4 * p, mass = rho * M_PI * d * d / 4, damping = std::sqrt(kn / mass);
      std::ostringstream out = exact_stream();
      out
        << "# Discs of sample.data between walls at rest, springs kn = 1e4 P (rigid grains have none), dashpots near critical.\n"
        << (law.rolling_friction > 0 ? "# They roll freely here; `rolling sds` of pair_style granular resists rolling.\n" : "")
        << "units si\ndimension 2\nboundary f f p\nnewton off\ncomm_modify vel yes\natom_style sphere\nread_data sample.data\n"
        << "set group all density/disc " << rho << "\n"
        << "variable kn equal " << kn << "\nvariable kt equal 0.8*${kn}\nvariable gn equal " << damping
        << "\nvariable gt equal 0.5*${gn}\n"
        << "pair_style gran/hooke/history ${kn} ${kt} ${gn} ${gt} " << law.friction << " 1\npair_coeff * *\n";
      const auto wall = [&](const char *name, const char *sides, const double mu) {
        out << "region " << name << " block " << sides << " units box side in\n"
            << "fix " << name << " all wall/gran/region hooke/history ${kn} ${kt} ${gn} ${gt} " << mu << " 1 region " << name
            << " contacts\n";
      };
      const std::string lower = exact_text(box.lower), upper = exact_text(box.upper), left = exact_text(box.left),
                        right = exact_text(box.right);
      wall("lower", ("INF INF " + lower + " INF INF INF").c_str(), law.platen_friction);
      wall("upper", ("INF INF INF " + upper + " INF INF").c_str(), law.platen_friction);
      if (box.has_sides())
        {
          wall("left", (left + " INF INF INF INF INF").c_str(), law.wall_friction);
          wall("right", ("INF " + right + " INF INF INF INF").c_str(), law.wall_friction);
        }
      out << "fix move all nve/sphere disc\nfix plane all enforce2d\n"
          << "timestep " << 0.05 * M_PI / damping << "\n"
          << "compute pp all pair/local dist force fx fy p1 p2 p4 cutoff radius\ncompute id all property/local patom1 patom2 "
             "cutoff radius\n"
          << "# frames that `diptych import lammps` reads back\n"
          << "dump g all custom 1000 grains.dump id type x y radius mass vx vy omegaz fx fy\ndump_modify g sort id format float "
             "%.9g\n"
          << "dump c all local 1000 contacts.dump index c_id[1] c_id[2] c_pp[1] c_pp[2] c_pp[3] c_pp[4] c_pp[5] c_pp[6] c_pp[7]\n"
          << "dump_modify c format float %.9g\nthermo 1000\nrun 1000\n";
      return out.str();
    }

    ExportedFiles as_lammps(const Scene &scene, const Snapshot &s)
    {
      const ExportBox    box   = box_of(s);
      std::ostringstream out   = exact_stream();
      const double       room  = 2 * s.mean_diameter;
      double             low_x = HUGE_VAL, high_x = -HUGE_VAL;
      for (const Eigen::Vector2d &x : s.position)
        {
          low_x  = std::min(low_x, x.x());
          high_x = std::max(high_x, x.x());
        }
      out << "LAMMPS data file: discs of a prepared sample; in.sample sets density/disc\n\n"
          << s.radius.size() << " atoms\n1 atom types\n\n"
          << low_x - 5 * room << ' ' << high_x + 5 * room << " xlo xhi\n"
          << box.lower - room << ' ' << box.upper + room << " ylo yhi\n-0.5 0.5 zlo zhi\n\nAtoms # sphere\n\n";
      for (std::size_t i = 0; i < s.radius.size(); ++i)
        out << i + 1 << " 1 " << 2 * s.radius[i] << ' ' << scene.sample.density << ' ' << s.position[i].x() << ' '
            << s.position[i].y() << " 0\n";
      return {{"sample.data", out.str()},
              {"in.sample", lammps_script(scene.discrete.law, scene.loading.pressure, scene.sample.density, s)}};
    }
  } // namespace

  ExportedFiles exported_sample(const std::string                     &format,
                                const Scene                           &scene,
                                const std::vector<discrete::Snapshot> &snapshots,
                                const int                              stage)
  {
    if (format == "dump")
      return {{"grains.dump", grain_dump(snapshots)}, {"contacts.dump", contact_dump(snapshots)}};
    if (format == "lammps")
      return as_lammps(scene, snapshots[std::size_t(stage)]);
    return as_csv(snapshots[std::size_t(stage)], stage);
  }
} // namespace diptych::coupling
