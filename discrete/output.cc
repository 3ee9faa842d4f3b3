// diptych: result files of the discrete panel
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/output.h"

#include <cmath>
#include <cstdio>
#include <sstream>
#include <stdexcept>

#include "discrete/hdf5_file.h"
#include "discrete/text_file.h"

namespace diptych::discrete
{
  namespace
  {
    std::string group_name(const std::size_t stage)
    {
      char name[32];
      std::snprintf(name, sizeof name, "stage_%04zu", stage);
      return name;
    }

    template <class Byte> std::vector<int> integers(const std::vector<Byte> &values)
    {
      std::vector<int> result;
      for (const Byte value : values)
        result.push_back(int(value));
      return result;
    }

    void write_forces(Hdf5Writer &file, const std::string &group, const std::vector<ContactForce> &forces)
    {
      std::vector<int>             body;
      std::vector<Eigen::Vector2d> point, normal, force;
      std::vector<double>          shift; // x of the image of the second body minus x of that body
      for (const ContactForce &c : forces)
        {
          body.insert(body.end(), {c.i, c.j});
          point.push_back(c.point), normal.push_back(c.normal), force.push_back(c.force), shift.push_back(c.shift);
        }
      file.write(group + "/body", body, {forces.size(), 2});
      file.write(group + "/point", point, 3);
      file.write(group + "/normal", normal, 3);
      file.write(group + "/force", force, 3);
      file.write(group + "/image_shift", shift);
    }

    std::vector<ContactForce> read_forces(const Hdf5Reader &file, const std::string &group)
    {
      const std::vector<int> body  = file.read_int(group + "/body");
      const auto             point = file.read_vectors(group + "/point"), normal = file.read_vectors(group + "/normal"),
                 force                = file.read_vectors(group + "/force");
      const std::vector<double> shift = file.read(group + "/image_shift");
      std::vector<ContactForce> forces(point.size());
      for (std::size_t k = 0; k < forces.size(); ++k)
        forces[k] = {body[2 * k], body[2 * k + 1], point[k], normal[k], force[k], shift[k]};
      return forces;
    }

    void write_impulses(Hdf5Writer &file, const std::string &group, const Snapshot &s)
    {
      std::vector<double> impulse;
      for (const ContactForce &c : s.contacts)
        {
          const Eigen::Vector2d tangent(-c.normal.y(), c.normal.x());
          impulse.insert(impulse.end(), {s.step * c.force.dot(c.normal), s.step * c.force.dot(tangent)});
        }
      file.write(group + "/impulse", impulse, {s.contacts.size(), 2});
    }

    void write_attributes(Hdf5Writer &file, const std::string &group, const Snapshot &s)
    {
      file.attribute(group, "axial_strain", s.axial_strain);
      file.attribute(group, "shear_strain", s.shear_strain);
      file.attribute(group, "stress_error", s.stress_error);
      file.attribute(group, "stress_change", s.stress_change);
      file.attribute(group, "error_over_residual", s.error_over_residual);
      file.attribute(group, "left_x", s.left_x);
      file.attribute(group, "right_x", s.right_x);
      file.attribute(group, "cell_width", s.cell_width);
      file.attribute(group, "time", s.time);
      file.attribute(group, "step", s.step);
      file.attribute(group, "residual", s.residual);
      file.attribute(group, "mean_diameter", s.mean_diameter);
      file.attribute(group, "window_time", s.window_time);
      file.attribute(group, "lower_y", s.lower_y);
      file.attribute(group, "upper_y", s.upper_y);
      file.attribute(group, "area", s.area);
      file.attribute(group, "upper_platen_displacement_x", s.upper_platen_displacement.x());
      file.attribute(group, "upper_platen_displacement_y", s.upper_platen_displacement.y());
      file.attribute(group, "lower_platen_force_x", s.lower_platen_force.x());
      file.attribute(group, "lower_platen_force_y", s.lower_platen_force.y());
      file.attribute(group, "upper_platen_force_x", s.upper_platen_force.x());
      file.attribute(group, "upper_platen_force_y", s.upper_platen_force.y());
    }

