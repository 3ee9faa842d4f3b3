// diptych: reads Yade's VTKRecorder: spheres and interactions
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <filesystem>
#include <map>

#include "coupling/import/readers.h"
#include "coupling/import/text_lines.h"
#include "coupling/import/vtk_file.h"
#include "coupling/import/wall_table.h"
#include "coupling/scene/scene_error.h"

namespace diptych::coupling
{
  namespace
  {
    // Column k of row i.
    double vtk_at(const VtkArray &array, const std::size_t i, const std::size_t k)
    {
      return array.values[i * array.components + k];
    }

    std::vector<ForeignGrain> vtk_spheres(const std::string &path)
    {
      const VtkFile  file(path);
      const VtkArray points = file.read("Points", "Points", 3), radii = file.read("PointData", "radii", 1);
      const auto     optional = [&](const char *name, const std::size_t components) {
        return file.has("PointData", name)
                     ? file.read("PointData", name, components)
                     : VtkArray{name, components, std::vector<double>(components * points.n_rows(), not_told)};
      };
      const VtkArray id = file.read("PointData", "id", 1), mass = optional("mass", 1), velocity = optional("linVelVec", 3),
                     spin = optional("angVelVec", 3), force = optional("forceVec", 3);
      for (const VtkArray *array : {&radii, &id, &mass, &velocity, &spin, &force})
        if (array->n_rows() != points.n_rows())
          throw SceneError(path + ": array " + array->name + " has " + std::to_string(array->n_rows()) +
                           " rows, but Points has " + std::to_string(points.n_rows()));
      std::vector<ForeignGrain> grains(points.n_rows());
      for (std::size_t k = 0; k < grains.size(); ++k)
        {
          ForeignGrain &g = grains[k];
          if (vtk_at(id, k, 0) != std::floor(vtk_at(id, k, 0)) || std::abs(vtk_at(id, k, 0)) > 9e15)
            throw SceneError(path + ": id of point " + std::to_string(k) + " is not a whole number");
          g.id        = long(vtk_at(id, k, 0));
          g.position  = {vtk_at(points, k, 0), vtk_at(points, k, 1)};
          g.radius    = vtk_at(radii, k, 0);
          g.mass      = vtk_at(mass, k, 0);
          g.velocity  = {vtk_at(velocity, k, 0), vtk_at(velocity, k, 1)};
          g.spin      = vtk_at(spin, k, 2);
          g.resultant = {not_told, not_told}; // includes contacts that the other file lacks, so it cannot be checked
        }
      return grains;
    }

    // Lines join points, which are bodies in the order of their ids, including walls. Grains are found by their positions.
    void add_vtk_interactions(const std::string &path, ForeignFrame &frame)
    {
      const VtkFile  file(path);
      const VtkArray points = file.read("Points", "Points", 3), ends = file.read("Lines", "connectivity", 1),
                     normal = file.read("CellData", "forceN", 1);
      if (ends.n_rows() != 2 * normal.n_rows())
        throw SceneError(path + ": " + std::to_string(ends.n_rows()) + " ends of lines, but " + std::to_string(normal.n_rows()) +
                         " forces");
      std::map<std::pair<double, double>, const ForeignGrain *> at;
      for (const ForeignGrain &g : frame.grains)
        at[{g.position.x(), g.position.y()}] = &g;
      frame.has_contacts = true;
      frame.contact_file = path;
      for (std::size_t k = 0; k < normal.n_rows(); ++k)
        {
          const ForeignGrain *grain[2];
          for (const std::size_t end : {0, 1})
            {
              const double index = vtk_at(ends, 2 * k + end, 0);
              if (!(index >= 0 && index < double(points.n_rows())))
                throw SceneError(path + ": line " + std::to_string(k) + " (counted from 0) joins point " +
                                 std::to_string(long(index)) + ", which does not exist");
              const auto found = at.find({vtk_at(points, std::size_t(index), 0), vtk_at(points, std::size_t(index), 1)});
              if (found == at.end())
                throw SceneError(path + ": line " + std::to_string(k) + " (counted from 0) does not end at a sphere of " +
                                 frame.grain_file + ": the frames do not match");
              grain[end] = found->second;
            }
          ForeignContact c;
          c.first  = grain[0]->id;
          c.second = grain[1]->id;
          c.force  = vtk_at(normal, k, 0) * (grain[0]->position - grain[1]->position).normalized();
          frame.contacts.push_back(c);
        }
    }
  } // namespace

  ForeignSample read_yade_vtk(const ForeignOptions &options, const std::vector<std::string> &files)
  {
    std::map<long, std::string> spheres, interactions; // by the iteration in the name
    std::vector<std::string>    tables;
    for (const std::string &path : files)
      {
        const std::string ending = std::filesystem::path(path).extension().string();
        if (ending != ".vtu" && ending != ".vtp")
          {
            if (!is_wall_table(path))
              throw SceneError(path + ": is neither .vtu, .vtp nor a wall table; import text exports without VTK files");
            tables.push_back(path);
          }
        else if (const auto [at, is_new] = (ending == ".vtu" ? spheres : interactions).emplace(number_in_name(path), path);
                 !is_new)
          throw SceneError(path + ": " + at->second + " belongs to the same frame");
      }
    ForeignSample sample;
    sample.format     = "yade";
    sample.is_spheres = sample.counts_steps = true;
    for (const auto &[number, path] : spheres)
      {
        ForeignFrame frame;
        frame.name       = "iteration " + std::to_string(number);
        frame.step       = number;
        frame.grain_file = path;
        if (options.timestep)
          frame.time = double(number) * *options.timestep;
        frame.grains = vtk_spheres(path);
        if (interactions.count(number) == 0 && number != spheres.begin()->first)
          throw SceneError(path + ": there is no .vtp of iteration " + std::to_string(number) + ": the frames do not match");
        if (interactions.count(number) > 0)
          add_vtk_interactions(interactions[number], frame);
        sample.frames.push_back(std::move(frame));
      }
    add_wall_tables(sample, tables);
    sample.lacking = {"tangential forces (VTKRecorder keeps absolute components without direction)", "contacts with walls"};
    return sample;
  }
} // namespace diptych::coupling
