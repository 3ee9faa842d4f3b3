// diptych: the list of provenance.json's entries
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/numbers/number_entry.h"
#include "coupling/store/facts.h"
#include "coupling/version.h"

namespace diptych::coupling
{
  // Origin of the results of one command. Versions are those of this build.
  struct Origin
  {
    std::string      command, scene;
    std::vector<int> seeds; // seed of the sample, or seeds of an ensemble
    std::string      date, cpu;
    unsigned int     cores = 0;
  };

  struct Libraries
  {};
  template <class Visitor> void list_numbers(const Libraries &, Visitor &v)
  {
    v({"deal.II", "-", "version, or none", Kind::setting}, std::string(deal_ii_version));
    v({"Trilinos", "-", "version, or none", Kind::setting}, std::string(trilinos_version));
    v({"Eigen", "-", "version", Kind::setting}, std::string(eigen_version));
    v({"HDF5", "-", "version", Kind::setting}, std::string(hdf5_version));
    v({"compiler", "-", "name and version", Kind::setting}, std::string(compiler_version));
    v({"build", "-", "type of the build", Kind::setting}, std::string(build_type));
  }

  struct Host
  {
    const Origin &of;
  };
  template <class Visitor> void list_numbers(const Host &h, Visitor &v)
  {
    v({"cpu", "-", "name of the processor", Kind::setting}, h.of.cpu);
    v({"cores", "-", "cores of the machine", Kind::setting}, int(h.of.cores));
  }

  template <class Visitor> void list_numbers(const Origin &o, Visitor &v)
  {
    v({"program", "-", "diptych", Kind::setting}, std::string("diptych"));
    v({"version", "-", "version of the program", Kind::setting}, std::string(version));
    v({"git_revision", "-", "revision of its source; unknown if it was built without git", Kind::setting},
      std::string(git_revision));
    v.group("libraries", "libraries that the program was built with", Libraries());
    v({"command", "-", "command line", Kind::setting}, o.command);
    v({"scene", "-", "name of the scene", Kind::setting}, o.scene);
    v({"seeds", "-", "seeds of the samples", Kind::setting}, o.seeds);
    v.group("host", "machine", Host{o});
    v({"date", "-", "UTC", Kind::setting}, o.date);
  }

  // All entries of provenance.json.
  struct ProvenanceDocument
  {
    const Origin   &origin;
    const RunFacts &facts;
  };
  template <class Visitor> void list_numbers(const ProvenanceDocument &d, Visitor &v)
  {
    list_numbers(d.origin, v);
    v.list("phases", "phases of the run and their cost", d.facts.phases);
    v.group("discrete", "facts of the discrete panel", d.facts.discrete);
    v.group("continuum", "facts of the continuum panel", d.facts.continuum);
    v.group("continuum_coarse", "facts of the run on coarser elements", d.facts.continuum_coarse);
    v.group("discrete_files", "checksums of the discrete panel's files", d.facts.discrete_files);
    v.group("continuum_files", "checksums of the continuum's files", d.facts.continuum_files);
    v.group("continuum_coarse_files", "checksums of the files of the run on coarser elements", d.facts.continuum_coarse_files);
    v.group("comparison_files", "checksums of the comparison's files", d.facts.comparison_files);
    v.group("ensemble_files", "checksums of the ensemble's files", d.facts.ensemble_files);
    v.group("hashes", "hashes of the scene and of the files that it reads", d.facts.hashes);
  }
} // namespace diptych::coupling
