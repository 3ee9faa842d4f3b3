// diptych: the comparison's arrays: comparison.h5 for the report, fields.vtu for ParaView
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <cstdio>
#include <sstream>

#include "coupling/comparison/comparison_output.h"
#include "discrete/text_file.h"
#include "discrete/hdf5_file.h"

namespace diptych::coupling
{
  namespace
  {
    std::vector<double> corners_of(const QuadMesh &mesh)
    {
      std::vector<double> corners;
      for (const auto &cell : mesh.cell)
        for (const unsigned int node : cell)
          corners.insert(corners.end(), {mesh.node[node].x(), mesh.node[node].y()});
      return corners;
    }

    void write_increment(discrete::Hdf5Writer &file, const std::string &group, const Increment &increment, const Comparison &c)
    {
      file.write(group + "/discrete/position", increment.discrete.field.position);
      file.write(group + "/discrete/radius", c.grains.back().radius);
      file.write(group + "/discrete/displacement_increment", increment.discrete.field.increment);
      file.write(group + "/discrete/shear_strain_increment", increment.grain_shear);
      file.write(group + "/nodes/position", increment.continuum.field.position);
      file.write(group + "/nodes/displacement_increment", increment.continuum.field.increment);
      file.write(group + "/cells/discrete_shear_strain_increment", increment.discrete.cell_shear);
      file.write(group + "/cells/continuum_shear_strain_increment", increment.continuum.cell_shear);
      file.attribute(group, "from", increment.from);
      file.attribute(group, "axial_strain", increment.to);
    }

    // Of the continuum: Cosserat rotation minus half the curl of the displacement increment [radians].
    std::vector<double> relative_rotation(const CellFields &fields)
    {
      std::vector<double> difference;
      for (std::size_t k = 0; k < fields.continuum_spin.size(); ++k)
        difference.push_back(fields.continuum.rotation_increment[k] - fields.continuum_spin[k]);
      return difference;
    }

    void write_fields(discrete::Hdf5Writer &file, const std::string &group, const CellFields &fields)
    {
      const GrainFields     &grains    = fields.grains;
      const ContinuumFields &continuum = fields.continuum;
      file.write(group + "/corners", corners_of(fields.mesh), {fields.mesh.cell.size(), 4, 2});
      file.write(group + "/discrete_stress", grains.stress);
      file.write(group + "/discrete_contact_stress", grains.contact_stress);
      file.write(group + "/discrete_strain_increment", strain_increments(grains.displacement_gradient));
      file.write(group + "/continuum_strain_increment", strain_increments(fields.continuum_gradient));
      file.write(group + "/discrete_displacement_increment", grains.displacement_increment);
      file.write(group + "/discrete_velocity", grains.velocity);
      file.write(group + "/discrete_rotation_increment", grains.rotation_increment);
      file.write(group + "/discrete_spin_increment", grains.spin_increment);
      file.write(group + "/discrete_relative_rotation", grains.relative_rotation);
      file.write(group + "/discrete_couple_stress", grains.couple_stress);
      file.write(group + "/discrete_dissipation", grains.dissipation);
      file.write(group + "/discrete_coordination_number", grains.coordination_number);
      file.write(group + "/discrete_fabric", grains.fabric);
      file.write(group + "/discrete_granular_temperature", grains.granular_temperature);
      file.write(group + "/discrete_standard_error", grains.standard_error);
      file.write(group + "/grain_count", grains.grain_count);
      file.write(group + "/solid_fraction", grains.solid_fraction);
      file.write(group + "/continuum_stress", continuum.stress);
      file.write(group + "/continuum_displacement_increment", continuum.displacement_increment);
      file.write(group + "/continuum_rotation_increment", continuum.rotation_increment);
      file.write(group + "/continuum_spin_increment", fields.continuum_spin);
      file.write(group + "/continuum_relative_rotation", relative_rotation(fields));
      file.write(group + "/continuum_couple_stress", continuum.couple_stress);
      file.write(group + "/continuum_dissipation", continuum.dissipation);
    }

