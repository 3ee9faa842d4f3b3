// diptych: result files of the continuum panel
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/output.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>

#include "continuum/hdf5_fields.h"
#include "continuum/text_file.h"

namespace diptych::continuum
{
  namespace
  {
    // The fewest digits that give the same bits back.
    template <class Number> std::string text_of(const Number value)
    {
      char       text[32];
      const auto end = std::to_chars(text, text + sizeof text, value).ptr;
      return std::string(text, end);
    }

    void write_item(std::ostream &out, const std::string &path, const std::string &extents, const char *number)
    {
      out << "<DataItem Dimensions=\"" << extents << "\" " << number << " Format=\"HDF\">continuum.h5:/" << path << "</DataItem>";
    }

    void write_values(std::ostream &out, const std::string &stage, const StageSummary &summary, const Field &field)
    {
      std::string dimensions;
      for (const std::size_t extent : extents(field, of_nodes(field) ? summary.n_nodes : summary.n_cells))
        dimensions += (dimensions.empty() ? "" : " ") + std::to_string(extent);
      write_item(out, stage + '/' + path_of(field), dimensions, "NumberType=\"Float\" Precision=\"8\"");
    }

    void write_xdmf_field(std::ostream &out, const std::string &stage, const StageSummary &summary, const Field &field)
    {
      const std::map<unsigned int, const char *> type{{1, "Scalar"}, {3, "Vector"}, {9, "Tensor"}};
      out << "<Attribute Name=\"" << field.name << "\" AttributeType=\"" << type.at(n_components(field)) << "\" Center=\""
          << (of_nodes(field) ? "Node" : "Cell") << "\">";
      write_values(out, stage, summary, field);
      out << "</Attribute>\n";
    }

    void write_xdmf_stage(std::ostream &out, const std::string &stage, const StageSummary &summary)
    {
      const std::string cells = std::to_string(summary.n_cells);
      out << "<Grid Name=\"" << stage << "\" GridType=\"Uniform\">\n<Time Value=\"" << text_of(summary.axial_strain) << "\"/>\n"
          << "<Topology TopologyType=\"Quadrilateral_9\" NumberOfElements=\"" << cells << "\">";
      write_item(out, stage + "/cells/nodes", cells + " 9", "NumberType=\"UInt\" Precision=\"4\"");
      out << "</Topology>\n<Geometry GeometryType=\"XYZ\">";
      write_values(out, stage, summary, position_field);
      out << "</Geometry>\n";
      for (const Field &field : fields)
        if (is_carried(field, summary.has_rotation))
          write_xdmf_field(out, stage, summary, field);
      out << "</Grid>\n";
    }

    void write_xdmf(const std::string &name, const std::vector<StageSummary> &stages)
    {
      write_text_file(name, [&](std::ostream &out) {
        out << "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n<Grid Name=\"continuum\" GridType=\"Collection\" "
               "CollectionType=\"Temporal\">\n";
        for (std::size_t i = 0; i < stages.size(); ++i)
          write_xdmf_stage(out, stage_name(i), stages[i]);
        out << "</Grid>\n</Domain>\n</Xdmf>\n";
      });
    }

    void write_pvd(const std::string &name, const std::vector<StageSummary> &stages)
    {
      write_text_file(name, [&](std::ostream &out) {
        out
          << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n<Collection>\n";
        for (std::size_t i = 0; i < stages.size(); ++i)
          out << "<DataSet timestep=\"" << text_of(stages[i].axial_strain) << "\" part=\"0\" file=\"continuum/" << stage_name(i)
              << ".vtu\"/>\n";
        out << "</Collection>\n</VTKFile>\n";
      });
    }

