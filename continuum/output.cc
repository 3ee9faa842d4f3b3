// diptych: result files of the continuum panel
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/output.h"

#include <cstdio>
#include <filesystem>

#include "continuum/text_file.h"

namespace diptych::continuum
{
  namespace
  {
    std::string stage_name(const std::size_t stage)
    {
      char name[32];
      std::snprintf(name, sizeof name, "stage_%04zu", stage);
      return name;
    }

    struct StageEntry
    {
      std::string name;
      double      axial_strain;
      std::size_t n_cells, n_nodes;
    };

    void write_item(std::ostream &out, const std::string &path, const std::string &extents, const char *number)
    {
      out << "<DataItem Dimensions=\"" << extents << "\" " << number << " Format=\"HDF\">continuum.h5:/" << path << "</DataItem>";
    }

    void write_attribute(std::ostream      &out,
                         const StageEntry  &stage,
                         const std::string &path,
                         const char        *type,
                         const char        *center,
                         const std::string &extents)
    {
      out << "<Attribute Name=\"" << path.substr(path.find('/') + 1) << "\" AttributeType=\"" << type << "\" Center=\"" << center
          << "\">";
      write_item(out, stage.name + '/' + path, extents, "NumberType=\"Float\" Precision=\"8\"");
      out << "</Attribute>\n";
    }

    void write_xdmf_stage(std::ostream &out, const StageEntry &stage)
    {
      const std::string cells = std::to_string(stage.n_cells), nodes = std::to_string(stage.n_nodes);
      out << "<Grid Name=\"" << stage.name << "\" GridType=\"Uniform\">\n<Time Value=\"" << stage.axial_strain << "\"/>\n"
          << "<Topology TopologyType=\"Quadrilateral_9\" NumberOfElements=\"" << cells << "\">";
      write_item(out, stage.name + "/cells/nodes", cells + " 9", "NumberType=\"UInt\" Precision=\"4\"");
      out << "</Topology>\n<Geometry GeometryType=\"XYZ\">";
      write_item(out, stage.name + "/nodes/position", nodes + " 3", "NumberType=\"Float\" Precision=\"8\"");
      out << "</Geometry>\n";
      write_attribute(out, stage, "nodes/displacement", "Vector", "Node", nodes + " 3");
      write_attribute(out, stage, "cells/stress", "Tensor", "Cell", cells + " 3 3");
      write_attribute(out, stage, "cells/strain", "Tensor", "Cell", cells + " 3 3");
      write_attribute(out, stage, "cells/equivalent_plastic_strain", "Scalar", "Cell", cells);
      write_attribute(out, stage, "cells/area", "Scalar", "Cell", cells);
      out << "</Grid>\n";
    }

    void write_xdmf(const std::string &name, const std::vector<StageEntry> &stages)
    {
      write_text_file(name, [&](std::ostream &out) {
        out << "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n<Grid Name=\"continuum\" GridType=\"Collection\" "
               "CollectionType=\"Temporal\">\n";
        for (const auto &stage : stages)
          write_xdmf_stage(out, stage);
        out << "</Grid>\n</Domain>\n</Xdmf>\n";
      });
    }

    void write_pvd(const std::string &name, const std::vector<StageEntry> &stages)
    {
      write_text_file(name, [&](std::ostream &out) {
        out
          << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n<Collection>\n";
        for (const auto &stage : stages)
          out << "<DataSet timestep=\"" << stage.axial_strain << "\" part=\"0\" file=\"continuum/" << stage.name << ".vtu\"/>\n";
        out << "</Collection>\n</VTKFile>\n";
      });
    }
  } // namespace

  void write_history(const std::string &csv_file, const std::vector<HistoryRow> &rows)
  {
    write_text_file(csv_file, [&](std::ostream &out) {
      out << "step,axial_strain,stress_ratio,volumetric_strain,sxx,sxy,syy,szz,lower_fx,lower_fy,upper_fx,upper_fy,newton_"
             "iterations,"
             "linear_iterations,factorisations,cut_backs,plastic_share,share_zz_not_intermediate,max_equivalent_plastic_strain,"
             "assembly_cpu_s,solve_cpu_s\n";
      for (const auto &r : rows)
        out << r.step << ',' << r.axial_strain << ',' << r.stress_ratio << ',' << r.volumetric_strain << ','
            << r.mean_stress(0, 0) << ',' << r.mean_stress(0, 1) << ',' << r.mean_stress(1, 1) << ',' << r.mean_stress(2, 2)
            << ',' << r.lower_platen_force.x() << ',' << r.lower_platen_force.y() << ',' << r.upper_platen_force.x() << ','
            << r.upper_platen_force.y() << ',' << r.newton_iterations << ',' << r.linear_iterations << ',' << r.factorisations
            << ',' << r.cut_backs << ',' << r.plastic_share << ',' << r.share_zz_not_intermediate << ','
            << r.max_equivalent_plastic_strain << ',' << r.assembly_cpu_s << ',' << r.solve_cpu_s << '\n';
    });
  }

  ResultFiles::ResultFiles(const std::string &folder)
      : folder(folder)
  {
    std::error_code failure;
    std::filesystem::create_directories(folder + "/continuum", failure);
    if (failure)
      throw std::runtime_error("cannot write to " + folder + ": " + failure.message());
  }

  void ResultFiles::add(const Snapshot &snapshot)
  {
    const std::size_t stage = axial_strains.size();
    append_to_hdf5(folder + "/continuum.h5", snapshot, stage);
    write_vtu(folder + "/continuum/" + stage_name(stage) + ".vtu", snapshot);
    axial_strains.push_back(snapshot.axial_strain);
    n_cells.push_back(snapshot.cells.size());
    n_nodes.push_back(snapshot.position.size());

    std::vector<StageEntry> stages;
    for (std::size_t i = 0; i <= stage; ++i)
      stages.push_back({stage_name(i), axial_strains[i], n_cells[i], n_nodes[i]});
    write_xdmf(folder + "/continuum.xdmf", stages);
    write_pvd(folder + "/continuum.pvd", stages);
    finish();
  }

  void ResultFiles::add(const HistoryRow &row)
  {
    rows.push_back(row);
  }

  void ResultFiles::finish() const
  {
    write_history(folder + "/continuum.csv", rows);
  }
} // namespace diptych::continuum