    void write_grains(discrete::Hdf5Writer     &file,
                      const std::string        &group,
                      const discrete::Snapshot &from,
                      const discrete::Snapshot &to)
    {
      std::vector<double> rotation;
      for (std::size_t i = 0; i < to.rotation.size(); ++i)
        rotation.push_back(to.rotation[i] - from.rotation[i]);
      file.write(group + "/discrete/velocity", to.velocity);
      file.write(group + "/discrete/rotation_increment", rotation);
      file.write(group + "/discrete/internal_moment", to.mean_internal_moment);
      file.write(group + "/discrete/rattler", std::vector<int>(to.rattler.begin(), to.rattler.end()));
      std::vector<Eigen::Vector2d> point, force;
      std::vector<int>             i, j;
      for (const discrete::ContactForce &contact : to.window_forces)
        {
          point.push_back(contact.point), force.push_back(contact.force);
          i.push_back(contact.i), j.push_back(contact.j);
        }
      file.write(group + "/contacts/point", point);
      file.write(group + "/contacts/force", force);
      file.write(group + "/contacts/i", i);
      file.write(group + "/contacts/j", j);
    }

    void write_stage(discrete::Hdf5Writer &file, const std::string &group, const Comparison &c, const std::size_t k)
    {
      const StageRecord &stage = c.stages[k];
      write_increment(file, group, stage.increment, c);
      write_fields(file, group + "/cells", stage.fields);
      write_fields(file, group + "/grid", stage.grid);
      file.write(group + "/grid/discrete_shear_strain_increment", stage.grid.grains.shear_strain_increment);
      file.write(group + "/grid/continuum_shear_strain_increment", stage.grid.continuum_shear);
      write_grains(file, group, c.grains[k], c.grains[k + 1]);
      file.write(group + "/outline/left", c.grains[k + 1].outline.left);
      file.write(group + "/outline/right", c.grains[k + 1].outline.right);
    }

    // Ascii VTU of quadrilaterals with cell data.
    class VtuText
    {
    public:
      explicit VtuText(const QuadMesh &mesh)
      {
        out.precision(10);
        out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
            << "<UnstructuredGrid><Piece NumberOfPoints=\"" << mesh.node.size() << "\" NumberOfCells=\"" << mesh.cell.size()
            << "\">\n<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n";
        for (const Eigen::Vector2d &x : mesh.node)
          out << x.x() << ' ' << x.y() << " 0\n";
        out << "</DataArray></Points>\n<Cells><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">\n";
        for (const auto &cell : mesh.cell)
          out << cell[0] << ' ' << cell[1] << ' ' << cell[2] << ' ' << cell[3] << '\n';
        out << "</DataArray><DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">\n";
        for (std::size_t k = 1; k <= mesh.cell.size(); ++k)
          out << 4 * k << '\n';
        out << "</DataArray><DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n";
        for (std::size_t k = 0; k < mesh.cell.size(); ++k)
          out << "9\n";
        out << "</DataArray></Cells>\n<CellData>\n";
      }

      template <class Number> void scalar(const std::string &name, const std::vector<Number> &values)
      {
        out << "<DataArray type=\"Float64\" Name=\"" << name << "\" format=\"ascii\">\n";
        for (const Number value : values)
          (std::isfinite(double(value)) ? out << double(value) : out << "nan") << '\n';
        out << "</DataArray>\n";
      }

      void tensor(const std::string &name, const std::vector<Eigen::Matrix2d> &values)
      {
        out << "<DataArray type=\"Float64\" NumberOfComponents=\"9\" Name=\"" << name << "\" format=\"ascii\">\n";
        for (const Eigen::Matrix2d &m : values)
          out << m(0, 0) << ' ' << m(0, 1) << " 0 " << m(1, 0) << ' ' << m(1, 1) << " 0 0 0 0\n";
        out << "</DataArray>\n";
      }

      void vector(const std::string &name, const std::vector<Eigen::Vector2d> &values)
      {
        out << "<DataArray type=\"Float64\" NumberOfComponents=\"3\" Name=\"" << name << "\" format=\"ascii\">\n";
        for (const Eigen::Vector2d &v : values)
          out << v.x() << ' ' << v.y() << " 0\n";
        out << "</DataArray>\n";
      }