    void write_stage(Hdf5Writer &file, const std::string &group, const Snapshot &s)
    {
      const std::string grains = group + "/grains", contacts = group + "/contacts", window = group + "/window";
      file.write(grains + "/position", s.position, 3);
      file.write(grains + "/displacement", s.displacement, 3);
      file.write(grains + "/velocity", s.velocity, 3);
      file.write(grains + "/rotation", s.rotation);
      file.write(grains + "/spin", s.spin);
      file.write(grains + "/radius", s.radius);
      file.write(grains + "/mass", s.mass);
      file.write(grains + "/internal_moment", s.internal_moment, 3);
      file.write(grains + "/mean_internal_moment", s.mean_internal_moment, 3);
      file.write(grains + "/mean_spin_term", s.mean_spin_term);
      file.write(grains + "/rattler", integers(s.rattler));
      file.write(grains + "/fixed", integers(s.fixed));
      file.write(grains + "/applied_force", s.applied_force, 3);
      write_forces(file, contacts, s.contacts);
      write_impulses(file, contacts, s);
      file.write(contacts + "/gap", s.gap);
      file.write(contacts + "/status", integers(s.status));
      write_forces(file, window, s.window_forces);
      file.write(window + "/dissipation", s.window_dissipation);
      file.write(window + "/impact_dissipation", s.window_impact_dissipation);
      file.write(group + "/outline/left", s.outline.left);
      file.write(group + "/outline/right", s.outline.right);
      write_attributes(file, group, s);
    }

    // One array of the HDF5 file as an XDMF attribute on the points of the grid.
    std::string xdmf_attribute(const std::string &file,
                               const std::string &path,
                               const std::string &name,
                               const std::string &type,
                               const std::size_t  n,
                               const std::size_t  components,
                               const bool         integer)
    {
      std::ostringstream out;
      out << "        <Attribute Name=\"" << name << "\" AttributeType=\"" << type
          << "\" Center=\"Node\"><DataItem Format=\"HDF\" "
          << (integer ? "NumberType=\"Int\"" : "NumberType=\"Float\" Precision=\"8\"") << " Dimensions=\"" << n;
      if (components == 9)
        out << " 3 3";
      else if (components > 1)
        out << ' ' << components;
      out << "\">" << file << ":/" << path << "/" << name << "</DataItem></Attribute>\n";
      return out.str();
    }

    std::string xdmf_points(const std::string &file,
                            const std::string &path,
                            const std::string &points,
                            const std::size_t  n,
                            const double       time)
    {
      std::ostringstream out;
      out << "      <Grid Name=\"" << path << "\" GridType=\"Uniform\">\n        <Time Value=\"" << time
          << "\"/>\n        <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"" << n
          << "\"/>\n        <Geometry GeometryType=\"XYZ\"><DataItem Format=\"HDF\" NumberType=\"Float\" Precision=\"8\" "
             "Dimensions=\""
          << n << " 3\">" << file << ":/" << path << "/" << points << "</DataItem></Geometry>\n";
      return out.str();
    }

    std::string xdmf_collection(const std::string &name, const std::string &grids)
    {
      return "    <Grid Name=\"" + name + "\" GridType=\"Collection\" CollectionType=\"Temporal\">\n" + grids + "    </Grid>\n";
    }

    std::string xdmf_window(const std::string &file, const std::string &group, const Snapshot &s)
    {
      const std::size_t n    = s.window_forces.size();
      std::string       grid = xdmf_points(file, group, "point", n, s.axial_strain);
      grid += xdmf_attribute(file, group, "normal", "Vector", n, 3, false);
      grid += xdmf_attribute(file, group, "force", "Vector", n, 3, false);
      if (s.window_dissipation.size() == n)
        grid += xdmf_attribute(file, group, "dissipation", "Scalar", n, 1, false);
      if (s.window_impact_dissipation.size() == n)
        grid += xdmf_attribute(file, group, "impact_dissipation", "Scalar", n, 1, false);
      return grid + "      </Grid>\n";
    }

    std::string xdmf(const std::string &file, const std::vector<Snapshot> &snapshots)
    {
      std::string grains, contacts, windows;
      for (std::size_t k = 0; k < snapshots.size(); ++k)
        {
          const Snapshot   &s = snapshots[k];
          const std::size_t n = s.position.size(), m = s.contacts.size();
          const std::string g = group_name(k) + "/grains", c = group_name(k) + "/contacts";
          windows += xdmf_window(file, group_name(k) + "/window", s);
          grains += xdmf_points(file, g, "position", n, s.axial_strain);
          for (const char *name : {"displacement", "velocity", "applied_force"})
            grains += xdmf_attribute(file, g, name, "Vector", n, 3, false);
          for (const char *name : {"radius", "mass", "spin", "rotation"})
            grains += xdmf_attribute(file, g, name, "Scalar", n, 1, false);
          for (const char *name : {"internal_moment", "mean_internal_moment"})
            grains += xdmf_attribute(file, g, name, "Tensor", n, 9, false);
          grains += xdmf_attribute(file, g, "rattler", "Scalar", n, 1, true);
          grains += xdmf_attribute(file, g, "fixed", "Scalar", n, 1, true) + "      </Grid>\n";
          contacts += xdmf_points(file, c, "point", m, s.axial_strain);
          contacts += xdmf_attribute(file, c, "normal", "Vector", m, 3, false);
          contacts += xdmf_attribute(file, c, "force", "Vector", m, 3, false);
          contacts += xdmf_attribute(file, c, "gap", "Scalar", m, 1, false);
          contacts += xdmf_attribute(file, c, "status", "Scalar", m, 1, true) + "      </Grid>\n";
        }
      return "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n" + xdmf_collection("grains", grains) +
             xdmf_collection("contacts", contacts) + xdmf_collection("window", windows) + "  </Domain>\n</Xdmf>\n";
    }
  } // namespace

