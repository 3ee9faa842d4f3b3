// diptych: the results of both panels of one scene, in memory
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/store/results.h"

#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "coupling/cells/mesh_cells.h"
#include "coupling/store/continuum_snapshot_file.h"
#include "coupling/store/file_names.h"
#include "coupling/store/history_check.h"
#include "coupling/store/provenance.h"
#include "discrete/files/staged_file.h"
#include "discrete/files/table_file.h"
#include "discrete/panel/snapshot_file.h"

namespace diptych::coupling
{
  namespace
  {
    DiscreteResults discrete_results(const std::string &folder, const discrete::Report &facts)
    {
      const std::string table = discrete_csv(folder);
      DiscreteResults results{discrete::read_history<discrete::HistoryRow>(table), discrete::read_snapshots(discrete_h5(folder)),
                              facts};
      const bool      another_code = !results.snapshots.empty() && std::isnan(results.snapshots.front().step);
      check_history(results.rows, results.snapshots, {table, facts.finished, another_code});
      return results;
    }

    ContinuumResults continuum_results(const std::string &folder, const continuum::Report &facts)
    {
      const std::string table = continuum_csv(folder);
      ContinuumResults  results{discrete::read_history<continuum::HistoryRow>(table),
                               read_continuum_snapshots(continuum_h5(folder)), facts};
      check_history(results.rows, results.snapshots, {table, facts.finished, false});
      return results;
    }

    // The last snapshot of an unfinished run may have an inverted element.
    void check_meshes(const std::string &file, const ContinuumResults &results)
    {
      const std::size_t n = results.snapshots.size() - (results.facts.finished || results.snapshots.empty() ? 0 : 1);
      for (std::size_t k = 0; k < n; ++k)
        try
          {
            (void)quad_mesh(results.snapshots[k]);
          }
        catch (const std::runtime_error &error)
          {
            throw std::invalid_argument(file + ": " + discrete::stage_name(k) + ": " + error.what());
          }
    }
  } // namespace

  Results load_results(const std::string &folder, const std::string &of_continuum)
  {
    const std::string coarse = coarse_folder(of_continuum);
    const RunFacts    facts = read_run_facts(folder), of = read_run_facts(of_continuum);
    Results           results{discrete_results(folder, facts.discrete), continuum_results(of_continuum, of.continuum),
                    std::filesystem::exists(continuum_h5(coarse)) ? continuum_results(coarse, of.continuum_coarse)
                                                                            : ContinuumResults(),
                    facts.phases};
    check_meshes(continuum_h5(of_continuum), results.continuum);
    check_files(folder, "discrete"); // last: what was found wrong before says more
    check_files(of_continuum, "continuum");
    check_files(of_continuum, "continuum_coarse");
    return results;
  }
} // namespace diptych::coupling
