// diptych: computes the arrays of a comparison: comparison.h5 for the report, fields.pvd for ParaView
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/comparison/comparison_arrays.h"

#include "coupling/cells/principal_axes.h"
#include "coupling/comparison/comparison_output.h"
#include "discrete/files/field_arrays.h"
#include "discrete/files/hdf5_file.h"
#include "coupling/store/file_names.h"
#include "discrete/files/staged_file.h"
#include "discrete/files/vtu_file.h"

namespace diptych::coupling
{
  namespace
  {
    double mean_of(const Eigen::Matrix2d &m)
    {
      return 0.5 * m.trace();
    }

    // t of the symmetric part: half the difference of the principal stresses.
    double deviator_of(const Eigen::Matrix2d &m)
    {
      return 0.5 * principal_difference(m);
    }

    template <class Of> std::vector<double> of_each(const std::vector<Eigen::Matrix2d> &stress, Of &&of)
    {
      std::vector<double> values;
      values.reserve(stress.size());
      for (const Eigen::Matrix2d &m : stress)
        values.push_back(of(m));
      return values;
    }

    std::vector<Eigen::Vector2d> moved_cells(const continuum::Snapshot &from, const continuum::Snapshot &to)
    {
      return continuum_fields(from, to).displacement_increment;
    }

    void write_profiles(discrete::Hdf5Writer &file, const std::string &group, const Increment &increment)
    {
      for (const auto &[name, panel] :
           {std::pair{"/profile/discrete", &increment.discrete}, std::pair{"/profile/continuum", &increment.continuum}})
        list_profile_arrays(panel->profile.value_or(BandProfile()), IntoGroup{file, group + name});
    }

    void write_stage(discrete::Hdf5Writer &file,
                     const std::string    &group,
                     const StageRecord    &stage,
                     const Results        &results,
                     std::size_t           k)
    {
      const auto &snapshots = results.discrete.snapshots;
      list_increment_arrays(stage.increment, snapshots[k], IntoGroup{file, group});
      list_grain_arrays(stage.increment, snapshots[k - 1], snapshots[k], IntoGroup{file, group});
      for (const auto &[name, fields] : {std::pair{"/cells", &stage.fields}, std::pair{"/grid", &stage.grid}})
        {
          list_mesh_arrays(fields->mesh, IntoGroup{file, group + name});
          list_cell_arrays(*fields, motion_units(stage.increment), IntoGroup{file, group + name});
        }
      list_increment_attributes(stage.increment, IntoGroup{file, group});
      write_profiles(file, group, stage.increment);
    }

    void write_window(discrete::Hdf5Writer &file, const std::string &group, const Increment &window, const Results &results)
    {
      const std::size_t from = snapshot_at(results.discrete.snapshots, window.from).value();
      const std::size_t to   = snapshot_at(results.discrete.snapshots, window.to).value();
      list_increment_arrays(window, results.discrete.snapshots[to], IntoGroup{file, group});
      list_mesh_arrays(window.mesh, IntoGroup{file, group + "/cells"});
      list_window_cell_arrays(window, moved_cells(results.continuum.snapshots[from], results.continuum.snapshots[to]),
                              IntoGroup{file, group + "/cells"});
      list_increment_attributes(window, IntoGroup{file, group});
      write_profiles(file, group, window);
    }

    discrete::VtuGrid vtu_of(const CellFields &fields, const MotionUnits &unit)
    {
      discrete::VtuGrid grid{fields.mesh.node, {}, discrete::VtkCell::quadrilateral, {}};
      for (const auto &cell : fields.mesh.cell)
        grid.cells.insert(grid.cells.end(), cell.begin(), cell.end());
      list_cell_arrays(fields, unit, [&](const ArrayEntry &entry, const auto &values) {
        using Value = typename std::decay_t<decltype(values)>::value_type;
        grid.fields.push_back({entry.key, unsigned(discrete::n_components<Value>), discrete::flat(values)});
      });
      return grid;
    }
  } // namespace

  namespace arrays
  {
    std::vector<double> mean_stress(const std::vector<Eigen::Matrix2d> &stress)
    {
      return of_each(stress, mean_of);
    }

    std::vector<double> stress_ratio(const std::vector<Eigen::Matrix2d> &stress)
    {
      return of_each(stress, [](const Eigen::Matrix2d &m) { return mean_of(m) > 0 ? deviator_of(m) / mean_of(m) : NAN; });
    }