  void write_snapshots(const std::string &path, const std::vector<Snapshot> &snapshots)
  {
    Hdf5Writer file(path + ".h5");
    for (std::size_t k = 0; k < snapshots.size(); ++k)
      write_stage(file, group_name(k), snapshots[k]);
    file.finish();
    write_text(path + ".xdmf", xdmf(path.substr(path.find_last_of('/') + 1) + ".h5", snapshots));
  }

  std::vector<Snapshot> read_snapshots(const std::string &h5_path)
  {
    const Hdf5Reader      file(h5_path);
    std::vector<Snapshot> snapshots;
    for (std::size_t k = 0; file.has(group_name(k)); ++k)
      {
        const std::string group = group_name(k), grains = group + "/grains";
        const auto        number = [&](const char *name) { return file.attribute(group, name); };
        Snapshot          s;
        s.axial_strain              = number("axial_strain");
        s.shear_strain              = number("shear_strain");
        s.stress_error              = number("stress_error");
        s.stress_change             = number("stress_change");
        s.error_over_residual       = number("error_over_residual");
        s.left_x                    = number("left_x");
        s.right_x                   = number("right_x");
        s.cell_width                = number("cell_width");
        s.time                      = number("time");
        s.step                      = number("step");
        s.residual                  = number("residual");
        s.mean_diameter             = number("mean_diameter");
        s.window_time               = number("window_time");
        s.lower_y                   = number("lower_y");
        s.upper_y                   = number("upper_y");
        s.area                      = number("area");
        s.upper_platen_displacement = {number("upper_platen_displacement_x"), number("upper_platen_displacement_y")};
        s.lower_platen_force        = {number("lower_platen_force_x"), number("lower_platen_force_y")};
        s.upper_platen_force        = {number("upper_platen_force_x"), number("upper_platen_force_y")};
        s.position                  = file.read_vectors(grains + "/position");
        s.displacement              = file.read_vectors(grains + "/displacement");
        s.velocity                  = file.read_vectors(grains + "/velocity");
        s.rotation                  = file.read(grains + "/rotation");
        s.spin                      = file.read(grains + "/spin");
        s.radius                    = file.read(grains + "/radius");
        s.mass                      = file.read(grains + "/mass");
        s.internal_moment           = file.read_tensors(grains + "/internal_moment");
        s.mean_internal_moment      = file.read_tensors(grains + "/mean_internal_moment");
        s.mean_spin_term            = file.read(grains + "/mean_spin_term");
        s.applied_force             = file.read_vectors(grains + "/applied_force");
        for (const int r : file.read_int(grains + "/rattler"))
          s.rattler.push_back(std::uint8_t(r));
        for (const int f : file.read_int(grains + "/fixed"))
          s.fixed.push_back(std::uint8_t(f));
        s.contacts = read_forces(file, group + "/contacts");
        s.gap      = file.read(group + "/contacts/gap");
        for (const int status : file.read_int(group + "/contacts/status"))
          s.status.push_back(ContactStatus(status));
        s.window_forces = read_forces(file, group + "/window");
        if (const std::string dissipation = group + "/window/dissipation"; file.has(dissipation)) // else of an earlier version
          s.window_dissipation = file.read(dissipation);
        if (const std::string impact = group + "/window/impact_dissipation"; file.has(impact))
          s.window_impact_dissipation = file.read(impact);
        s.outline = {file.read_vectors(group + "/outline/left"), file.read_vectors(group + "/outline/right")};
        snapshots.push_back(std::move(s));
      }
    if (snapshots.empty())
      throw std::runtime_error(h5_path + " holds no stage");
    return snapshots;
  }
} // namespace diptych::discrete
