// diptych: Python binding of the probes
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/averaging/carriers.h"
#include "coupling/probes/circular_probe.h"
#include "coupling/probes/platen_slip.h"
#include "coupling/probes/probe_statistics.h"
#include "coupling/probes/probes.h"
#include "coupling/python/bindings.h"
#include "coupling/python/inputs.h"

namespace diptych::python
{
  namespace
  {
    coupling::ProbeRegion region_of(const Numbers &corners, const double angle_deg)
    {
      coupling::ProbeRegion region;
      region.polygon   = vectors_of(corners, "where");
      region.angle_deg = angle_deg;
      if (region.polygon.size() < 3 || !(coupling::polygon_area(region.polygon) > 0))
        throw std::invalid_argument("where: at least three corners are needed, anticlockwise");
      return region;
    }

    // From a snapshot as in the comparison, or from arrays: moments -sum f (x) (half branch) of each grain.
    coupling::GrainNetwork network_of(const py::object &sample, const py::object &contact_arrays)
    {
      if (contact_arrays.is_none())
        return coupling::grain_network(sample.cast<const discrete::Snapshot &>());
      const py::dict           grain_arrays = sample;
      const GrainInput         grains       = grains_of(grain_arrays);
      const auto               contacts     = contacts_of(contact_arrays, grains);
      const coupling::Carriers carriers     = coupling::moment_carriers(grains.position, grains.radius, contacts);
      coupling::GrainNetwork   network;
      network.position = grains.position;
      network.radius   = grains.radius;
      network.forces = network.contacts = contacts;
      network.moment.assign(grains.radius.size(), Eigen::Matrix2d::Zero());
      for (std::size_t k = 0; k < carriers.half.size(); ++k)
        {
          const Eigen::Vector4d moment = carriers.uniform.row(Eigen::Index(k)).head<4>();
          Eigen::Matrix2d       tensor;
          tensor << moment[0], moment[1], moment[2], moment[3];
          network.moment[carriers.half[k].grain] += tensor;
        }
      return network;
    }

    py::dict stress_dict(const coupling::ProbeStress &stress)
    {
      py::dict dict;
      dict["stress"]        = copy(stress.stress);
      dict["s1"]            = stress.s1;
      dict["s2"]            = stress.s2;
      dict["direction_deg"] = stress.direction_deg;
      dict["t_over_s"]      = stress.t_over_s;
      dict["count"]         = stress.count;
      return dict;
    }

    coupling::BootstrapOptions bootstrap_of(const py::dict &given)
    {
      coupling::BootstrapOptions options;
      options.block     = given["block"].cast<double>();
      options.resamples = given["resamples"].cast<int>();
      options.seed      = given["seed"].cast<std::uint64_t>();
      if (!(options.block > 0))
        throw std::invalid_argument("block must be positive");
      return options;
    }

    void add_fabric(const coupling::ProbeFabric &fabric, py::dict &dict)
    {
      dict["fabric"]               = copy(fabric.fabric);
      dict["anisotropy"]           = fabric.anisotropy;
      dict["fabric_direction_deg"] = fabric.direction_deg;
      dict["contacts"]             = fabric.contacts;
    }

    py::dict probe_grains(const py::object &grains,
                          const py::object &contacts,
                          const Numbers    &corners,
                          const double      angle_deg,
                          const py::dict   &blocks)
    {
      const coupling::GrainNetwork     network = network_of(grains, contacts);
      const coupling::ProbeRegion      region  = region_of(corners, angle_deg);
      const coupling::BootstrapOptions options = bootstrap_of(blocks);
      coupling::ProbeStress            stress;
      coupling::ProbeFabric            fabric;
      coupling::ProbeIntervals         intervals;
      double                           solid_fraction = 0;
      {
        const py::gil_scoped_release release;
        stress                          = coupling::grain_probe_stress(region, network.position, network.radius, network.moment);
        fabric                          = coupling::probe_fabric(region, network.contacts);
        const coupling::ProbeBlocks cut = coupling::probe_blocks(region, network, options.block);
        intervals                       = coupling::probe_intervals(cut, options);
        solid_fraction                  = cut.solid_fraction;
      }
      py::dict dict = stress_dict(stress), ends;
      add_fabric(fabric, dict);
      dict["solid_fraction"]       = solid_fraction;
      ends["s1"]                   = interval(intervals.s1);
      ends["s2"]                   = interval(intervals.s2);
      ends["t_over_s"]             = interval(intervals.t_over_s);
      ends["direction_deg"]        = interval(intervals.direction_deg);
      ends["anisotropy"]           = interval(intervals.anisotropy);
      ends["fabric_direction_deg"] = interval(intervals.fabric_direction_deg);
      dict["interval"]             = ends;
      return dict;
    }