    // Calls visitor(column, value) for all columns of the .csv in their order.
    template <class AnyRow, class Visitor> void visit_columns(AnyRow &r, Visitor &&visitor)
    {
      visitor("step", r.step);
      visitor("axial_strain", r.axial_strain);
      visitor("stress_ratio", r.stress_ratio);
      visitor("volumetric_strain", r.volumetric_strain);
      visitor("sxx", r.mean_stress(0, 0));
      visitor("sxy", r.mean_stress(0, 1));
      visitor("syy", r.mean_stress(1, 1));
      visitor("szz", r.mean_stress(2, 2));
      visitor("lower_fx", r.lower_platen_force.x());
      visitor("lower_fy", r.lower_platen_force.y());
      visitor("upper_fx", r.upper_platen_force.x());
      visitor("upper_fy", r.upper_platen_force.y());
      visitor("newton_iterations", r.newton_iterations);
      visitor("linear_iterations", r.linear_iterations);
      visitor("factorisations", r.factorisations);
      visitor("cut_backs", r.cut_backs);
      visitor("plastic_share", r.plastic_share);
      visitor("share_zz_not_intermediate", r.share_zz_not_intermediate);
      visitor("max_equivalent_plastic_strain", r.max_equivalent_plastic_strain);
      visitor("assembly_cpu_s", r.assembly_cpu_s);
      visitor("solve_cpu_s", r.solve_cpu_s);
      visitor("syx", r.mean_stress(1, 0));
      visitor("n_cells", r.n_cells);
      visitor("n_unknowns", r.n_unknowns);
      visitor("unreliable_share", r.unreliable_share);
      visitor("viscous_share", r.viscous_share);
      visitor("dissipation", r.dissipation);
      visitor("least_acoustic_determinant", r.least_acoustic_determinant);
      visitor("localisation_angle", r.localisation_angle);
      visitor("point_cpu_s", r.point_cpu_s);
      visitor("geometry_cpu_s", r.geometry_cpu_s);
    }

    std::vector<std::string> split(const std::string &line)
    {
      std::vector<std::string> entries;
      std::size_t              begin = 0;
      for (std::size_t end; (end = line.find(',', begin)) != std::string::npos; begin = end + 1)
        entries.push_back(line.substr(begin, end - begin));
      entries.push_back(line.substr(begin));
      return entries;
    }

    // Which entry of a line belongs to a column. Throws when one is missing.
    std::map<std::string, std::size_t> find_columns(const std::string &header)
    {
      std::map<std::string, std::size_t> place;
      const std::vector<std::string>     names = split(header);
      for (std::size_t k = 0; k < names.size(); ++k)
        place[names[k]] = k;
      HistoryRow row;
      visit_columns(row, [&](const char *name, auto &) {
        if (place.count(name) == 0)
          throw std::runtime_error("no column " + std::string(name) + " (a file of another version?)");
      });
      return place;
    }

    template <class Number> Number number_from(const std::string &text)
    {
      Number     value{};
      const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
      if (text.empty() || end.ec != std::errc() || end.ptr != text.data() + text.size())
        throw std::runtime_error("'" + text + "' is no number");
      return value;
    }

    HistoryRow row_from(const std::string &line, const std::map<std::string, std::size_t> &place)
    {
      const std::vector<std::string> entries = split(line);
      if (entries.size() != place.size())
        throw std::runtime_error(std::to_string(entries.size()) + " entries for " + std::to_string(place.size()) + " columns");
      HistoryRow row;
      visit_columns(row, [&](const char *name, auto &value) {
        try
          {
            value = number_from<std::remove_reference_t<decltype(value)>>(entries[place.at(name)]);
          }
        catch (const std::exception &error)
          {
            throw std::runtime_error("column " + std::string(name) + ": " + error.what());
          }
      });
      return row;
    }

    bool reached(const double strain, const double limit)
    {
      return strain <= limit + 1e-12 * std::abs(limit);
    }

    // Whether a snapshot was made at one of the stages; without a list, any was.
    bool is_stage(const double strain, const std::vector<double> &stages)
    {
      return stages.empty() || std::any_of(stages.begin(), stages.end(),
                                           [&](const double stage) { return reached(strain, stage) && reached(stage, strain); });
    }