      std::string finish()
      {
        out << "</CellData>\n</Piece></UnstructuredGrid>\n</VTKFile>\n";
        return out.str();
      }

    private:
      std::ostringstream out;
    };

    // Every field of both panels. NaN where a panel has no value.
    std::string vtu_of(const CellFields &fields)
    {
      const GrainFields           &grains    = fields.grains;
      const ContinuumFields       &continuum = fields.continuum;
      std::vector<Eigen::Matrix2d> difference;
      for (std::size_t k = 0; k < grains.stress.size(); ++k)
        difference.push_back(continuum.stress[k] - grains.stress[k]);
      VtuText vtu(fields.mesh);
      vtu.tensor("stress_discrete", grains.stress);
      vtu.tensor("contact_stress_discrete", grains.contact_stress); // without the dynamic part
      vtu.tensor("stress_continuum", continuum.stress);
      vtu.tensor("stress_difference", difference);
      vtu.tensor("strain_increment_discrete", strain_increments(grains.displacement_gradient));
      vtu.tensor("strain_increment_continuum", strain_increments(fields.continuum_gradient));
      vtu.tensor("fabric", grains.fabric);
      vtu.vector("displacement_increment_discrete", grains.displacement_increment);
      vtu.vector("displacement_increment_continuum", continuum.displacement_increment);
      vtu.vector("velocity_discrete", grains.velocity);
      vtu.vector("couple_stress_discrete", grains.couple_stress);
      vtu.vector("couple_stress_continuum", continuum.couple_stress);
      vtu.scalar("shear_strain_increment_discrete", grains.shear_strain_increment);
      vtu.scalar("shear_strain_increment_continuum", fields.continuum_shear);
      vtu.scalar("spin_increment_discrete", grains.spin_increment);
      vtu.scalar("spin_increment_continuum", fields.continuum_spin);
      vtu.scalar("rotation_increment_discrete", grains.rotation_increment);
      vtu.scalar("rotation_increment_continuum", continuum.rotation_increment);
      vtu.scalar("relative_rotation_discrete", grains.relative_rotation);
      vtu.scalar("relative_rotation_continuum", relative_rotation(fields));
      vtu.scalar("dissipation_discrete", grains.dissipation);
      vtu.scalar("dissipation_continuum", continuum.dissipation);
      vtu.scalar("coordination_number", grains.coordination_number);
      vtu.scalar("granular_temperature", grains.granular_temperature);
      vtu.scalar("grain_count", grains.grain_count);
      vtu.scalar("solid_fraction", grains.solid_fraction);
      vtu.scalar("standard_error", grains.standard_error);
      return vtu.finish();
    }
  } // namespace

  void write_comparison_h5(const std::string &directory, const Scene &scene, const Comparison &c)
  {
    discrete::Hdf5Writer file(directory + "/comparison.h5");
    char                 name[32];
    for (std::size_t k = 0; k < c.stages.size(); ++k)
      {
        std::snprintf(name, sizeof name, "stage_%04zu", k + 1);
        write_stage(file, name, c, k);
      }
    for (std::size_t k = 0; k < c.windows.size(); ++k)
      {
        std::snprintf(name, sizeof name, "window_%zu", k);
        write_increment(file, name, c.windows[k], c);
      }
    const discrete::Outline &outline = c.grains.front().outline;
    file.attribute("/", "mean_diameter", scene.sample.mean_diameter);
    file.attribute("/", "pressure", scene.loading.pressure);
    file.attribute("/", "height0", c.grains.front().upper_y - c.grains.front().lower_y);
    file.attribute("/", "width0", c.grains.front().area / (outline.left.back().y() - outline.left.front().y()));
    file.finish();
  }

  void write_fields_vtu(const std::string &directory, const Comparison &c)
  {
    discrete::write_text(directory + "/fields.vtu", vtu_of(c.stages.back().fields));
    discrete::write_text(directory + "/grid.vtu", vtu_of(c.stages.back().grid));
  }
} // namespace diptych::coupling
