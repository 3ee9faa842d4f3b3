// diptych: the comparison's arrays: comparison.h5 for the report, fields.vtu for ParaView
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <cstdio>
#include <sstream>

#include "coupling/comparison_output.h"
#include "discrete/text_file.h"
#include "discrete/hdf5_file.h"

namespace diptych::coupling
{
  namespace
  {
    void write_increment(discrete::Hdf5Writer &file, const std::string &group, const Increment &increment, const Comparison &c)
    {
      std::vector<double> corners;
      for (const auto &cell : increment.mesh.cell)
        for (const unsigned int node : cell)
          corners.insert(corners.end(), {increment.mesh.node[node].x(), increment.mesh.node[node].y()});
      file.write(group + "/discrete/position", increment.discrete.field.position);
      file.write(group + "/discrete/radius", c.grains.back().radius);
      file.write(group + "/discrete/displacement_increment", increment.discrete.field.increment);
      file.write(group + "/discrete/shear_strain_increment", increment.grain_shear);
      file.write(group + "/nodes/position", increment.continuum.field.position);
      file.write(group + "/nodes/displacement_increment", increment.continuum.field.increment);
      file.write(group + "/cells/corners", corners, {increment.mesh.cell.size(), 4, 2});
      file.write(group + "/cells/discrete_shear_strain_increment", increment.discrete.cell_shear);
      file.write(group + "/cells/continuum_shear_strain_increment", increment.continuum.cell_shear);
      file.attribute(group, "from", increment.from);
      file.attribute(group, "axial_strain", increment.to);
    }

    void write_stage(discrete::Hdf5Writer     &file,
                     const std::string        &group,
                     const StageRecord        &stage,
                     const Comparison         &c,
                     const discrete::Snapshot &grains)
    {
      write_increment(file, group, stage.increment, c);
      file.write(group + "/cells/discrete_stress", stage.discrete.cell_stress);
      file.write(group + "/cells/continuum_stress", stage.continuum.cell_stress);
      file.write(group + "/cells/grain_count", stage.increment.cover.grain_count);
      file.write(group + "/cells/solid_fraction", stage.increment.cover.solid_fraction);
      file.write(group + "/outline/left", grains.outline.left);
      file.write(group + "/outline/right", grains.outline.right);
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
          out << (std::isfinite(double(value)) ? std::to_string(value) : "nan") << '\n';
        out << "</DataArray>\n";
      }

      void tensor(const std::string &name, const std::vector<Eigen::Matrix2d> &values)
      {
        out << "<DataArray type=\"Float64\" NumberOfComponents=\"9\" Name=\"" << name << "\" format=\"ascii\">\n";
        for (const Eigen::Matrix2d &m : values)
          out << m(0, 0) << ' ' << m(0, 1) << " 0 " << m(1, 0) << ' ' << m(1, 1) << " 0 0 0 0\n";
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

    // Standard error of a cell's mean pressure relative to it, from the scatter of the moments of the grains with their
    // centre inside: deviation / (mean sqrt(n)); NaN for fewer than two. Neighbouring grains share force chains, so this is
    // a lower bound.
    std::vector<double> relative_standard_error(const QuadMesh &mesh, const discrete::Snapshot &grains)
    {
      const TriangleSearch search(mesh);
      std::vector<double>  n(mesh.cell.size(), 0.), sum = n, squares = n;
      for (std::size_t i = 0; i < grains.position.size(); ++i)
        if (const TriangleSearch::Place place = search.locate(grains.position[i]); place.inside)
          {
            const double trace = grains.mean_internal_moment[i].trace();
            ++n[place.triangle / 2], sum[place.triangle / 2] += trace, squares[place.triangle / 2] += trace * trace;
          }
      std::vector<double> error(n.size(), NAN);
      for (std::size_t k = 0; k < n.size(); ++k)
        if (n[k] > 1 && sum[k] > 0)
          {
            const double mean = sum[k] / n[k];
            error[k]          = std::sqrt(std::max(0., squares[k] / n[k] - mean * mean) / (n[k] - 1)) / mean;
          }
      return error;
    }
  } // namespace

  void write_comparison_h5(const std::string &directory, const Scene &scene, const Comparison &c)
  {
    discrete::Hdf5Writer file(directory + "/comparison.h5");
    char                 name[32];
    for (std::size_t k = 0; k < c.stages.size(); ++k)
      {
        std::snprintf(name, sizeof name, "stage_%04zu", k + 1);
        write_stage(file, name, c.stages[k], c, c.grains[k + 1]);
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
    const StageRecord           &stage = c.stages.back();
    VtuText                      vtu(stage.increment.mesh);
    std::vector<Eigen::Matrix2d> difference;
    for (std::size_t k = 0; k < stage.discrete.cell_stress.size(); ++k)
      difference.push_back(stage.continuum.cell_stress[k] - stage.discrete.cell_stress[k]);
    vtu.tensor("stress_discrete", stage.discrete.cell_stress);
    vtu.tensor("stress_continuum", stage.continuum.cell_stress);
    vtu.tensor("stress_difference", difference);
    vtu.scalar("shear_strain_increment_discrete", stage.increment.discrete.cell_shear);
    vtu.scalar("shear_strain_increment_continuum", stage.increment.continuum.cell_shear);
    vtu.scalar("grain_count", stage.increment.cover.grain_count);
    vtu.scalar("solid_fraction", stage.increment.cover.solid_fraction);
    vtu.scalar("relative_standard_error", relative_standard_error(stage.increment.mesh, c.grains.back()));
    discrete::write_text(directory + "/fields.vtu", vtu.finish());
  }
} // namespace diptych::coupling