    void make_folder(const std::string &folder)
    {
      std::error_code failure;
      std::filesystem::create_directories(folder + "/continuum", failure);
      if (failure)
        throw std::runtime_error("cannot write to " + folder + ": " + failure.message());
    }
  } // namespace

  void write_history(const std::string &csv_file, const std::vector<HistoryRow> &rows)
  {
    write_text_file(csv_file, [&](std::ostream &out) {
      std::string      line;
      const HistoryRow any;
      visit_columns(any, [&](const char *name, const auto &) { line += std::string(line.empty() ? "" : ",") + name; });
      out << line << '\n';
      for (const HistoryRow &row : rows)
        {
          line.clear();
          visit_columns(row, [&](const char *, const auto &value) { line += (line.empty() ? "" : ",") + text_of(value); });
          out << line << '\n';
        }
    });
  }

  std::vector<HistoryRow> read_history(const std::string &csv_file)
  {
    std::ifstream file(csv_file);
    std::string   line;
    if (!std::getline(file, line))
      throw std::runtime_error(csv_file + ": missing or empty");
    std::vector<HistoryRow> rows;
    int                     number = 1;
    try
      {
        const auto place = find_columns(line);
        for (number = 2; std::getline(file, line); ++number)
          rows.push_back(row_from(line, place));
      }
    catch (const std::exception &error)
      {
        throw std::runtime_error(csv_file + ", line " + std::to_string(number) + ": " + error.what());
      }
    return rows;
  }

  ResultFiles::ResultFiles(const std::string &folder)
      : folder(folder)
  {
    make_folder(folder);
  }

  ResultFiles::ResultFiles(const std::string &folder, const double resume_from, const std::vector<double> &only)
      : folder(folder)
  {
    make_folder(folder);
    for (const HistoryRow &row : read_history(folder + "/continuum.csv"))
      if (reached(row.axial_strain, resume_from))
        rows.push_back(row);
    take_over_stages(resume_from, only);
    finish();
  }

  // The .h5 is cut first and whole; all else is made from it again, so that a kill in between does no harm.
  void ResultFiles::take_over_stages(const double resume_from, const std::vector<double> &only)
  {
    const std::string h5 = folder + "/continuum.h5", vtu = folder + "/continuum/";
    if (!std::filesystem::exists(h5))
      return; // interrupted before the first stage
    const std::vector<StageSummary> found = read_stage_summaries(h5);
    std::vector<unsigned int>       kept;
    for (unsigned int stage = 0; stage < found.size(); ++stage)
      if (reached(found[stage].axial_strain, resume_from) && is_stage(found[stage].axial_strain, only))
        {
          kept.push_back(stage);
          stages.push_back(found[stage]);
        }
    if (kept.size() < found.size())
      keep_stages(h5, kept);
    std::size_t stage = 0;
    for (; stage < kept.size(); ++stage)
      write_vtu(vtu + stage_name(stage) + ".vtu", read_snapshot(h5, stage));
    while (std::filesystem::remove(vtu + stage_name(stage) + ".vtu"))
      ++stage;
    list_stages();
  }

  void ResultFiles::list_stages() const
  {
    write_xdmf(folder + "/continuum.xdmf", stages);
    write_pvd(folder + "/continuum.pvd", stages);
  }

  void ResultFiles::add(const Snapshot &snapshot)
  {
    append_to_hdf5(folder + "/continuum.h5", snapshot, stages.size());
    write_vtu(folder + "/continuum/" + stage_name(stages.size()) + ".vtu", snapshot);
    stages.push_back({snapshot.axial_strain, snapshot.cells.size(), snapshot.position.size(), !snapshot.rotation.empty()});
    list_stages();
  }

  void ResultFiles::add(const HistoryRow &row)
  {
    rows.push_back(row);
    finish();
  }

  void ResultFiles::finish() const
  {
    write_history(folder + "/continuum.csv", rows);
  }
} // namespace diptych::continuum
