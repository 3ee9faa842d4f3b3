// diptych: reads LMGC90's HDF5 file
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/import/lmgc90_hdf5.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "coupling/scene/scene_error.h"
#include "discrete/files/csv_file.h"
#include "discrete/files/hdf5_file.h"

namespace diptych::coupling
{
  namespace
  {
    using discrete::Hdf5Reader;

    // Status of a contact in LMGC90 2025 (Help/parameters/status): 6 and 7 slide backward and forward.
    constexpr int slides_backward = 6, slides_forward = 7;

    // First column of a quantity, counted from 0. Help names columns from 1 on, both ends included.
    std::size_t column_of(const Hdf5Reader &file, const std::string &quantity, const int n)
    {
      const std::string      name  = "Help/" + quantity + "/bound";
      const std::vector<int> bound = file.read_int(name);
      if (bound.size() != 2 || bound[0] < 1 || bound[1] - bound[0] + 1 < n)
        throw SceneError(file.path() + ": " + name + " does not name " + std::to_string(n) + " columns");
      return std::size_t(bound[0] - 1);
    }

    // Rows and columns of a dataset.
    std::array<std::size_t, 2> shape_of(const Hdf5Reader &file, const std::string &name)
    {
      const std::vector<std::size_t> extents = file.extents(name);
      if (extents.size() != 2)
        throw SceneError(file.path() + ": " + name + " is not a table of rows and columns");
      return {extents[0], extents[1]};
    }

    struct RealTable
    {
      std::string         place;
      std::size_t         n_rows, n_columns;
      std::vector<double> values;

      double at(const std::size_t row, const std::size_t column) const
      {
        if (column >= n_columns)
          throw SceneError(place + " has " + std::to_string(n_columns) + " columns, fewer than in Help");
        const double value = values[row * n_columns + column];
        if (!std::isfinite(value))
          throw SceneError(place + ", row " + std::to_string(row) + ", column " + std::to_string(column) +
                           " (counted from 0) is not finite");
        return value;
      }
    };

    RealTable real_table(const Hdf5Reader &file, const std::string &name)
    {
      const auto shape = shape_of(file, name);
      return {file.path() + ": " + name, shape[0], shape[1], file.read(name)};
    }

    std::map<long, Lmgc90Motion> motions_of(const Hdf5Reader &file, const std::string &group)
    {
      const RealTable              table = real_table(file, group + "/RBDY2/rdata");
      const std::size_t            x = column_of(file, "RBDY2/rdata/X", 3), v = column_of(file, "RBDY2/rdata/V", 3);
      std::map<long, Lmgc90Motion> motions;
      for (std::size_t row = 0; row < table.n_rows; ++row)
        for (const int k : {0, 1, 2})
          {
            motions[long(row) + 1].displacement[k] = table.at(row, x + std::size_t(k));
            motions[long(row) + 1].velocity[k]     = table.at(row, v + std::size_t(k));
          }
      return motions;
    }

    std::vector<ForeignContact> contacts_of(const Hdf5Reader &file, const std::string &group, const Lmgc90Bodies &bodies)
    {
      const std::string      name  = group + "/VlocRloc/idata";
      const RealTable        real  = real_table(file, group + "/VlocRloc/rdata");
      const auto             shape = shape_of(file, name);
      const std::vector<int> whole = file.read_int(name);
      const std::size_t body = column_of(file, "VlocRloc/idata/ibdyty", 2), status = column_of(file, "VlocRloc/idata/status", 1),
                        rl = column_of(file, "VlocRloc/rdata/rl", 2), gap = column_of(file, "VlocRloc/rdata/gapTT", 1),
                        coor = column_of(file, "VlocRloc/rdata/coor", 2), uc = column_of(file, "VlocRloc/rdata/uc", 2);
      if (shape[0] != real.n_rows)
        throw SceneError(file.path() + ": " + name + " has " + std::to_string(shape[0]) + " rows, but rdata has " +
                         std::to_string(real.n_rows));
      if (std::max(body + 1, status) >= shape[1])
        throw SceneError(file.path() + ": " + name + " has fewer columns than in Help");
      const std::map<long, int>   walls = lmgc90_walls(bodies);
      std::vector<ForeignContact> contacts;
      for (std::size_t row = 0; row < real.n_rows; ++row)
        {
          const int    *numbers = &whole[row * shape[1]];
          Lmgc90Contact c;
          c.candidate  = numbers[body];
          c.antagonist = numbers[body + 1];
          c.tangential = real.at(row, rl);
          c.normal     = real.at(row, rl + 1);
          c.gap        = real.at(row, gap);
          c.point      = {real.at(row, coor), real.at(row, coor + 1)};
          c.direction  = {real.at(row, uc), real.at(row, uc + 1)};
          if (!is_unit(c.direction))
            throw SceneError(real.place + ": row " + std::to_string(row + 1) +
                             ": uc is not a unit normal; the sum of its squares is " +
                             discrete::exact_text(c.direction.squaredNorm()));
          c.slides = numbers[status] == slides_backward || numbers[status] == slides_forward;
          if (c.normal > 0)
            contacts.push_back(foreign_contact(c, walls));
        }
      return contacts;
    }

    double scalar(const Hdf5Reader &file, const std::string &name)
    {
      const std::vector<double> values = file.read(name);
      if (values.size() != 1 || !std::isfinite(values[0]))
        throw SceneError(file.path() + ": " + name + " is not one finite number");
      return values[0];
    }
  } // namespace

  std::vector<ForeignFrame> read_lmgc90_hdf5(const std::string                   &path,
                                             const Lmgc90Bodies                  &bodies,
                                             const std::map<std::string, double> &densities)
  {
    const Hdf5Reader          file(path);
    std::vector<ForeignFrame> frames;
    for (const std::string &name : file.members("Evolution"))
      {
        const std::string group = "Evolution/" + name;
        ForeignFrame      frame;
        frame.name       = name;
        frame.grain_file = frame.contact_file = path;
        frame.time                            = scalar(file, group + "/TPS");
        frame.step                            = long(scalar(file, group + "/NStep"));
        place_lmgc90_bodies(bodies, densities, motions_of(file, group), frame);
        frame.contacts     = contacts_of(file, group, bodies);
        frame.has_contacts = true;
        frames.push_back(std::move(frame));
      }
    if (frames.empty())
      throw SceneError(path + ": Evolution contains no frame");
    return frames;
  }
} // namespace diptych::coupling