    py::dict probe_cells(const py::dict &mesh, const Numbers &stress, const Numbers &corners)
    {
      const coupling::QuadMesh           cells  = mesh_of(mesh);
      const std::vector<Eigen::Matrix2d> values = tensors_of(stress, "stress");
      if (values.size() != cells.cell.size())
        throw std::invalid_argument("stress: one tensor per cell is needed: " + std::to_string(cells.cell.size()) + ", not " +
                                    std::to_string(values.size()));
      return stress_dict(coupling::cell_probe_stress(region_of(corners, 0), cells, values));
    }

    // circle: centre x, centre y, radius.
    py::dict probe_circle(const py::object &grains, const py::object &contacts, const py::tuple &circle, const py::dict &blocks)
    {
      const coupling::GrainNetwork     network = network_of(grains, contacts);
      const coupling::BootstrapOptions options = bootstrap_of(blocks);
      const coupling::Circle           place{{circle[0].cast<double>(), circle[1].cast<double>()}, circle[2].cast<double>()};
      if (!(place.radius > 0))
        throw std::invalid_argument("where: the radius of a circle must be positive");
      coupling::CircularProbe probe;
      {
        const py::gil_scoped_release release;
        probe = coupling::grain_circular_probe(place, network, options);
      }
      py::dict dict = stress_dict(coupling::probe_stress(0.5 * (probe.stress + probe.stress.transpose()), 0));
      dict.attr("pop")("count");
      dict["stress"]               = copy(probe.stress);
      dict["angles_deg"]           = own(std::move(probe.angles_deg));
      dict["normal"]               = own(std::move(probe.normal));
      dict["tangential"]           = own(std::move(probe.tangential));
      dict["predicted_normal"]     = own(std::move(probe.predicted_normal));
      dict["predicted_tangential"] = own(std::move(probe.predicted_tangential));
      dict["relative_l2"]          = interval(probe.relative_l2);
      return dict;
    }

    // samples: lists of successive snapshots.
    py::dict platen_friction(const std::vector<py::list> &samples, const bool is_mirror_symmetric, const int n_parts)
    {
      std::vector<coupling::PlatenParts> sums;
      for (const py::list &sample : samples)
        {
          std::vector<coupling::PlatenParts> windows;
          for (std::size_t k = 1; k < sample.size(); ++k)
            {
              const auto &from = sample[k - 1].cast<const discrete::Snapshot &>();
              const auto &to   = sample[k].cast<const discrete::Snapshot &>();
              windows.push_back(coupling::platen_parts(coupling::platen_contacts(from, to), is_mirror_symmetric, n_parts));
            }
          sums.push_back(coupling::sum_of(windows));
        }
      const coupling::PlatenFriction found = coupling::platen_friction(sums);
      py::dict                       dict;
      dict["friction"]    = interval(found.friction);
      dict["slip_length"] = interval(found.slip_length);
      return dict;
    }
  } // namespace

  void bind_probes(py::module_ &m)
  {
    m.def("probe_grains", &probe_grains);
    m.def("probe_cells", &probe_cells);
    m.def("probe_circle", &probe_circle);
    m.def("platen_friction", &platen_friction);
  }
} // namespace diptych::python
