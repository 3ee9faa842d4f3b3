// diptych: what both panels made of one scene, in memory
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/results/results.h"

#include <filesystem>

#include "coupling/files/continuum_snapshot_file.h"
#include "coupling/folders/provenance.h"
#include "discrete/files/table_file.h"
#include "discrete/panel/snapshot_file.h"

namespace diptych::coupling
{
  namespace
  {
    ContinuumResults continuum_results(const std::string &folder, const ContinuumFacts &facts)
    {
      return {discrete::read_history<continuum::HistoryRow>(folder + "/continuum.csv"),
              read_continuum_snapshots(folder + "/continuum.h5"), facts};
    }
  } // namespace

  Results load_results(const std::string &folder)
  {
    const RunFacts facts  = read_run_facts(folder);
    const bool     coarse = std::filesystem::exists(folder + "/coarse/continuum.h5");
    return {{discrete::read_history<discrete::HistoryRow>(folder + "/discrete.csv"),
             discrete::read_snapshots(folder + "/discrete.h5"), facts.discrete},
            continuum_results(folder, facts.continuum),
            coarse ? continuum_results(folder + "/coarse", facts.continuum_coarse) : ContinuumResults(),
            facts.phases};
  }
} // namespace diptych::coupling