    std::vector<double> major_stress(const std::vector<Eigen::Matrix2d> &stress)
    {
      return of_each(stress, [](const Eigen::Matrix2d &m) { return mean_of(m) + deviator_of(m); });
    }

    std::vector<double> minor_stress(const std::vector<Eigen::Matrix2d> &stress)
    {
      return of_each(stress, [](const Eigen::Matrix2d &m) { return mean_of(m) - deviator_of(m); });
    }

    std::vector<double> stress_direction(const std::vector<Eigen::Matrix2d> &stress)
    {
      return of_each(stress, [](const Eigen::Matrix2d &m) { return 0.5 * std::atan2(m(0, 1) + m(1, 0), m(0, 0) - m(1, 1)); });
    }

    std::vector<std::vector<double>> rows_of(const ProfileCurve &curve)
    {
      std::vector<std::vector<double>> rows;
      for (std::size_t k = 0; k < curve.value.size(); ++k)
        rows.push_back({curve.value[k], curve.low[k], curve.high[k]});
      return rows;
    }

    std::vector<double> sizes_over(const std::vector<Eigen::Vector2d> &vectors, const double unit)
    {
      std::vector<double> sizes;
      for (const Eigen::Vector2d &v : vectors)
        sizes.push_back(v.norm() / unit);
      return sizes;
    }

    std::vector<double> difference(const std::vector<double> &a, const std::vector<double> &b)
    {
      std::vector<double> result;
      for (std::size_t k = 0; k < a.size() && k < b.size(); ++k)
        result.push_back(a[k] - b[k]);
      return result;
    }

    std::vector<Eigen::Matrix2d> difference(const std::vector<Eigen::Matrix2d> &a, const std::vector<Eigen::Matrix2d> &b)
    {
      std::vector<Eigen::Matrix2d> result;
      for (std::size_t k = 0; k < a.size() && k < b.size(); ++k)
        result.push_back(a[k] - b[k]);
      return result;
    }

    std::vector<Eigen::Vector2d> couple_moments(const discrete::Snapshot &grains)
    {
      return coupling::couple_moments(moment_carriers(grains.position, grains.radius, grains.window_forces));
    }

    std::vector<Eigen::Matrix2d> grain_stress(const discrete::Snapshot &grains)
    {
      double discs = 0;
      for (const double r : grains.radius)
        discs += M_PI * r * r;
      const double                 solid_fraction = discs / grains.area;
      std::vector<Eigen::Matrix2d> stress;
      for (std::size_t i = 0; i < grains.mean_internal_moment.size(); ++i)
        stress.push_back(grains.mean_internal_moment[i] * solid_fraction / (M_PI * grains.radius[i] * grains.radius[i]));
      return stress;
    }
  } // namespace arrays

  MotionUnits motion_units(const Increment &i)
  {
    return {i.displacement_unit, i.duration > 0 ? i.displacement_unit / i.duration : NAN};
  }

  void write_comparison_h5(const std::string &directory, const ComparisonDocument &document, const Results &results)
  {
    const auto &[scene, c] = document;
    discrete::Hdf5Writer file(comparison_h5(directory));
    for (std::size_t k = 0; k < c.stages.size(); ++k)
      write_stage(file, discrete::stage_name(k + 1), c.stages[k], results, k + 1);
    for (std::size_t k = 0; k < c.windows.size(); ++k)
      write_window(file, "window_" + std::to_string(k), c.windows[k], results);
    const double width = averaging_width(scene);
    list_history_arrays(c.discrete_history, width, IntoGroup{file, "histories/discrete"});
    list_history_arrays(c.continuum_history, width, IntoGroup{file, "histories/continuum"});
    list_platen_arrays(c.discrete_platens, scene.sample.mean_diameter, IntoGroup{file, "platens/discrete"});
    list_platen_arrays(c.continuum_platens, scene.sample.mean_diameter, IntoGroup{file, "platens/continuum"});

    list_file_attributes(scene.loading, scene.sample.mean_diameter, results.discrete.snapshots.front(), IntoGroup{file, "/"});
    file.finish();
  }

  void write_fields(const std::string &directory, const Comparison &c)
  {
    discrete::VtuSeries series(fields_series(directory), {}, 1); // stage 0 is the sample before loading
    for (const StageRecord &stage : c.stages)
      series.add(stage.progress, vtu_of(stage.fields, motion_units(stage.increment)));
  }
} // namespace diptych::coupling
